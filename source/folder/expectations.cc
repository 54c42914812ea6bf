// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/folder/expectations.h>

#include <limits>
#include <sstream>

namespace geocone
{
  Expectation::Expectation(const std::string &text,
                           const std::string &parameter)
    : text(text)
  {
    std::istringstream in(text);
    std::string        topic, relation, sign, rest;
    double             number = 0., width = 0.;
    bool               is_one = bool(in >> topic >> relation >> number) &&
                  topic.find('/') != std::string::npos;
    constexpr double beyond = std::numeric_limits<double>::infinity();
    if (relation == "=")
      is_one =
        is_one && bool(in >> sign >> width) && sign == "+-" && width >= 0.;
    else
      is_one = is_one && (relation == "<=" || relation == ">=");
    if (!is_one || in >> rest)
      throw InputError(parameter,
                       text,
                       "TOPIC/NAME <= NUMBER, TOPIC/NAME >= NUMBER or "
                       "TOPIC/NAME = NUMBER +- NUMBER",
                       "e.g. newton/iterations_mean <= 7");
    place = Json::json_pointer("/" + topic);
    least = relation == "<=" ? -beyond : number - width;
    most  = relation == ">=" ? beyond : number + width;
  }

  bool
  Expectation::holds(const Json &summary) const
  {
    if (!summary.contains(place) || !summary[place].is_number())
      return false;
    const double value = summary[place].get<double>();
    return least <= value && value <= most;
  }

  std::string
  Expectation::found(const Json &summary) const
  {
    return summary.contains(place) && summary[place].is_number()
             ? format("%.6g", summary[place].get<double>())
             : "none";
  }
} // namespace geocone
