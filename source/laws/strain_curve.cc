// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/laws/strain_curve.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    double
    number(const std::string &text)
    {
      const double value = dealii::Utilities::string_to_double(text);
      if (!std::isfinite(value))
        throw dealii::ExcMessage("not finite");
      return value;
    }
  } // namespace

  void
  StrainCurve::read(const std::string &parameter,
                    const std::string &text,
                    const double       initial)
  {
    const auto refuse = [&](const std::string &allowed,
                            const std::string &remedy) {
      throw InputError(parameter, text, allowed, remedy);
    };
    points                    = {{0., initial}};
    scale                     = 0.;
    const std::string trimmed = dealii::Utilities::trim(text);
    const std::string word    = "exponential";
    if (trimmed.empty() || trimmed == "constant")
      return;
    try
      {
        if (trimmed.compare(0, word.size(), word) == 0)
          {
            const auto values = dealii::Utilities::split_string_list(
              trimmed.substr(word.size()), ',');
            if (values.size() != 2)
              throw dealii::ExcMessage("two numbers");
            scale = number(values[1]);
            points.push_back({scale, number(values[0])});
          }
        else
          for (const std::string &entry :
               dealii::Utilities::split_string_list(trimmed, ','))
            {
              const auto pair =
                dealii::Utilities::split_string_list(entry, ':');
              if (pair.size() != 2)
                throw dealii::ExcMessage("two numbers");
              points.push_back({number(pair[0]), number(pair[1])});
            }
      }
    catch (const dealii::ExceptionBase &)
      {
        refuse("constant | strain: value, strain: value, ... | exponential "
               "value, strain",
               "e.g. '0.02: 5000, 0.1: 3000', or 'exponential 3000, 0.02'");
      }
    for (std::size_t i = 1; i < points.size(); ++i)
      if (!(points[i].first > points[i - 1].first))
        refuse("strains that grow from one point to the next, the first > 0",
               "the value at strain 0 is the initial one");
  }

  double
  StrainCurve::operator()(const double strain) const
  {
    const double last = points.back().second;
    if (is_constant())
      return last;
    if (scale > 0.)
      return last + (points.front().second - last) *
                      std::exp(-std::max(strain, 0.) / scale);
    std::size_t i = 1;
    while (i < points.size() && points[i].first < strain)
      ++i;
    if (i == points.size())
      return last;
    const auto &[g_0, y_0] = points[i - 1];
    const auto &[g_1, y_1] = points[i];
    return y_0 + (y_1 - y_0) * (std::max(strain, 0.) - g_0) / (g_1 - g_0);
  }

  std::pair<double, double>
  StrainCurve::range() const
  {
    const auto [least, most] = std::minmax_element(
      points.begin(), points.end(), [](const auto &a, const auto &b) {
        return a.second < b.second;
      });
    return {least->second, most->second};
  }

  double
  StrainCurve::least_slope() const
  {
    // An exponential curve has its smallest slope at strain 0.
    double slope = 0.;
    for (std::size_t i = 1; i < points.size(); ++i)
      slope = std::min(slope,
                       (points[i].second - points[i - 1].second) /
                         (points[i].first - points[i - 1].first));
    return slope;
  }

  std::vector<double>
  StrainCurve::places() const
  {
    std::vector<double> all;
    for (const auto &point : points)
      all.push_back(point.first);
    for (const double factor : {0.25, 0.5, 2., 4., 8.})
      if (scale > 0.)
        all.push_back(factor * scale);
    return all;
  }
} // namespace geocone
