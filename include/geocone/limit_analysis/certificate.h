// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_certificate_h
#define geocone_limit_analysis_certificate_h

#include <geocone/limit_analysis/interior_point.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Admissible violation of the cones, relative to the largest stress, where
   *  stresses cannot be scaled back. */
  constexpr double rounding_strength = 1e-8;

  /** A bound with its certificate: all values are recomputed from the fields,
   *  independently of the solver. In units of the problem. */
  struct Bound
  {
    double      load      = 0.;
    bool        certified = false;
    std::string rejection; ///< reason for rejection, if not certified

    /** Largest violation before the repair: of the strength, relative to the largest
     *  stress, or of admissible flow, relative to the largest strain rate. */
    double violation = 0.;

    /** Lower bound: largest error of div s + body force and of tractions across edges
     *  and on the boundary, relative to the largest stress (over the cell's size).
     *  Upper bound: largest normal rate of cylinders, relative to the largest rate. */
    double error = 0.;

    /** Fields of the bound: scaled stresses at the points in cone axes, or repaired
     *  velocities of all dofs. The velocities of a lower bound are those of its dual:
     *  they show the failure mechanism but prove nothing. */
    std::vector<Eigen::Vector3d> s;
    Eigen::VectorXd              q;
  };

  /**
   * Certifies stresses: in the cone at the points, and hence everywhere since they are
   * linear, and in equilibrium with the loads to rounding. Where the strength is
   * exceeded, all stresses are scaled by theta = min k/(k + excess), which needs
   * cohesion and no dead load; otherwise 1e-8 of the largest stress is tolerated as
   * rounding.
   */
  Bound
  certify_lower(const BoundScene    &scene,
                const BoundProblem  &problem,
                const BoundSolution &solution);

  /**
   * Certifies velocities: -B q in K* at the points, and hence everywhere since rates
   * are linear. Cylinders are made incompressible by a projection. Elsewhere a
   * violation is removed by adding the uniaxial extension (0, y - y_bottom), if that
   * obeys the boundary conditions.
   */
  Bound
  certify_upper(const BoundScene    &scene,
                const BoundProblem  &problem,
                const BoundSolution &solution);

  /**
   * Contributions of the triangles to (upper - lower) f.v, which are not negative:
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
