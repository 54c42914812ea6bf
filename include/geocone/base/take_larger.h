// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_take_larger_h
#define geocone_base_take_larger_h

#include <cmath>

namespace geocone
{
  /** Replaces the largest of some values by x if x is larger. Unlike std::max,
   *  it retains NaN. */
  inline void
  take_larger(double &largest, const double x)
  {
    if (!(x <= largest) && !std::isnan(largest))
      largest = x;
  }
} // namespace geocone

#endif
