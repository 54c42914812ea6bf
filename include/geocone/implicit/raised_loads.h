// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_raised_loads_h
#define geocone_implicit_raised_loads_h

#include <geocone/conditions/constraints.h>
#include <geocone/scene/scene.h>

#include <Eigen/Core>

namespace geocone::GEOCONE_DIM
{
  /**
   * Loads F of a stage with load stepping, in one step of FEM or MPM. During
   * the solution they are a constraint whose multiplier is the load factor
   * (doc/theory/stages.md); afterwards they are ordinary loads.
   */
  class RaisedLoads
  {
  public:
    /** @throws InputError for a stage with load stepping and obstacles */
    static void
    check(const Scene &scene);

    /**
     * Adds the row. Collective.
     * @param force F @param prescribed the prescribed velocities
     * @throws StepFailure if F cannot move the body
     */
    void
    add_row(const Stage  &stage,
            const Vector &force,
            const Vector &prescribed,
            Constraints  &constraints);

    /**
     * Adds the loads to the force, and subtracts them from the reactions of
     * supports.
     * @param lambda the multipliers of the solved step
     * @return the load factor; 1 without load stepping
     */
    double
    take(const Constraints     &constraints,
         const Eigen::VectorXd &lambda,
         Vector                &force,
         Vector                &residual) const;

  private:
    Vector raised; ///< empty: none
  };
} // namespace geocone::GEOCONE_DIM

#endif
