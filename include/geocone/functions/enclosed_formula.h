// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_enclosed_formula_h
#define geocone_functions_enclosed_formula_h

#include <geocone/functions/interval_functions.h>

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Formula in the coordinates with rigorous bounds of its values and gradients in a box,
   * by interval arithmetic (natural extension, gradient by the chain rule; Moore 1966).
   * The operators and functions are those of check_formula(), with the precedence of
   * muParser.
   */
  class EnclosedFormula
  {
  public:
    /** @param text accepted by check_formula() with FormulaVariables::place */
    explicit EnclosedFormula(const std::string &text);

    /** Bounds of the values and gradients in a box, but for rounding errors. */
    Enclosure
    in(const IntervalBox &box) const
    {
      return function(box);
    }

    /** Linear functions below and above the values on a simplex. */
    struct OnSimplex
    {
      std::array<double, dim + 1> below, above; ///< at the vertices
    };

    /**
     * Returns linear functions below and above the formula on a simplex. For a
     * twice differentiable formula their distance is of second order in the size of the
     * simplex: the linear interpolation is moved by bounds of its error, by the mean
     * value theorem on parts of the simplex. Where the formula may jump they are
     * constants.
     */
    OnSimplex
    on_simplex(const std::array<dealii::Point<dim>, dim + 1> &vertices) const;

  private:
    std::function<Enclosure(const IntervalBox &)> function;
  };
} // namespace geocone::GEOCONE_DIM

#endif
