// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_ramped_forces_h
#define geocone_implicit_ramped_forces_h

#include <geocone/base/archive.h>
#include <geocone/base/types.h>
#include <geocone/space/space.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodal forces that are applied linearly over a time T after material is
   * added or removed. With n = F - sum V B's before and after the change of the
   * body,
   *   F(t) += (n_before - n_after) (1 - (t - t_0)/T),   t_0 <= t <= t_0 + T.
   * For removed material, the ramped forces are the weight of this material and
   * the forces by which the material supported the remaining body; for added
   * material, minus the weight of the added material.
   */
  class RampedForces
  {
  public:
    /** Adds nodal forces that are ramped linearly from the time `begin` (s).
     *  @param difference n_before - n_after (N/m)
     *  @param duration T (s), or 0 */
    void
    add(Vector difference, const double begin, const double duration);

    /** Adds the ramped forces at time t to the nodal forces. */
    void
    add_to(Vector &force, const double t) const;

    /** @name State of the ramped forces as part of a checkpoint. Collective. */
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
    struct Ramp
    {
      Vector force;
      double begin, duration;
    };
    std::vector<Ramp> list; ///< at most two: removal, addition
  };
} // namespace geocone::GEOCONE_DIM

#endif
