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
  /** Data shared by all attempts at a step, and their common operations. */
  struct StepWorkspace
  {
    IncrementalProblem  &problem;
    const StepTraits    &traits; ///< of the problem
    LinearSystem        &system;
    dealii::TimerOutput &timer;
    Vector              &v;        ///< the iterate
    Vector              &residual; ///< R(v)
    SolverReport        &report;

    /** Evaluates R(v) at the iterate. */
    ResidualReport
    evaluate(const LocalLaw &law = {}) const;

    /**
     * Adds a line to the table of iterations.
     * @param length of the step to this state
     * @param blend in its tangent
     */
    void
    record(const ResidualReport &state,
           const double          length,
           const double          blend,
           const double          friction_lag) const;

    /**
     * Whether |R_free| <= max(tolerance x force norm, absolute, c N), with N
     * the estimate InternalForces::rounding_floor() of the rounding error, and
     * the same for contact nodes relative to their own forces. N counts only if
     * it is small itself, and is included in the report.
     */
    bool
    is_balanced(const ResidualReport &state,
                const double          tolerance,
                const double          absolute) const;

    /** Reports that R or the law is NaN, with a remedy. */
    void
    report_not_a_number() const;

    /** Changes of the iterate that the prescribed velocities and H v = q
     *  require. */
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
