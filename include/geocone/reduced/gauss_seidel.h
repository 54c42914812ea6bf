// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_gauss_seidel_h
#define geocone_reduced_gauss_seidel_h

#include <geocone/reduced/reduced_problem.h>
#include <geocone/reduced/reduced_report.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nonsmooth Gauss-Seidel method for a ReducedProblem: cone after cone is
   * solved exactly (solve_one_cone) with the others as they are and the multipliers,
   * if any, as they follow from all stresses; a sweep goes over all of them. For
   * associated flow it minimises the convex function of eq (63) block by block
   * and converges from anywhere; otherwise it mostly does.
   */
  struct GaussSeidel
  {
    double       tolerance  = 1e-8;   ///< on natural_map_error()
    unsigned int max_sweeps = 100000; ///< before it is given up

    /** Give up where at the rate of the last half of the sweeps the tolerance is not met
     *  within max_sweeps. */
    bool stops_if_slow = false;

    /**
     * @param[in,out] s in: the start (Pa, 3n); out: the solution
     * @return errors of sweeps are those of the cones as the sweep met them,
     * which cost nothing; the first and the last are those of the whole state
     */
    ReducedReport
    solve(const ReducedProblem &problem, Eigen::VectorXd &s) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
