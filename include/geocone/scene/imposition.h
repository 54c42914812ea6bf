// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_imposition_h
#define geocone_scene_imposition_h

#include <geocone/base/choice.h>

#include <vector>

namespace geocone
{
  /**
   * Imposition method of prescribed velocities: the controlled entities and,
   * for particles, constraints sum_p w_p v(x_p) = sum_p w_p q(x_p), each with a
   * multiplier. FEM supports nodes only. A new method is a line in
   * impositions().
   */
  struct Imposition
  {
    enum class On
    {
      nodes,     ///< nodes on sides of the background mesh
      particles, ///< first row of particles below a side of the body
      side       ///< a side of the body, which moves as prescribed
    };

    /** A particle controlled by a condition. */
    struct PrescribedParticle
    {
      unsigned int id;
      unsigned int cell; ///< index of the particle's cell
      /** Weight of the particle among the controlled particles of the cell and
       *  of the condition: one over their number, in axisymmetry proportional
       *  to the circumference. */
      double of_cell, of_all;
    };

    /** Index of the constraint that contains a particle, and weight of the
     *  particle in it. */
    struct Share
    {
      unsigned int row;
      double       weight;
    };

    const char *word;
    On          on;
    Share (*share)(const PrescribedParticle &); ///< constraint of a particle
    bool single;                  ///< each particle has the prescribed velocity
    /** Whether constraints prescribe the velocity of particles at the end of
     *  the step, v_p + N (v - v^L), instead of the grid velocity N v (equations
     *  (66) to (69) of Guillet et al. 2025). */
    bool through_flip = false;
  };

  /** All imposition methods; the first one is the default. */
  const std::vector<Imposition> &
  impositions();

  Choice<const Imposition *>
  imposition_choice();
} // namespace geocone

#endif
