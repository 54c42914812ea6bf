// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_initial_overstress_h
#define geocone_points_initial_overstress_h

#include <geocone/laws/material_library.h>
#include <geocone/points/material_points.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Returns a warning of points with inadmissible initial stress, which is redistributed
   *  abruptly in the first step; empty if there are none. Collective. */
  std::string
  warn_of_overstress(const MaterialPoints &points,
                     const Materials      &materials,
                     const MPI_Comm        comm);
} // namespace geocone::GEOCONE_DIM

#endif
