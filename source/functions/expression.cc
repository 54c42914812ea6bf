// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/base/text_of_place.h>
#include <geocone/functions/expression.h>
#include <geocone/functions/formula.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** A formula that throws if its value is not finite. */
    class FiniteFormula : public dealii::FunctionParser<dim>
    {
    public:
      FiniteFormula(const std::string &text, const std::string &parameter)
        : dealii::FunctionParser<dim>(1)
        , text(text)
        , parameter(parameter)
      {
        initialize(dim == 2 ? "x,y,t" : "x,y,z,t", text, {{"pi", pi}}, true);
        try
          {
            dealii::FunctionParser<dim>::value(dealii::Point<dim>()); // parses
          }
        catch (const dealii::ExceptionBase &)
          {
            throw InputError(parameter,
                             text,
                             allowed_formula(FormulaVariables::place_and_time),
                             "the library cannot read it: write it otherwise");
          }
      }

      double
      value(const dealii::Point<dim> &x,
            const unsigned int        component = 0) const override
      {
        const double value = dealii::FunctionParser<dim>::value(x, component);
        if (!std::isfinite(value))
          throw RunError(
            "parameter '" + parameter + "' = '" + printable(text) +
            "'\n  allowed: values that are finite numbers; at (" +
            text_of_place(x) + ") m and " +
            format("t = %g s it is ", this->get_time()) +
            (std::isnan(value) ? "none" : "infinite") +
            "\n  remedy:  check divisions by zero, roots and logarithms; "
            "if(a, b, c) is b where a is true, else c");
        return value;
      }

    private:
      const std::string text, parameter;
    };
  } // namespace

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
        record = std::make_unique<TimeHistory>(
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
    check_formula(text, parameter);
    function = std::make_unique<FiniteFormula>(text, parameter);
  }

  double
  Expression::value(const dealii::Point<dim> &x, const double t) const
  {
    if (field)
      return field(x, t);
    if (number)
      return *number;
    if (record)
      return record->value(t);
    if (function->get_time() != t) // threads evaluate with the same t
      function->set_time(t);
    return function->value(x);
  }

  std::optional<std::array<double, 2>>
  Expression::recorded() const
  {
    return record ? std::optional(
                      std::array<double, 2>{{record->begin(), record->end()}})
                  : std::nullopt;
  }
} // namespace geocone::GEOCONE_DIM
