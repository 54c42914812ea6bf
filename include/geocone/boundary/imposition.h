// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_imposition_h
#define geocone_boundary_imposition_h

#include <geocone/base/choice.h>

#include <vector>

namespace geocone
{
  /**
   * Method of imposing prescribed velocities on nodes, particles or a side of
   * the body. For particles, each constraint has the form sum_p w_p v(x_p) =
   * sum_p w_p q(x_p) with the weights w_p and the prescribed velocity q, and a
   * Lagrange multiplier. FEM supports nodes only. A new method is a line in
   * impositions().
   */
  struct Imposition
  {
    enum class On
    {
      nodes,     ///< nodes on sides of the background mesh
      particles, ///< first particle row below a side
      side       ///< side of the body, moved as prescribed
    };

    /** Particle with a prescribed velocity. */
    struct PrescribedParticle
    {
      unsigned int id;
      unsigned int cell; ///< index of the particle's cell
      /** Weights of the particle in the mean velocities of its cell (of_cell)
       *  and of the boundary condition (of_all). A weight is one over the
       *  number of particles; in axisymmetry it is proportional to the
       *  circumference. */
      double of_cell, of_all;
    };

    /** Index of a constraint (row) on particle velocities, with the weight of a
     *  particle in the constraint. */
    struct Share
    {
      unsigned int row;
      double       weight;
    };

    const char *word;
    On          on;
    Share (*share)(const PrescribedParticle &); ///< constraint of a particle
    bool single; ///< one constraint for each particle
    /** True if constraints prescribe the particle velocity at the end of the
     *  step, false if they prescribe the grid velocity N v at the particle.
     *  With FLIP the particle velocity is v_p + N (v - v^L), equations (66) to
     *  (69) of Guillet et al. (2025). */
    bool through_flip = false;
  };

  /** Returns all methods of imposing prescribed velocities. The first one is
   *  the default. */
  const std::vector<Imposition> &
  impositions();

  Choice<const Imposition *>
  imposition_choice();
} // namespace geocone

#endif
