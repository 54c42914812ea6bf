// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/output/load_bracket.h>

#include <cmath>

namespace geocone
{
  void
  LoadBracket::take(const std::optional<double> other_lower,
                    const std::optional<double> other_upper)
  {
    if (other_lower && (!lower || *other_lower > *lower))
      lower = other_lower;
    if (other_upper && (!upper || *other_upper < *upper))
      upper = other_upper;
  }

  std::optional<double>
  LoadBracket::gap() const
  {
    if (!lower || !upper)
      return std::nullopt;
    return (*upper - *lower) / std::abs(*lower);
  }

  Json
  LoadBracket::bounds() const
  {
    const auto width = gap();
    return {{"unit", unit.empty() ? "-" : unit},
            {"lower", lower ? Json(*lower) : Json()},
            {"upper", upper ? Json(*upper) : Json()},
            {"gap", width ? Json(*width) : Json()},
            {"middle", width ? Json((*lower + *upper) / 2.) : Json()},
            {"certified", width.has_value()},
            {"cells", cells},
            {"seconds", seconds}};
  }

  Json
  LoadBracket::non_associated() const
  {
    Json topic = {{"upper_is_certified", upper.has_value()},
                  {"lower_is_certified", false},
                  {"davis_lower", davis.empty() ? Json() : Json(davis[0][0])},
                  {"davis_upper", davis.empty() ? Json() : Json(davis[0][1])}};
    for (unsigned int i = 1; i < davis.size(); ++i)
      {
        const std::string name = format("davis_%c_", 'a' + i);
        topic[name + "lower"]  = davis[i][0];
        topic[name + "upper"]  = davis[i][1];
      }
    return topic;
  }

  std::string
  LoadBracket::text() const
  {
    const std::string after = unit.empty() ? "" : " " + unit;
    const std::string between =
      lower && upper
        ? format("%.6g <= ", *lower) + name + format(" <= %.6g", *upper) + after
      : upper ? name + format(" <= %.6g", *upper) + after
      : lower ? name + format(" >= %.6g", *lower) + after
              : "no bound of the " + name;
    if (is_associated)
      return between + ", certified" +
             (gap() ? format("; middle %.6g, gap %.3g %%",
                             (*lower + *upper) / 2.,
                             100. * *gap())
                    : std::string());
    std::string line =
      upper ? "certified for any dilatancy (Radenkovic 1961): " + name +
                format(" <= %.6g", *upper) + after
            : "no upper bound is certified";
    if (!davis.empty())
      line += "; estimate, which is no bound (Davis 1968): ";
    for (unsigned int i = 0; i < davis.size(); ++i)
      line += (davis.size() == 1 ? ""
               : i == 0          ? "A "
                                 : format(", %c ", 'A' + i)) +
              format("%.6g to %.6g", davis[i][0], davis[i][1]) + after;
    return line + "; were flow associated: " + between;
  }

  std::string
  LoadBracket::beside(const double incremental) const
  {
    std::string line =
      format("incremental %s %.6g", name.c_str(), incremental) +
      (unit.empty() ? "" : " " + unit);
    const auto against = [&](const double other, const char *what) {
      // A reaction observed with the other sign is not comparable.
      if (other * incremental <= 0.)
        return;
      line +=
        format(", %+.2f %% against ", 100. * (incremental / other - 1.)) + what;
    };
    if (upper)
      against(*upper, "the certified upper bound");
    if (!davis.empty())
      against((davis[0][0] + davis[0][1]) / 2., "Davis's estimate");
    if (is_associated && lower)
      against(*lower, "the certified lower bound");
    return line;
  }
} // namespace geocone
