// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/reliability/sample_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  void
  SampleSearch::add(const BoundSide    side,
                    const unsigned int n_cells,
                    const double       bound)
  {
    if (std::isfinite(bound))
      (side == BoundSide::lower ? lower : upper)
        .push_back({double(n_cells), bound});
  }

  double
  SampleSearch::limit() const
  {
    // The middle of the first mesh, and the errors c/N of the last two meshes of a side.
    double middle = lower[0].bound * (1. + gap / 2.);
    if (!upper.empty() || !std::isfinite(middle))
      middle = upper.empty() ? 0. : (lower[0].bound + upper[0].bound) / 2.;
    double sum = middle, weights = 1., least = lower[0].bound,
           most = std::numeric_limits<double>::max();
    for (const Value &value : lower)
      least = std::max(least, value.bound);
    for (const Value &value : upper)
      most = std::min(most, value.bound);
    for (const Values *side : {&lower, &upper})
      if (side->size() > 1)
        {
          const Value &a = (*side)[side->size() - 2], &b = side->back();
          const double weight = side->size() - 1.;
          sum += weight * (b.n_cells * b.bound - a.n_cells * a.bound) /
                 (b.n_cells - a.n_cells);
          weights += weight;
        }
    return std::clamp(sum / weights, least, std::max(least, most));
  }

  bool
  SampleSearch::may_decide(const Values &bounds, const double limit) const
  {
    // Errors after two meshes are known to about a half.
    constexpr double part = 0.5;
    if (bounds.size() < 2)
      return true;
    const double error = std::abs(bounds.back().bound - limit) *
                         bounds.back().n_cells / most_cells;
    return part * error <= std::abs(limit - 1.);
  }

  std::optional<BoundSide>
  SampleSearch::next() const
  {
    if (lower.empty())
      return BoundSide::upper;
    const double    value = limit();
    const BoundSide side  = value >= 1. ? BoundSide::lower : BoundSide::upper;
    if (may_decide(side == BoundSide::lower ? lower : upper, value))
      return side;
    return std::nullopt;
  }
} // namespace geocone::GEOCONE_DIM
