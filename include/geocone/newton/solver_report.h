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
  /** A line of the Newton table: a state and the step that led to it. */
  struct NewtonIteration
  {
    double       relative_residual = 0.; ///< norm / force norm
    double       step_length       = 0.; ///< of the step that led here
    double       elastic_blend     = 0.; ///< w in its tangent
    double       friction_lag      = 0.; ///< of the law that was linearised
    unsigned int n_cone            = 0;
    unsigned int n_apex            = 0;
    unsigned int n_switched        = 0;
  };

  /** Result of a solve. */
  struct SolverReport
  {
    bool         converged      = false;
    unsigned int iterations     = 0; ///< linear systems solved, or sweeps
    unsigned int factorisations = 0;
    unsigned int regularised    = 0;  ///< made regular by an elastic blend
    double       residual       = 0.; ///< relative, at the end
    double       friction_lag   = 0.; ///< of the law that was solved; 0: exact

    /** InternalForces::excess_share() of the solution, for lagged friction. */
    double excess_share = 0.;

    /** Whether the law that was solved differs too much from the exact one. */
    bool exceeds = false;

    /** Whether rounding prevents the residual from reaching the tolerance. */
    bool at_rounding_floor = false;

    std::vector<NewtonIteration> table;
    std::string                  reason; ///< of failure
    std::string                  remedy; ///< if known

    /** Reads or writes everything except the table, for checkpoints. */
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
          exceeds,
          at_rounding_floor);
    }

    /** Prepends the report of earlier attempts. */
    void
    add_earlier(const SolverReport &earlier);
  };
} // namespace geocone::GEOCONE_DIM

#endif
