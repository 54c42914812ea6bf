// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_scaled_loads_h
#define geocone_implicit_scaled_loads_h

#include <geocone/conditions/constraints.h>
#include <geocone/scene/scene.h>

#include <Eigen/Core>

namespace geocone::GEOCONE_DIM
{
  /**
   * External loads F that are multiplied by a load factor in a stage with load
   * stepping (FEM or MPM). During the solution a constraint represents the
   * loads, with the load factor as multiplier (doc/theory/stages.md); after the
   * solution F acts as an ordinary load.
   */
  class ScaledLoads
  {
  public:
    /** Rejects scenes that combine load stepping and obstacles.
     *  @throws InputError */
    static void
    check(const Scene &scene);

    /**
     * Appends the constraint that represents the loads F, with the load factor
     * as multiplier. Collective.
     * @param force loads F @param prescribed velocities
     * @throws StepFailure if F cannot move the body
     */
    void
    add_row(const Stage  &stage,
            const Vector &force,
            const Vector &prescribed,
            Constraints  &constraints);

    /**
     * Adds the loads, multiplied by the load factor, to the nodal forces. The
     * same forces are subtracted from the reactions of supports.
     * @param lambda multipliers of the solved step
     * @return the load factor; 1 without load stepping
     */
    double
    add_scaled_loads(const Constraints     &constraints,
                     const Eigen::VectorXd &lambda,
                     Vector                &force,
                     Vector                &residual) const;

  private:
    Vector scaled; ///< loads F; empty without load stepping
  };
} // namespace geocone::GEOCONE_DIM

#endif
