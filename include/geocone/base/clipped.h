// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_clipped_h
#define geocone_base_clipped_h

#include <deal.II/base/point.h>

#include <vector>

namespace geocone
{
  /** Clips a convex polygon to a half-plane. The half-plane is
   *  (x - on) . into >= 0. */
  template <int n>
  std::vector<dealii::Point<n>>
  clipped(const std::vector<dealii::Point<n>> &polygon,
          const dealii::Point<n>              &on,
          const dealii::Tensor<1, n>          &into)
  {
    std::vector<dealii::Point<n>> rest;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const dealii::Point<n> &a = polygon[i],
                               &b = polygon[(i + 1) % polygon.size()];
        const double in_a = (a - on) * into, in_b = (b - on) * into;
        if (in_a >= 0.)
          rest.push_back(a);
        if (in_a * in_b < 0.)
          rest.push_back(dealii::Point<n>(a + in_a / (in_a - in_b) * (b - a)));
      }
    return rest;
  }
} // namespace geocone

#endif
