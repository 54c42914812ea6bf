// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduced_report_h
#define geocone_reduced_reduced_report_h

#include <vector>

namespace geocone
{
  /** Convergence report of a solver for the incremental problem in stresses. */
  struct ReducedReport
  {
    bool                converged  = false;
    unsigned int        iterations = 0; ///< Newton steps or sweeps
    unsigned int        restarts   = 0; ///< Newton steps replaced by sweeps
    double              error = 0.;     ///< ReducedProblem::natural_map_error()
    std::vector<double> errors; ///< error at the start and after each iteration
    double              cpu_seconds = 0.;
  };
} // namespace geocone

#endif
