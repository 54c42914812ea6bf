// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_imposition_h
#define geocone_scene_imposition_h

#include <geocone/base/choice.h>

#include <vector>

namespace geocone
{
  /**
   * A way to impose a velocity: what is held, and of held particles which of them
   * share a row sum_p w_p v(x_p) = sum_p w_p q(x_p), which has a multiplier. FEM
   * knows nodes only. A new way is a line in impositions().
   */
  struct Imposition
  {
    enum class On
    {
      nodes,     ///< grid functions on sides of the background mesh
      particles, ///< those of the first row under a side of the body
      side ///< a side of the body, which moves with the prescribed velocity
    };

    /** A particle that a condition holds. */
    struct Held
    {
      unsigned int id;
      unsigned int cell; ///< number of its cell
      /** Its part of the held particles in its cell, and of all of the condition: one
       *  over their number, around an axis by circumferences. */
      double of_cell, of_all;
    };

    /** The row that a particle takes part in, and with which weight. */
    struct Share
    {
      unsigned int row;
      double       weight;
    };

    const char *word;
    On          on;
    Share (*share)(const Held &); ///< of held particles
    bool single; ///< each particle has the prescribed velocity itself
    /** Rows ask for that of particles at the end of the step, v_p + N (v - v^L), in
     *  place of that of the grid, N v (equations (66) to (69) of Guillet et al. 2025). */
    bool through_flip = false;
  };

  /** All of them; the first one is the default. */
  const std::vector<Imposition> &
  impositions();

  Choice<const Imposition *>
  imposition_choice();
} // namespace geocone

#endif
