// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduced_newton_h
#define geocone_reduced_reduced_newton_h

#include <geocone/reduced/reduced_problem.h>
#include <geocone/reduced/reduced_report.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Semismooth Newton method (eq 76) for a ReducedProblem in s, with
   * z = W s - C lambda + q eliminated and the multipliers, if any, as more
   * unknowns, for F(s) = 0 where F_p is one of
   *  - the natural map s - P_C(s - rho Psi(z)) (eqs 59, 62),
   *  - the return map  s - R(s - rho z), with R that of return_map() for
   *    K = 2G = rho, which has the flow in it and needs no change of variable.
   * They are the same for associated flow, and have the same roots otherwise.
   *
   * Where the elastic part S of W is known, the return map takes K and 2G from it,
   * s - R(s - S^-1 z). Then -B'F is the residual of the momentum balance at the
   * velocity that belongs to s, each step is that of Newton's method for this
   * velocity, and its length is that of line_search() with the directional
   * residual F.(dz - S ds), up to a factor: for associated flow there is always a
   * way down. Otherwise steps are halved until |F|^2 falls. Where it does not,
   * Gauss-Seidel sweeps lead on, twice as many each time. Where W has factors, the
   * stresses are eliminated point by point from each linear system, and a sparse one for
   * the free dofs is left. Otherwise J is factorised as a dense matrix where W has
   * more than one nonzero in twenty, and as a sparse one where it has less.
   */
  struct ReducedNewton
  {
    enum class Map
    {
      natural_map,
      return_map
    };

    double       tolerance      = 1e-10; ///< on natural_map_error()
    unsigned int max_iterations = 60;    ///< restarts included
    unsigned int restart_sweeps = 100;   ///< of the first one
    Map          map            = Map::return_map;

    /**
     * rho, the same for all cones as in the paper (Pa, for z a strain); 0: by S
     * for the return map if it is known, else that of the cone, 10 / (mean eigenvalue of W_pp), the best of 0.1, 1, 10, 100.
     */
    double rho = 0.;

    /** @param[in,out] s in: the start (Pa, 3n); out: the solution */
    ReducedReport
    solve(const ReducedProblem &problem, Eigen::VectorXd &s) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
