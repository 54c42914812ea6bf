// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_expression_h
#define geocone_functions_expression_h

#include <geocone/base/types.h>
#include <geocone/functions/record.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Scalar function of position (m) and time (s), given by a formula, by a
   * time history or by a field. A formula is written in muParser's language with
   * the constant pi; where files are allowed, a time history is given as "record
   * FILE.csv" (TimeHistory).
   */
  class Expression
  {
  public:
    /**
     * Parses a formula, or reads a time history.
     * @param text formula or time history
     * @param parameter name of the parameter, for messages
     * @param folder base folder of file names; null: only formulas are allowed
     * @throws InputError if the formula cannot be parsed or the file cannot be
     * read
     */
    void
    prepare(const std::string &text,
            const std::string &parameter,
            const std::string *folder = nullptr);

    double
    value(const dealii::Point<dim> &x, const double t) const;

    using Field = std::function<double(const dealii::Point<dim> &, double)>;

    /** Takes the values from a field instead. */
    void
    set_field(const Field &values)
    {
      field = values;
    }

    /** Returns true if the expression is identically zero. */
    bool
    is_zero() const
    {
      return number == 0.;
    }

    /** First and last time (s) of a time history, before and after which its
     *  value is constant; empty for other expressions. */
    std::optional<std::array<double, 2>>
    recorded() const;

  private:
    Field                                        field;  ///< or empty
    std::optional<double>                        number; ///< if constant
    std::unique_ptr<dealii::FunctionParser<dim>> function;
    std::unique_ptr<TimeHistory>                 record;
  };
} // namespace geocone::GEOCONE_DIM

#endif
