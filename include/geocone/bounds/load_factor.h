// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_load_factor_h
#define geocone_bounds_load_factor_h

#include <geocone/base/types.h>

namespace geocone::GEOCONE_DIM
{
  /** Selection of the loads that the load factor of a limit analysis
   *  multiplies. */
  enum class LoadFactor
  {
    automatic,
    velocity,  ///< none: the load is the reaction to prescribed velocities
    weight,    ///< the weight; tractions are dead loads
    tractions, ///< the tractions; the weight is a dead load
    all        ///< weight and tractions
  };

  /** Units of a limit analysis, chosen so that all variables are of order one. */
  struct BoundUnits
  {
    double length   = 1.; ///< unit of length (m)
    double stress   = 1.; ///< unit of stress (Pa)
    double velocity = 1.; ///< unit of velocity (m/s)
    bool   is_of_loads = false; ///< whether the unit of stress is that of loads
  };
} // namespace geocone::GEOCONE_DIM

#endif
