// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/output/limit_load.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    /**
     * Loading branch of the curve: the branch between two reversals of the displacement
     * with the most work, done by the support (footing) or on it (active wall), as
     * opposed to rests, unloading, or interrupted reloading. Its displacements start at
     * zero.
     */
    std::vector<LoadPoint>
    main_branch(const std::vector<LoadPoint> &curve)
    {
      std::size_t first = 0, best_first = 0, best_end = 0;
      double      work = 0., best_work = 0., start = 0., best_start = 0.;
      double      previous = 0.;
      for (std::size_t i = 0; i < curve.size(); ++i)
        {
          const double change    = curve[i].displacement - previous;
          const double direction = i == first ? change : previous - start;
          if (change == 0. || change * direction < 0.)
            {
              first = change == 0. ? i + 1 : i;
              work  = 0.;
              start = previous;
            }
          work += change * curve[i].load;
          if (std::abs(work) > best_work)
            {
              best_work  = std::abs(work);
              best_first = first;
              best_end   = i + 1;
              best_start = start;
            }
          previous = curve[i].displacement;
        }
      std::vector<LoadPoint> best(curve.begin() + best_first,
                                  curve.begin() + best_end);
      for (LoadPoint &point : best)
        point.displacement = std::abs(point.displacement - best_start);
      return best;
    }

    /** Mean load over displacements from begin to end, each load over its step. */
    double
    mean_load(const std::vector<LoadPoint> &branch,
              const double                  begin,
              const double                  end)
    {
      double sum = 0., length = 0., previous = 0.;
      for (const LoadPoint &point : branch)
        {
          const double overlap = std::max(
            0., std::min(end, point.displacement) - std::max(begin, previous));
          sum += overlap * point.load;
          length += overlap;
          previous = point.displacement;
        }
      return length > 0. ? sum / length : 0.;
    }

    /** A step that covers more than this fraction of a plateau counts as all of it. */
    constexpr double nearly_all = 0.9;

    /** Index of the step that covers nearly all from begin to the end; 0 if none. */
    std::size_t
    only_step(const std::vector<LoadPoint> &branch, const double begin)
    {
      const double end = branch.back().displacement;
      for (std::size_t i = branch.size() - 1; i > 0; --i)
        if (branch[i].displacement -
              std::max(branch[i - 1].displacement, begin) >
            nearly_all * (end - begin))
          return i;
      return 0;
    }
  } // namespace

  LimitLoad
  find_limit_load(const std::vector<LoadPoint> &points, const double tolerance)
  {
    LimitLoad limit;
    for (const LoadPoint &point : points)
      if (std::abs(point.load) > std::abs(limit.peak))
        limit.peak = point.load;
    const std::vector<LoadPoint> branch = main_branch(points);
    if (branch.size() < 2)
      {
        limit.reason = branch.empty() ? "nothing has moved under a load"
                                      : "the load-displacement curve has only "
                                        "one step";
        return limit;
      }

    const double end = branch.back().displacement;
    for (const double fraction : {0.5, 0.25, 0.125})
      {
        const double      begin  = end * (1. - fraction);
        const double      mean   = mean_load(branch, begin, end);
        const std::size_t single = only_step(branch, begin);
        const double      change =
          single > 0 ? branch[single].load - branch[single - 1].load
                          : mean_load(branch, (begin + end) / 2., end) -
                         mean_load(branch, begin, (begin + end) / 2.);
        limit.drift     = mean != 0. ? change / mean : 0.;
        limit.value     = mean;
        limit.begins_at = begin;
        if (mean == 0. || std::abs(limit.drift) > tolerance)
          {
            if (single == branch.size() - 1)
              break;
            continue;
          }
        limit.found    = true;
        limit.band_low = limit.band_high = branch.back().load;
        for (const LoadPoint &point : branch)
          if (point.displacement > begin)
            {
              limit.band_low  = std::min(limit.band_low, point.load);
              limit.band_high = std::max(limit.band_high, point.load);
            }
        break;
      }
    if (!limit.found)
      limit.reason =
        limit.value == 0.
          ? "the load is zero"
          : format("the load still drifts by %.2g %%", 100. * limit.drift);
    return limit;
  }
} // namespace geocone
