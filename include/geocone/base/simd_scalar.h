// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_simd_scalar_h
#define geocone_base_simd_scalar_h

#include <cmath>

/*
 * Scalar versions of the functions of Pack, so that templates over the number
 * type apply to a single point as well as to the points of a Pack.
 */
namespace geocone
{
  using std::abs;
  using std::acos;
  using std::cos;
  using std::expm1;
  using std::log;
  using std::sqrt;

  inline double
  max(const double a, const double b)
  {
    return a > b ? a : b;
  }

  inline double
  min(const double a, const double b)
  {
    return a < b ? a : b;
  }

  inline double
  where_greater(const double a,
                const double b,
                const double yes,
                const double no)
  {
    return a > b ? yes : no;
  }

  inline bool
  any_greater(const double a, const double b)
  {
    return a > b;
  }
} // namespace geocone

#endif
