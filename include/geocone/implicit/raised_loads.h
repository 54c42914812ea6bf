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
   * The loads F that a stage raises, in one step of FEM or MPM: while it is solved a
   * row of the multipliers, whose multiplier is their factor (doc/theory/stages.md),
   * and after that loads like others.
   */
  class RaisedLoads
  {
  public:
    /** @throws InputError where a stage raises loads beside obstacles */
    static void
    check(const Scene &scene);

    /**
     * Adds the row. Collective.
     * @param force F @param prescribed the prescribed velocities
     * @throws StepFailure if F can move nothing
     */
    void
    add_row(const Stage  &stage,
            const Vector &force,
            const Vector &prescribed,
            Constraints  &constraints);

    /**
     * Adds them to the force, and takes them from what supports must bear.
     * @param lambda the multipliers of the solved step
     * @return their factor; 1 where none are raised
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
