// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_gauss_seidel_h
#define geocone_reduced_gauss_seidel_h

#include <geocone/reduced/reduced_problem.h>
#include <geocone/reduced/reduced_report.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nonsmooth Gauss-Seidel method for a ReducedProblem. In each sweep, the cones are
   * solved exactly one after another (solve_one_cone) with the others fixed;
   * multipliers, if any, follow from all stresses. For associated flow it minimises the
   * convex function of eq (63) block by block and converges from any start; otherwise
   * it mostly converges.
   */
  struct GaussSeidel
  {
    double       tolerance  = 1e-8;   ///< on natural_map_error()
    unsigned int max_sweeps = 100000; ///< maximum

    /** Stop if, at the rate of the last half of the sweeps, the tolerance cannot be met
     *  within max_sweeps. */
    bool stops_if_slow = false;

    /**
     * @param[in,out] s in: the start (Pa, 3n); out: the solution
     * @return errors during sweeps are those of each cone when visited, at no extra
     * cost; the first and the last one are those of the full state
     */
    ReducedReport
    solve(const ReducedProblem &problem, Eigen::VectorXd &s) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
