// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_solver_report_h
#define geocone_newton_solver_report_h

#include <geocone/base/state_row.h>
#include <geocone/base/types.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Entry in the table of Newton iterations: an iterate and the preceding
   *  Newton step. */
  struct NewtonIteration
  {
    double       relative_residual = 0.; ///< residual norm / force norm
    double       step_length       = 0.; ///< of the step to this iterate
    double       elastic_blend     = 0.; ///< blend w in the tangent of the step
    double       friction_lag      = 0.; ///< lag of the linearised law
    unsigned int n_cone            = 0;
    unsigned int n_apex            = 0;
    unsigned int n_switched        = 0;
  };

  /** Solver report for the incremental problem of a step: iterations, residuals
   *  and outcome. */
  struct SolverReport
  {
    bool         converged      = false;
    unsigned int iterations     = 0; ///< linear solves, or sweeps
    unsigned int factorisations = 0;
    unsigned int regularised    = 0;  ///< regular by an elastic blend only
    double       residual       = 0.; ///< relative, of the last iterate
    double       friction_lag   = 0.; ///< lag of the solved law; 0: exact

    /** Fraction of the plastic work that is due to lagged friction (-), see
     *  InternalForces::excess_share(). */
    double excess_share = 0.;

    /** True if the solution with lagged friction differs too much from the
     *  solution with the exact friction law. */
    bool lag_error_too_large = false;

    /** True if rounding prevents the residual from reaching the tolerance. */
    bool at_rounding_floor = false;

    std::vector<NewtonIteration> table;
    std::string                  reason; ///< reason of failure
    std::string                  remedy; ///< remedy, if known

    /** Reads or writes all members except the iteration table, for
     *  checkpoints. */
    void
    state(StateRow &row)
    {
      row(converged,
          iterations,
          factorisations,
          regularised,
          residual,
          friction_lag,
          excess_share,
          lag_error_too_large,
          at_rounding_floor);
    }

    /** Prepends the report of earlier attempts at the same step. */
    void
    add_earlier(const SolverReport &earlier);
  };
} // namespace geocone::GEOCONE_DIM

#endif
