// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_particle_checks_h
#define geocone_implicit_particle_checks_h

#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Refuses consolidating particles that are not in water at rest, where there
   *  is water at all. Collective. */
  void
  check_water_at_rest(const Scene          &scene,
                      const MaterialPoints &points,
                      const MPI_Comm        comm);

  /** Largest number of points of a cell, per direction. Collective. */
  unsigned int
  points_per_direction(const MaterialPoints &points, const MPI_Comm comm);

  /**
   * Checks that particles which move see the functions across the body, in its
   * extent along each axis: n cells of splines of degree p have n + p functions.
   * One that k n particles do not see has no stiffness. Collective.
   * @return a warning, or nothing
   * @throws InputError where particles in sub-cells give two functions none
   */
  std::string
  check_width_of_body(const BackgroundMesh &mesh,
                      const Space          &space,
                      const unsigned int    k,
                      const MaterialPoints &points);
} // namespace geocone::GEOCONE_DIM

#endif
