// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_step_workspace_h
#define geocone_newton_step_workspace_h

#include <geocone/newton/linear_system.h>
#include <geocone/newton/solver_report.h>
#include <geocone/problem/incremental_problem.h>

#include <deal.II/base/timer.h>

namespace geocone::GEOCONE_DIM
{
  /** Data and operations common to all attempts at solving a step. */
  struct StepWorkspace
  {
    IncrementalProblem  &problem;
    const StepTraits    &traits; ///< properties of the step
    LinearSystem        &system;
    dealii::TimerOutput &timer;
    Vector              &v;        ///< the iterate
    Vector              &residual; ///< R(v)
    SolverReport        &report;

    /** Evaluates the residual R(v) at the iterate v. */
    ResidualReport
    evaluate(const LocalLaw &law = {}) const;

    /**
     * Appends a line to the table of Newton iterations.
     * @param step length that led to this state
     * @param blend elastic blend in the tangent of the step
     */
    void
    record(const ResidualReport &state,
           const double          length,
           const double          blend,
           const double          friction_lag) const;

    /**
     * Returns true if the residual in the free dofs is within the tolerance of
     * the momentum balance: |R_free| <= max(tolerance x force norm, absolute, c
     * N), with the rounding error N. N is the estimated rounding error,
     * InternalForces::rounding_floor(). At contact nodes the criterion is
     * relative to the contact forces. N is used only if it is small itself, and
     * is reported.
     */
    bool
    is_balanced(const ResidualReport &state,
                const double          tolerance,
                const double          absolute) const;

    /** Reports a NaN in the residual or in the constitutive law, with a
     *  remedy. */
    void
    report_not_a_number() const;

    /** Increments of the iterate that impose prescribed velocities and
     *  constraints H v = q. */
    struct Jump
    {
      Vector          prescribed; ///< end values minus v
      Eigen::VectorXd defect;     ///< constraint defect q - H v

      bool
      is_zero() const;
    };
    Jump
    jump() const;

    /**
     * Factorises the Jacobian dR/dv, in which a given fraction of the stiffness
     * is elastic.
     * @return whether the matrix is regular
     */
    bool
    factorise(const double elastic_blend) const;

    /**
     * Solves the Newton system for the direction dv and the multiplier
     * increments dlambda, with the last factorisation. The system is [K -H'; H
     * 0] (dv, dlambda) = (-R - K jump, defect), with the increments jump of
     * prescribed velocities.
     * @param prescribed increment of the prescribed velocities, or null if zero
     * @param[out] direction dv at all degrees of freedom
     */
    void
    solve(const Vector          *prescribed,
          const Eigen::VectorXd &defect,
          Vector                &direction) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
