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
  /** What all attempts at a step work on, and the parts that they share. */
  struct StepWorkspace
  {
    IncrementalProblem  &problem;
    const StepTraits    &traits; ///< of the problem
    LinearSystem        &system;
    dealii::TimerOutput &timer;
    Vector              &v;        ///< the iterate
    Vector              &residual; ///< R(v)
    SolverReport        &report;

    /** R(v) at the iterate. */
    ResidualReport
    evaluate(const LocalLaw &law = {}) const;

    /**
     * A line of the table for a state.
     * @param length of the step that led there
     * @param blend in its tangent
     */
    void
    record(const ResidualReport &state,
           const double          length,
           const double          blend,
           const double          friction_lag) const;

    /**
     * Whether |R_free| <= max(tolerance x force norm, absolute, c N), with N the
     * estimate InternalForces::rounding_floor() of what rounding leaves, and the same of
     * what touches by its own forces. N counts only where it is small itself, and is told
     * in the report.
     */
    bool
    is_balanced(const ResidualReport &state,
                const double          tolerance,
                const double          absolute) const;

    /** Says in the report that R or the law is not a number, and what may help. */
    void
    report_not_a_number() const;

    /** What the prescribed velocities and H v = q still ask of the iterate. */
    struct Jump
    {
      Vector          prescribed; ///< values at the step's end minus v
      Eigen::VectorXd defect;     ///< q - H v

      bool
      is_zero() const;
    };
    Jump
    jump() const;

    /**
     * Factorises dR/dv with an elastic blend.
     * @return whether it is regular
     */
    bool
    factorise(const double elastic_blend) const;

    /**
     * Solves [K -H'; H 0] (dv, dlambda) = (-R - K jump, defect) with the last
     * factorisation.
     * @param prescribed the jump of the prescribed velocities, or null for none
     * @param[out] direction dv in all rows
     */
    void
    solve(const Vector          *prescribed,
          const Eigen::VectorXd &defect,
          Vector                &direction) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
