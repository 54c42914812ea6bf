// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/output/reference_case.h>

#include <cmath>

namespace geocone
{
  ReferenceCase::ReferenceCase()
    : dealii::ParameterAcceptor("/Reference")
  {
    add_parameter("Quantity",
                  quantity,
                  "TOPIC/NAME of a number of summary.json with a known value, "
                  "e.g. limit_load/value. Empty: none, or the limit load if "
                  "'Observation/Reference' is set.");
    add_parameter("Expected",
                  expected,
                  "Expected value, not 0, in the unit of the quantity. The "
                  "topic 'reference' of summary.json contains both values and "
                  "the relative error.");
  }

  void
  ReferenceCase::prepare()
  {
    asked = is_given();
    if (!asked)
      return;
    const std::size_t slash = quantity.find('/');
    if (slash == 0 || slash == std::string::npos ||
        slash + 1 == quantity.size() ||
        quantity.find_first_of("~ \t\n") != std::string::npos)
      throw InputError("Reference/Quantity",
                       quantity,
                       "TOPIC/NAME of a number of summary.json",
                       "e.g. limit_load/value; summary.json of a run has all "
                       "of them");
    if (!std::isfinite(expected) || expected == 0.)
      throw InputError("Reference/Expected",
                       expected,
                       "a finite number other than zero",
                       "an error relative to zero says nothing: compare "
                       "another quantity, or use 'Output/Expectations'");
  }

  void
  ReferenceCase::set_default(const std::string &name, const double value)
  {
    if (is_given())
      return;
    quantity = name;
    expected = value;
  }

  Json
  ReferenceCase::topic(const Json &summary) const
  {
    const Json::json_pointer place("/" + quantity);
    Json topic              = {{"quantity", quantity}, {"value", nullptr}};
    topic["expected"]       = expected;
    topic["relative_error"] = nullptr;
    if (summary.contains(place) && summary[place].is_number())
      {
        const double value      = summary[place].get<double>();
        topic["value"]          = value;
        topic["relative_error"] = value / expected - 1.;
      }
    return topic;
  }

  std::string
  ReferenceCase::text(const Json &summary) const
  {
    const Json found = topic(summary);
    return found["value"].is_null()
             ? "reference: this run has no number '" + quantity + "'"
             : format("reference: %s %.6g, expected %.6g, error %+.3f %%",
                      quantity.c_str(),
                      found["value"].get<double>(),
                      expected,
                      100. * found["relative_error"].get<double>());
  }
} // namespace geocone
