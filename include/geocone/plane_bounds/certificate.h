// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_certificate_h
#define geocone_plane_bounds_certificate_h

#include <geocone/conic/bound_verdict.h>
#include <geocone/plane_bounds/bound_solution.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Largest permitted violation of the yield cones by certified stresses,
   *  relative to the largest stress. It applies if stresses cannot be scaled
   *  back. */
  constexpr double rounding_strength = 1e-8;

  /** Upper or lower bound on the load with its certificate, in scaled units. All values
   *  are recomputed from the stress or velocity field, independently of the solver. */
  struct Bound : BoundVerdict
  {
    /** Certified stresses (lower bound) or velocities (upper bound). For a lower bound:
     *  scaled stresses at the points in cone axes. For an upper bound: repaired
     *  velocities of all dofs. The velocities of a lower bound are dual variables, which
     *  show the failure mechanism but are not certified. */
    std::vector<Eigen::Vector3d> s;
    Eigen::VectorXd              q;

    /** Coefficients of the certified stresses of an axisymmetric body times r
     *  (axisymmetric_stress), instead of `s`. */
    std::vector<SpatialMandel> stress;
  };

  /**
   * Certifies a lower bound by checking that its stresses satisfy equilibrium and
   * the yield condition. The stresses must lie inside the yield cones at the points, hence
   * everywhere since they are linear, and be in equilibrium with the loads to
   * rounding. If the strength is exceeded, all stresses are scaled by theta =
   * min k/(k + excess). This requires cohesion and no dead load; otherwise the
   * tolerance for rounding is 1e-8 of the largest stress.
   */
  Bound
  certify_lower(const BoundScene    &scene,
                const BoundProblem  &problem,
                const BoundSolution &solution);

  /**
   * Certifies an upper bound by checking that its velocities satisfy the flow
   * rule. They must satisfy the flow rule, -B q in K*, at the points, hence
   * everywhere since strain rates are linear. For cylinders, a projection
   * removes volumetric strain rates. For other cones, violations are removed by
   * adding the uniaxial extension (0, y - y_bottom), if it satisfies the
   * boundary conditions.
   */
  Bound
  certify_upper(const BoundScene    &scene,
                const BoundProblem  &problem,
                const BoundSolution &solution);

  /**
   * Computes the contribution of each triangle to the gap between upper and lower bound.
   * The contributions eta_T are non-negative and sum to (upper - lower) f.v:
   *   eta_T = sum_i A/3 D(e_i) - sum_ij A/12 (1 + delta_ij) s_i . e_j
   * with e of the upper and s of the lower bound (Ciria, Peraire and Bonet 2008).
   */
  std::vector<double>
  gap_of_cells(const BoundProblem &upper_problem,
               const Bound        &upper,
               const Bound        &lower);

  /**
   * Returns the dissipation per unit volume at a point for a strain rate in cone axes.
   * With a cut-off it is the infimal convolution of the dissipation functions of cone and
   * cut-off,
   *   cut_off (-e_n) + (k - a cut_off) (|e_t| + e_n)^+/(1 - a).
   */
  double
  dissipation(const PointCone &cone, const Eigen::Vector3d &rate);
} // namespace geocone::GEOCONE_DIM

#endif
