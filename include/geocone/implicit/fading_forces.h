// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_fading_forces_h
#define geocone_implicit_fading_forces_h

#include <geocone/base/archive.h>
#include <geocone/base/types.h>
#include <geocone/space/space.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * What a change of the body would do to the forces on its nodes at once, and does
   * linearly over a time T instead: with n = F - sum V B's before and after it,
   *   F(t) += (n_before - n_after) (1 - (t - t_0)/T),   t_0 <= t <= t_0 + T.
   * Of what is removed these are the forces that it exerted, its weight and those by
   * which it held the rest; of what is added, its weight taken back.
   */
  class FadingForces
  {
  public:
    /** @param difference n_before - n_after (N/m) @param duration T (s), or 0 */
    void
    add(Vector difference, const double begin, const double duration);

    /** Adds what is left of them at time t. */
    void
    add_to(Vector &force, const double t) const;

    /** @name As part of a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive              &archive,
         const BackgroundMesh &mesh,
         const Space          &space) const;
    void
    load(const Archive        &archive,
         const BackgroundMesh &mesh,
         const Space          &space);
    /** @} */

  private:
    struct Fading
    {
      Vector force;
      double begin, duration;
    };
    std::vector<Fading> list; ///< one of what is removed, one of what is added
  };
} // namespace geocone::GEOCONE_DIM

#endif
