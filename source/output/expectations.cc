// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/output/expectations.h>

#include <sstream>

namespace geocone
{
  Expectation::Expectation(const std::string &text,
                           const std::string &parameter)
    : text(text)
  {
    std::istringstream in(text);
    std::string        topic, relation, rest;
    if (!(in >> topic >> relation >> bound) || in >> rest ||
        (relation != "<=" && relation != ">=") ||
        topic.find('/') == std::string::npos)
      throw InputError(parameter,
                       text,
                       "TOPIC/NAME <= NUMBER or TOPIC/NAME >= NUMBER",
                       "e.g. newton/iterations_mean <= 7");
    place   = Json::json_pointer("/" + topic);
    at_most = relation == "<=";
  }

  bool
  Expectation::holds(const Json &summary) const
  {
    if (!summary.contains(place) || !summary[place].is_number())
      return false;
    const double value = summary[place].get<double>();
    return at_most ? value <= bound : value >= bound;
  }

  std::string
  Expectation::found(const Json &summary) const
  {
    return summary.contains(place) && summary[place].is_number()
             ? format("%.6g", summary[place].get<double>())
             : "none";
  }
} // namespace geocone
