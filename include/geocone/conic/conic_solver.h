// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_conic_solver_h
#define geocone_conic_conic_solver_h

#include <geocone/conic/bound_verdict.h>
#include <geocone/conic/point_group.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Primal and dual conic programme of limit analysis, for groups of points
   * with symmetric cones. The static and the kinematic programme are
   *   static    max lambda: sum V B's = lambda f + F0 in free dofs, X = k o - A y in K,
   *   kinematic min sum V/w k o.Z - F0.q: A'Z = (w B q, 0), Z in K, f.q = 1.
   * If f = 0, velocities are prescribed, and the load is the power of their reactions.
   */
  struct ConicProblem
  {
    std::vector<std::unique_ptr<PointGroup>> groups;

    std::vector<bool> is_prescribed; ///< true for prescribed dofs
    Eigen::VectorXd   prescribed;    ///< prescribed velocities; 0 elsewhere
    Eigen::VectorXd   dead, live;    ///< F0 and f by dof

    /** Least strength of the initial stresses of soil with friction: stresses of soil
     *  that hardly has cohesion are far from its apex. */
    double least_start = 0.;

    /** Returns a problem without points, loads and prescribed velocities. */
    static ConicProblem
    of_dofs(const unsigned int n_dofs)
    {
      ConicProblem problem;
      problem.is_prescribed.assign(n_dofs, false);
      problem.prescribed.setZero(n_dofs);
      problem.dead.setZero(n_dofs);
      problem.live.setZero(n_dofs);
      return problem;
    }

    unsigned int
    n_dofs() const
    {
      return prescribed.size();
    }
    bool
    has_factor() const
    {
      return live.squaredNorm() > 0.;
    }
    bool
    has_free_direction() const;
    unsigned int
    n_unknowns() const;
  };

  struct ConicOptions
  {
    double       tolerance      = 1e-3; ///< duality gap, relative to the load
    double       flow_tolerance = 1e-8; ///< relative to |B q|
    double       equilibrium_tolerance = 1e-7; ///< residual / forces
    double       flow_margin    = 0.; ///< of rates in their cones, likewise
    unsigned int max_iterations = 80;

    /** True to return the stresses of the lower bound, false to return the
     *  velocities of the upper bound. */
    bool stresses = false;

    /** Reduction of the strength k that keeps the computed stresses inside
     *  the yield cones with a safety margin, where stresses cannot be scaled back
     *  (dead loads, no cohesion): they are then admissible after fewer iterations. */
    double strength_margin = 0.;

    /** Load with which the bound is compared; NaN: the optimal bound is computed. The
     *  iterations end as soon as a lower bound (stresses) above this load, or an upper
     *  bound (velocities) below this load, is found or excluded. */
    double question = std::numeric_limits<double>::quiet_NaN();

    /** Gap at which the answer that the optimum of the mesh does not answer the question is
     *  given, as a part of the distance of the bound from it: how far it is, is then known
     *  to this part. */
    double located = std::numeric_limits<double>::infinity();
  };

  struct ConicSolution
  {
    Eigen::VectorXd q;                   ///< velocities of all dofs
    double          load           = 0.; ///< lambda, by stresses
    unsigned int    factorisations = 0;
    bool            converged      = false;
    std::string     reason;        ///< cause of non-convergence
    bool            grows = false; ///< unbounded stresses: no limit load
  };

  /**
   * Solves a conic problem of limit analysis by a primal-dual interior-point
   * method. The method starts from an infeasible point, with Nesterov-Todd scaling,
   * Mehrotra's corrector and Gondzio's further correctors, for any symmetric cones, all
   * of which have the same weight in the barrier. Cone variables are eliminated at each
   * point, so that an iteration requires only one sparse Cholesky factorisation with the
   * sparsity pattern of the elastic stiffness. Constrained rates (e.g. the
   * volumetric strain rate for phi = 0) are found by the method of multipliers.
   *
   * Stresses must be in equilibrium to rounding. The residual of an iterate is removed in
   * the metric of its cones, which violates them less the farther the iterate is from
   * their boundaries: the last iterate is not always the best one. If stresses are
   * returned, they are those of the iterate with the highest load after all stresses are
   * scaled back into their cones. The stresses of the solution are stored in the groups.
   */
  ConicSolution
  solve(ConicProblem &problem, const ConicOptions &options);

  /** Solves a conic problem for velocities that an upper bound can certify: constrained
   *  rates vanish, and others lie inside their cones by a margin, which costs its part of
   *  the load and is raised while rates miss the cones.
   *  @param tolerance duality gap, relative to the load
   *  @param certify verdict on velocities; its last call has those that are returned */
  ConicSolution
  solve_for_velocities(
    ConicProblem                                                &problem,
    const double                                                 tolerance,
    const std::function<BoundVerdict(const Eigen::VectorXd &q)> &certify);

  /** Projects velocities onto the subspace in which all constrained strain rates vanish.
   *  The projection is orthogonal in the metric of B'B. For phi = 0 the constrained rates
   *  are volumetric strain rates and normal jumps.
   *  @return true if the projection succeeded */
  bool
  constrain_rates(ConicProblem &problem, Eigen::VectorXd &q);
} // namespace geocone

#endif
