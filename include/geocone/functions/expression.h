// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_expression_h
#define geocone_functions_expression_h

#include <geocone/base/types.h>
#include <geocone/functions/record.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <memory>
#include <optional>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * A scalar function of (x, y, t), given as a formula in muParser's language
   * with the constant pi, or, where files are allowed, as a time history
   * "record FILE.csv" (Record).
   */
  class Expression
  {
  public:
    /**
     * @param text the formula
     * @param parameter name of the parameter, for messages
     * @param folder to which file names are relative; null: formulas only
     * @throws InputError if the formula cannot be parsed or the file cannot be
     * read
     */
    void
    prepare(const std::string &text,
            const std::string &parameter,
            const std::string *folder = nullptr);

    double
    value(const dealii::Point<dim> &x, const double t) const;

    /** Whether the expression is the constant 0. */
    bool
    is_zero() const
    {
      return number == 0.;
    }

    /** End of a time history with a non-zero last value, which continues to act
     *  (s); otherwise infinite. */
    double
    stays_from() const;

  private:
    std::optional<double>                        number; ///< if constant
    std::unique_ptr<dealii::FunctionParser<dim>> function;
    std::unique_ptr<Record>                      record;
  };
} // namespace geocone::GEOCONE_DIM

#endif
