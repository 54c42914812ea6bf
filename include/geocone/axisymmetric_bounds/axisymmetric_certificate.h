// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_axisymmetric_bounds_axisymmetric_certificate_h
#define geocone_axisymmetric_bounds_axisymmetric_certificate_h

#include <geocone/axisymmetric_bounds/axisymmetric_bounds.h>
#include <geocone/plane_bounds/certified_side.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Certifies the lower bound of an axisymmetric body by checking its stresses.
   * The coefficients of equilibrium in all triangles and of the tractions across all
   * edges must vanish to 1e-8, and those of the stresses must be admissible, with the
   * rounding of eigenvalues on the safe side. If the strength is exceeded, all stresses are scaled if there is no
   * dead load; otherwise the bound is rejected.
   * @param stress coefficients of the stresses times r of all triangles
   * @param lambda load factor for which the stresses are in equilibrium
   */
  Bound
  certify_lower(const AxisymmetricScene          &scene,
                const std::vector<SpatialMandel> &stress,
                const double                      lambda);

  /** Dissipation and work of the upper bound of an axisymmetric body. */
  struct AxisymmetricPower
  {
    std::vector<double> of_cell, of_edge; ///< dissipation
    double              work = 1.; ///< of the loads that the factor multiplies
  };

  /**
   * Certifies the upper bound of an axisymmetric body by checking its velocities. The
   * coefficients of strain rates and jumps must be admissible for the flow rule, with
   * rounding on the safe side. For phi = 0 volumetric strain rates and normal jumps must
   * vanish to 1e-8.
   * @param q dofs of the upper-bound problem
   */
  Bound
  certify_upper(const AxisymmetricScene &scene,
                const Eigen::VectorXd   &q,
                AxisymmetricPower       &power);

  /** Solves the upper-bound problem of an axisymmetric body and certifies the upper
   *  bound. @param tolerance of the interior-point method, relative to the load */
  CertifiedSide
  certified_upper(const AxisymmetricScene &scene,
                  const double             tolerance,
                  AxisymmetricPower       &power);

  /** Solves the lower-bound problem of an axisymmetric body and certifies the lower
   *  bound. @param tolerance of the interior-point method, relative to the load */
  CertifiedSide
  certified_lower(const AxisymmetricScene &scene, const double tolerance);

  /**
   * Returns the contribution of each triangle to the gap between the bounds: the
   * dissipation of the upper bound less the internal power of the lower bound's stresses,
   * in the triangle and at its edges, half of which belongs to each side. No contribution
   * is negative if the strength is constant.
   */
  std::vector<double>
  gap_of_cells(const AxisymmetricScene &scene,
               const Bound             &upper,
               const AxisymmetricPower &power,
               const Bound             &lower);

  /** Returns the stress (s_rr, s_zz, sqrt2 s_rz, s_tt) of the lower bound at a vertex of
   *  a triangle. On the axis it is the limit along an edge from the vertex. */
  SpatialMandel
  stress_at_vertex(const BoundScene  &bound,
                   const Bound       &lower,
                   const unsigned int cell,
                   const unsigned int vertex);

  /** Returns the multipliers of equilibrium of the lower-bound problem at a vertex of a
   *  triangle, velocities (v_r, v_z) that show the failure mechanism. */
  dealii::Tensor<1, dim>
  multiplier_at_vertex(const Eigen::VectorXd &q,
                       const unsigned int     cell,
                       const unsigned int     vertex);

  /** Returns the velocity (v_r, v_z) of the upper bound at a vertex of a triangle.
   *  @param q dofs of the upper-bound problem */
  dealii::Tensor<1, dim>
  velocity_at_vertex(const Eigen::VectorXd &q,
                     const unsigned int     cell,
                     const unsigned int     vertex,
                     const double           radius);
} // namespace geocone::GEOCONE_DIM

#endif
