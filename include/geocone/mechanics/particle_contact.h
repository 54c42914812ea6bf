// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_particle_contact_h
#define geocone_mechanics_particle_contact_h

#include <geocone/discretisation/material_points.h>
#include <geocone/discretisation/space.h>
#include <geocone/scene/obstacles.h>
#include <geocone/scene/rigid_motion.h>

#include <vector>

namespace geocone
{
  /**
   * Per obstacle the gap to it of the nearest particle that a node moves (m), by the
   * node's first dof, for ObstacleContact::begin(). A particle is a square of its
   * volume. Collective.
   * @param moved what the obstacles have moved since the start
   */
  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Obstacles                &obstacles,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space);

  /** @throws InputError if a particle is in an obstacle at the start. Collective. */
  void
  check_particles_outside(const MaterialPoints &points,
                          const Obstacles      &obstacles,
                          const MPI_Comm        comm);
} // namespace geocone

#endif
