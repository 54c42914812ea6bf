// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_gauss_seidel_h
#define geocone_reduced_gauss_seidel_h

#include <geocone/reduced/reduced_problem.h>
#include <geocone/reduced/reduced_report.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nonsmooth Gauss-Seidel method for the incremental problem in stresses
   * (ReducedProblem). In each sweep, the problem of each cone is solved exactly in turn
   * (solve_one_cone) with the other stresses fixed; multipliers, if any, follow from
   * all stresses. For associated flow, the method minimises the convex function of eq
   * (63) block by block and converges from any initial guess; for non-associated flow,
   * it mostly converges.
   */
  struct GaussSeidel
  {
    double       tolerance  = 1e-8;   ///< for natural_map_error()
    unsigned int max_sweeps = 100000; ///< maximum number of sweeps

    /** True to terminate early if convergence is too slow to reach the tolerance within
     *  max_sweeps. The convergence rate is the rate of the last half of the sweeps. */
    bool stops_if_slow = false;

    /**
     * Solves the reduced problem by Gauss-Seidel sweeps.
     * @param[in,out] s in: initial guess (Pa, 3n components); out: solution
     * @return report; errors during sweeps are computed cone by cone before each update,
     * at no extra cost; the first and the last error refer to the full state
     */
    ReducedReport
    solve(const ReducedProblem &problem, Eigen::VectorXd &s) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
