// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/scene/expression.h>
#include <geocone/scene/geometry.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <limits>

namespace geocone
{
  void
  Expression::prepare(const std::string &text,
                      const std::string &parameter,
                      const std::string *folder)
  {
    number.reset();
    record.reset();
    const std::string word = "record ";
    if (folder != nullptr && text.compare(0, word.size(), word) == 0)
      {
        record = std::make_unique<Record>(
          existing_file(text.substr(word.size()),
                        *folder,
                        parameter,
                        "record and the name of an existing .csv file"),
          text,
          parameter);
        return;
      }
    try
      {
        const double value = dealii::Utilities::string_to_double(text);
        if (std::isfinite(value))
          {
            number = value;
            return;
          }
      }
    catch (const dealii::ExceptionBase &)
      {} // not a number
    try
      {
        function = std::make_unique<dealii::FunctionParser<dim>>(1);
        function->initialize(
          dim == 2 ? "x,y,t" : "x,y,z,t", text, {{"pi", pi}}, true);
        function->value(dealii::Point<dim>()); // parses now
      }
    catch (const std::exception &)
      {
        throw InputError(parameter,
                         text,
                         std::string("a formula in ") + coordinates +
                           " (m), t (s) and pi, e.g. -0.02*min(1,t/0.1)",
                         "check the parentheses and the names");
      }
  }

  double
  Expression::value(const dealii::Point<dim> &x, const double t) const
  {
    if (number)
      return *number;
    if (record)
      return record->value(t);
    function->set_time(t);
    return function->value(x);
  }

  double
  Expression::stays_from() const
  {
    return record && record->value(record->end()) != 0.
             ? record->end()
             : std::numeric_limits<double>::infinity();
  }
} // namespace geocone
