// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/limit_load.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    /** Mean load over displacements from begin to end, each load over its step. */
    double
    mean_load(const std::vector<LoadPoint> &curve,
              const double                  begin,
              const double                  end)
    {
      double sum = 0., length = 0., previous = 0.;
      for (const LoadPoint &point : curve)
        {
          const double overlap = std::max(0.,
                                          std::min(end, point.displacement) -
                                            std::max(begin, previous));
          sum += overlap * point.load;
          length += overlap;
          previous = point.displacement;
        }
      return length > 0. ? sum / length : 0.;
    }
  } // namespace

  LimitLoad
  find_limit_load(const std::vector<LoadPoint> &points, const double tolerance)
  {
    LimitLoad limit;
    if (points.empty())
      return limit;

    // Downward or upward, the displacement counts as its distance. Unloading
    // ends a curve: what comes after it is no plateau of this loading.
    std::vector<LoadPoint> curve = points;
    limit.peak                   = curve.front().load;
    for (LoadPoint &point : curve)
      {
        point.displacement = std::abs(point.displacement);
        if (std::abs(point.load) > std::abs(limit.peak))
          limit.peak = point.load;
      }
    for (std::size_t i = 1; i < curve.size(); ++i)
      if (curve[i].displacement <= curve[i - 1].displacement)
        {
          curve.resize(i);
          break;
        }
    if (curve.size() < 2)
      return limit;

    const double end = curve.back().displacement;
    for (const double fraction : {0.5, 0.25, 0.125})
      {
        const double begin   = end * (1. - fraction);
        const double mean    = mean_load(curve, begin, end);
        const bool one_step  = curve[curve.size() - 2].displacement <= begin;
        const double change =
          one_step ?
            curve.back().load - curve[curve.size() - 2].load :
            mean_load(curve, (begin + end) / 2., end) -
              mean_load(curve, begin, (begin + end) / 2.);
        limit.drift     = mean != 0. ? change / mean : 0.;
        limit.value     = mean;
        limit.begins_at = begin;
        if (mean != 0. && std::abs(limit.drift) <= tolerance)
          {
            limit.found    = true;
            limit.band_low = limit.band_high = curve.back().load;
            double previous                  = 0.;
            for (const LoadPoint &point : curve)
              {
                if (previous >= begin)
                  {
                    limit.band_low  = std::min(limit.band_low, point.load);
                    limit.band_high = std::max(limit.band_high, point.load);
                  }
                previous = point.displacement;
              }
            return limit;
          }
        if (one_step)
          break;
      }
    return limit;
  }
} // namespace geocone
