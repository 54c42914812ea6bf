// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_certificate_h
#define geocone_solid_bounds_solid_certificate_h

#include <geocone/conic/bound_verdict.h>
#include <geocone/solid_bounds/solid_bounds.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Upper or lower bound in three dimensions with its certificate, in scaled units. All
   *  values are recomputed from the fields and the geometry, without the matrices of the
   *  solver. */
  struct SolidBound : BoundVerdict
  {
    unsigned int factorisations = 0, n_unknowns = 0;
    bool         converged = false;
    std::string  reason; ///< cause of non-convergence
    bool         grows = false;

    /** Certified stresses (lower bound) or velocities (upper bound) at the nodes of all
     *  cells. */
    std::vector<Mandel>                 stress;
    std::vector<dealii::Tensor<1, dim>> velocity;

    /** Load factor of the lower bound for which the stresses are in
     *  equilibrium, before the stresses are scaled. */
    double lambda = 0.;

    /** Dissipation of the upper bound in each cell and in the velocity jump on
     *  each facet. The power of the loads that the load factor multiplies is
     *  `work`, 1 for prescribed velocities. */
    std::vector<double> dissipation_of_cell, dissipation_of_facet;
    double              work = 1.;

    /** Power of the stresses of the lower bound in each cell with the velocities that are
     *  its dual variables. It is large where the stresses limit the load. */
    std::vector<double> dual_power;
  };

  /**
   * Certifies a lower bound by checking its stresses. Coefficients must be in the cone,
   * with the rounding of eigenvalues on the safe side, and equilibrium must hold to 1e-8.
   * If the strength is exceeded, all stresses are scaled if there is no dead load;
   * otherwise the bound is rejected.
   * @param stress of the nodes of all cells (simplex_nodes)
   */
  SolidBound
  certify_lower(const SolidScene          &bound,
                const unsigned int         order,
                const std::vector<Mandel> &stress,
                const double               lambda);

  /**
   * Certifies an upper bound by checking its velocities. Strain rates and jumps at all
   * points must be admissible for the flow rule, with rounding on the safe side. For phi
   * = 0 volumetric strain rates and normal jumps must vanish to 1e-8.
   * @param velocity of the nodes of all cells
   */
  SolidBound
  certify_upper(const SolidScene                          &bound,
                const unsigned int                         order,
                const std::vector<dealii::Tensor<1, dim>> &velocity);

  /** Solves the upper-bound problem on a mesh and certifies the upper bound.
   *  @param order polynomial order of the velocities
   *  @param tolerance of the interior-point method, relative to the load */
  SolidBound
  certified_upper(const SolidScene  &bound,
                  const unsigned int order,
                  const double       tolerance);

  /** Solves the lower-bound problem on a mesh and certifies the lower bound.
   *  @param order polynomial order of the stresses
   *  @param tolerance of the interior-point method, relative to the load */
  SolidBound
  certified_lower(const SolidScene  &bound,
                  const unsigned int order,
                  const double       tolerance);
} // namespace geocone::GEOCONE_DIM

#endif
