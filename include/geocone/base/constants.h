// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_constants_h
#define geocone_base_constants_h

namespace geocone
{
  constexpr double pi    = 3.14159265358979323846;
  constexpr double sqrt2 = 1.41421356237309504880;

  inline double
  radians(const double degrees)
  {
    return degrees * (pi / 180.);
  }
} // namespace geocone

#endif
