// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_imposition_h
#define geocone_scene_imposition_h

#include <geocone/base/choice.h>

#include <vector>

namespace geocone
{
  /**
   * An imposition method for prescribed velocities: the controlled parts, and
   * for particles the row sum_p w_p v(x_p) = sum_p w_p q(x_p), with a
   * multiplier, to which each belongs. FEM supports nodes only. A new method is
   * a line in impositions().
   */
  struct Imposition
  {
    enum class On
    {
      nodes,     ///< grid functions on sides of the background mesh
      particles, ///< those of the first row under a side of the body
      side       ///< a side of the body, moving as prescribed
    };

    /** A particle controlled by a condition. */
    struct Held
    {
      unsigned int id;
      unsigned int cell; ///< number of its cell
      /** Weight among the controlled particles of its cell, and of the
       *  condition: one over their number, in axisymmetry by circumferences. */
      double of_cell, of_all;
    };

    /** Row and weight of a particle. */
    struct Share
    {
      unsigned int row;
      double       weight;
    };

    const char *word;
    On          on;
    Share (*share)(const Held &); ///< of controlled particles
    bool single;                  ///< each particle has the prescribed velocity
    /** Whether rows prescribe the velocity of particles at the end of the step,
     *  v_p + N (v - v^L), instead of that of the grid, N v (equations (66) to
     *  (69) of Guillet et al. 2025). */
    bool through_flip = false;
  };

  /** All imposition methods; the first one is the default. */
  const std::vector<Imposition> &
  impositions();

  Choice<const Imposition *>
  imposition_choice();
} // namespace geocone

#endif
