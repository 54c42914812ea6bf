// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_interior_point_h
#define geocone_limit_analysis_interior_point_h

#include <geocone/limit_analysis/bound_problem.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Where an interior-point method ended. */
  struct BoundSolution
  {
    Eigen::VectorXd              q;                   ///< velocities, all dofs
    std::vector<Eigen::Vector3d> s;                   ///< stress in cone axes
    double                       load           = 0.; ///< by the stresses
    unsigned int                 factorisations = 0;
    bool                         converged      = false;
    std::string                  reason; ///< why it did not converge
    bool                         grows =
      false; ///< with stresses beyond all bounds: no load is the limit
  };

  /**
   * The pair of programmes of a BoundProblem,
   *   static    max lambda: sum V Bs' (x - o) = lambda f + F0, x in K,
   *   kinematic min sum V o.z - F0.q: z = -Bs q in K, f.q = 1,
   * with x = (a s_n + k, s_t), Bs = diag(1/a, 1, 1) B, o = (k, 0, 0), K = {x_0 >=
   * |x_t|}, by a primal-dual interior-point method from an infeasible start, with
   * the scaling of Nesterov and Todd, Mehrotra's corrector, and a unit weight of
   * each cone in the barrier (rates times V/mean V). For Tresca's cylinder x_0 = k
   * is eliminated in the point, and s_n is found by the method of multipliers. One
   * sparse Cholesky factorisation per iteration.
   *
   * Stresses are to be in equilibrium to rounding. What an iterate lacks is added in
   * the metric of its cones, which leaves them by the less the farther the iterate
   * is from their borders: the last one is not always the best of them. Where they
   * count, the stresses are those of the iterate whose load, scaled back until all
   * are in their cones, is the highest.
   */
  class InteriorPoint
  {
  public:
    struct Options
    {
      double       tolerance      = 1e-4; ///< inner gap, relative to the load
      double       flow_tolerance = 1e-8; ///< |z + Bs q| relative to |Bs q|
      double       flow_margin = 0.; ///< -Bs q is to be so far in K, likewise
      double       equilibrium_tolerance = 1e-4; ///< relative to the forces
      unsigned int max_iterations        = 60;

      /** Whether the stresses of the iterates count, and not the velocities. */
      bool stresses = false;

      /** What stresses are to be in their cones by, as if k were so much less: what
       *  cannot be scaled back into them is then in them soon. */
      double strength_margin = 0.;

      unsigned int correctors = 2; ///< at most, of an iteration
    };

    static BoundSolution
    solve(const BoundProblem &problem, const Options &options);
  };
} // namespace geocone::GEOCONE_DIM

#endif
