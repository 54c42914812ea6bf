// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_interior_point_h
#define geocone_limit_analysis_interior_point_h

#include <geocone/limit_analysis/bound_problem.h>

#include <limits>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Result of the interior-point method for a plane problem of limit analysis. */
  struct BoundSolution
  {
    Eigen::VectorXd              q; ///< velocities of all dofs
    std::vector<Eigen::Vector3d> s; ///< stress in cone axes
    double                       load           = 0.; ///< lambda, by stresses
    unsigned int                 factorisations = 0;
    bool                         converged      = false;
    std::string                  reason; ///< cause of non-convergence
    bool grows = false;                  ///< unbounded stresses: no limit load
  };

  /**
   * Interior-point solver for the static and the kinematic programme of plane limit
   * analysis. They are a primal-dual pair:
   *   static max lambda: sum V Bs' (x - o) = lambda f + F0, x in K,
   *   kinematic min sum V o.z - F0.q: z = -Bs q in K, f.q = 1,
   * with x = (a s_n + k, s_t), Bs = diag(1/a, 1, 1) B, o = (k, 0, 0), K = {x_0 >= |x_t|}.
   * The primal-dual method starts from an infeasible point, with Nesterov-Todd scaling,
   * Mehrotra's corrector, and a unit weight of each cone in the barrier (rates times
   * V/mean V). For Tresca's cylinder x_0 = k is eliminated at the point, and s_n is found
   * by the method of multipliers. Each iteration requires one sparse Cholesky
   * factorisation.
   *
   * Stresses must be in equilibrium to rounding. The residual of an iterate is removed in
   * the metric of its cones, which violates them less the farther the iterate is from
   * their boundaries: the last iterate is not always the best one. If stresses are
   * returned, they are those of the iterate with the highest load after all stresses are
   * scaled back into their cones.
   */
  class InteriorPoint
  {
  public:
    struct Options
    {
      double       tolerance      = 1e-4; ///< duality gap / load
      double       flow_tolerance = 1e-8; ///< |z + Bs q| relative to |Bs q|
      double       flow_margin    = 0.;   ///< margin of -Bs q in K over |Bs q|
      double       equilibrium_tolerance = 1e-4; ///< residual / forces
      unsigned int max_iterations        = 60;

      /** True to return the stresses of the lower bound, false to return the
       *  velocities of the upper bound. */
      bool stresses = false;

      /** Reduction of the strength k that keeps the computed stresses inside
       *  the yield cones with a safety margin. Stresses that cannot be scaled
       *  back then become admissible after fewer iterations. */
      double strength_margin = 0.;

      unsigned int correctors = 2; ///< maximum number per iteration

      /** Load with which the bound is compared; NaN: the optimal bound is computed. The
       *  iterations end as soon as a lower bound (stresses) above this load, or an upper
       *  bound (velocities) below this load, is found or excluded. */
      double question = std::numeric_limits<double>::quiet_NaN();
    };

    static BoundSolution
    solve(const BoundProblem &problem, const Options &options);
  };
} // namespace geocone::GEOCONE_DIM

#endif
