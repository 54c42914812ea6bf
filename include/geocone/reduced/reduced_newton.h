// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduced_newton_h
#define geocone_reduced_reduced_newton_h

#include <geocone/reduced/reduced_problem.h>
#include <geocone/reduced/reduced_report.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Semismooth Newton method (eq 76) for a ReducedProblem in s, with z = W s - C lambda
   * + q eliminated and the multipliers, if any, as additional unknowns. It solves F(s)
   * = 0, where F_p is one of
   *  - the natural map s - P_C(s - rho Psi(z)) (eqs 59, 62),
   *  - the return map s - R(s - rho z), with R that of return_map() for K = 2G = rho,
   *    which includes the flow rule and needs no change of variable.
   * They coincide for associated flow, and have the same roots otherwise.
   *
   * If the elastic part S of W is known, the return map takes K and 2G from it, s - R(s
   * - S^-1 z). Then -B'F is the residual of the momentum balance at the velocity that
   * corresponds to s, and each step is that of Newton's method for this velocity. The
   * step length is that of line_search() with the directional residual F.(dz - S ds),
   * up to a factor: for associated flow a descent direction always exists. If S is
   * unknown, steps are halved until |F|^2 decreases. If it does not, Gauss-Seidel
   * sweeps follow, twice as many each time. If W has factors, the stresses are
   * eliminated from each linear system point by point, which leaves a sparse one for
   * the free dofs. Otherwise J is factorised as a dense matrix if more than one in
   * twenty entries of W is nonzero, else as a sparse one.
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
     * Scale rho, the same for all cones as in the paper (Pa, for z a strain). 0: from S
     * for the return map if S is known, else that of the cone, 10 / (mean eigenvalue of
     * W_pp), the best of 0.1, 1, 10, 100.
     */
    double rho = 0.;

    /** @param[in,out] s in: the start (Pa, 3n); out: the solution */
    ReducedReport
    solve(const ReducedProblem &problem, Eigen::VectorXd &s) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
