// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_point_elasticity_h
#define geocone_points_point_elasticity_h

#include <geocone/laws/material_library.h>
#include <geocone/points/material_points.h>

namespace geocone::GEOCONE_DIM
{
  /** Elastic moduli of a material point at t_n, which depend on its stress and
   *  history variables. */
  inline Elasticity
  elasticity_at_start(const Materials      &materials,
                      const MaterialPoints &points,
                      const unsigned int    p)
  {
    return materials[points.material[p]].elasticity_at(points.stress[p],
                                                       points.history_of(p));
  }
} // namespace geocone::GEOCONE_DIM

#endif
