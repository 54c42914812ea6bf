// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduced_newton_h
#define geocone_reduced_reduced_newton_h

#include <geocone/reduced/reduced_problem.h>
#include <geocone/reduced/reduced_report.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Semismooth Newton method for the incremental problem in stresses (ReducedProblem;
   * Guillet et al. 2025, eq 76). The variable z = W s - C lambda + q is eliminated;
   * multipliers are additional unknowns. The method solves F(s) = 0, where F_p is one
   * of
   *  - the natural map s - P_C(s - rho Psi(z)) (eqs 59, 62),
   *  - the return map s - R(s - rho z), with R = return_map() for K = 2G = rho, which
   *    includes the flow rule and requires no change of variable.
   * Both maps coincide for associated flow, and have the same roots for non-associated
   * flow.
   *
   * If the elastic part S of W is known, the return map uses K and 2G of S, s - R(s -
   * S^-1 z). Then -B'F is the residual of the momentum balance at the velocity
   * corresponding to s, and each step equals a step of Newton's method for this
   * velocity. The step length follows from line_search() with the directional residual
   * F.(dz - S ds), up to a factor: for associated flow a descent direction always
   * exists. If S is unknown, steps are halved until |F|^2 decreases. If |F|^2 does not
   * decrease, Gauss-Seidel sweeps follow, with the number of sweeps doubled each time.
   * If W has factors, the stresses are eliminated from each linear system point by
   * point, which results in a sparse system for the free dofs. Otherwise the Jacobian J
   * is factorised as a dense matrix if more than 5 % of the entries of W are nonzero, or
   * else as a sparse matrix.
   */
  struct ReducedNewton
  {
    enum class Map
    {
      natural_map,
      return_map
    };

    double       tolerance      = 1e-10; ///< for natural_map_error()
    unsigned int max_iterations = 60;    ///< iterations, restarts included
    unsigned int restart_sweeps = 100;   ///< sweeps of the first restart
    Map          map            = Map::return_map;

    /**
     * Scale rho of the natural map s - P_C(s - rho y) or of the return mapping,
     * equal for all cones (Pa if z is a strain). Guillet et al. 2025 use such a
     * scale. If rho is 0, the return map takes K and 2G from S, if S is known;
     * otherwise the scale of each cone is 10 / (mean eigenvalue of W_pp), the
     * best of the factors 0.1, 1, 10, 100.
     */
    double rho = 0.;

    /** Solves the reduced problem by Newton's method.
     *  @param[in,out] s in: initial guess (Pa, 3n components); out: solution */
    ReducedReport
    solve(const ReducedProblem &problem, Eigen::VectorXd &s) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
