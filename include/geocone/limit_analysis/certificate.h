// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_certificate_h
#define geocone_limit_analysis_certificate_h

#include <geocone/limit_analysis/interior_point.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** What stresses may be beyond their cones where they cannot be scaled back, over the
   *  largest of them. */
  constexpr double rounding_strength = 1e-8;

  /**
   * A bound, and what proves it: all is computed anew from the fields, whatever
   * solver made them. In units of the problem.
   */
  struct Bound
  {
    double      load      = 0.;
    bool        certified = false;
    std::string objection; ///< why it is not certified

    /** Largest violation before the repair: of the strength by stresses, over the
     *  largest stress; of admissible flow by strain rates, over the largest. */
    double violation = 0.;

    /** Lower bound: largest error of div s + body force, of tractions across edges
     *  and on the boundary, over the largest stress (over the cell's size). Upper
     *  bound: largest normal rate of cylinders over the largest rate. */
    double error = 0.;

    /** The fields of the bound: stresses at the points in cone axes, scaled, or
     *  velocities of all dofs, repaired. A lower bound's velocities are those of its
     *  dual, which show how it would fail and prove nothing. */
    std::vector<Eigen::Vector3d> s;
    Eigen::VectorXd              q;
  };

  /**
   * Checks stresses: in the cone at the points, which linear stresses then are
   * everywhere, and in equilibrium with the loads to rounding. Where the strength
   * is exceeded, all stresses are scaled by theta = min k/(k + excess), which needs
   * cohesion and no dead load; otherwise 1e-8 of the largest stress is left to
   * rounding.
   */
  Bound
  certify_lower(const BoundScene    &scene,
                const BoundProblem  &problem,
                const BoundSolution &solution);

  /**
   * Checks velocities: -B q in K* at the points, which linear rates then are
   * everywhere. Cylinders are made incompressible by a projection; elsewhere a
   * violation is removed by adding the uniaxial extension (0, y - y_bottom), where
   * that obeys the boundary conditions.
   */
  Bound
  certify_upper(const BoundScene    &scene,
                const BoundProblem  &problem,
                const BoundSolution &solution);

  /**
   * The parts of the triangles in (upper - lower) f.v, which are not negative:
   *   eta_T = sum_i A/3 D(e_i) - sum_ij A/12 (1 + delta_ij) s_i . e_j
   * with e of the upper and s of the lower bound (Ciria, Peraire and Bonet 2008).
   */
  std::vector<double>
  gap_of_cells(const BoundProblem &upper_problem,
               const Bound        &upper,
               const Bound        &lower);

  /**
   * The dissipation of a point at a strain rate in cone axes, per volume. With a cut-off
   * it is the infimal convolution of those of cone and cut-off,
   *   opening (-e_n) + (k - a opening) (|e_t| + e_n)^+/(1 - a).
   */
  double
  dissipation(const PointCone &cone, const Eigen::Vector3d &rate);
} // namespace geocone::GEOCONE_DIM

#endif
