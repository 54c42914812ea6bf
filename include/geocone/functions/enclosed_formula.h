// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_enclosed_formula_h
#define geocone_functions_enclosed_formula_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Range of real numbers between two bounds. */
  struct Range
  {
    double least, most;
  };

  /** Bounds of the values and the gradient of a function in a box. */
  struct Enclosure
  {
    Range                  value;
    std::array<Range, dim> gradient; ///< generalised; of Lipschitz functions

    /** False if the function may jump, or its gradient be infinite. */
    bool is_lipschitz = true;
  };

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

    /** Bounds of the values and gradients in a box of positions (m), but for rounding
     *  errors. */
    Enclosure
    in(const std::array<Range, dim> &box) const;

    /** Linear functions below and above the values on a simplex. */
    struct OnSimplex
    {
      std::array<double, dim + 1> below,
        above; ///< linear bounds, at the vertices
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
    class Evaluation;
    std::shared_ptr<const Evaluation> evaluation;
  };
} // namespace geocone::GEOCONE_DIM

#endif
