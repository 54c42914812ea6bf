// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_obstacle_step_h
#define geocone_contact_obstacle_step_h

#include <geocone/contact/obstacle_motions.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Prescribed motions, inertia and loads of all obstacles in a step of size h.
   *  @param velocity of the obstacles at the beginning of the step
   *  @param driven_at time at which prescribed velocities are taken (s)
   *  @param loaded_at time at which loads and gravity are taken (s) */
  std::vector<ObstacleBody>
  bodies_of_step(const Scene                    &scene,
                 const std::vector<RigidMotion> &velocity,
                 const double                    driven_at,
                 const double                    loaded_at,
                 const double                    h);

  /** Returns true if an obstacle may have no node of a background mesh inside.
   *  @param cell_size size of the smallest cell (m) */
  bool
  is_thinner(const Obstacle &obstacle, const double cell_size);

  /** @throws InputError for an obstacle thinner than a cell */
  [[noreturn]] void
  refuse_thin(const Obstacle &obstacle, const double cell_size);

  /** @name Free obstacles that overlap with others */
  /** @{ */
  /** @throws InputError in the initial state
   *  @param margin tolerance (m) */
  void
  check_start_of_free(const Obstacles &obstacles, const double margin);

  /** @throws StepFailure at displacements since the start */
  void
  check_free(const Obstacles                &obstacles,
             const std::vector<RigidMotion> &moved,
             const double                    margin);
  /** @} */
} // namespace geocone::GEOCONE_DIM

#endif
