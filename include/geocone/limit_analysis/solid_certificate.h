// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_solid_certificate_h
#define geocone_limit_analysis_solid_certificate_h

#include <geocone/limit_analysis/solid_bounds.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A three-dimensional bound with its certificate: all values are recomputed from the
   *  fields and the geometry, without the matrices of the solver. In units. */
  struct SolidBound
  {
    double      load      = 0.;
    bool        certified = false;
    std::string rejection; ///< reason for rejection, if not certified

    /** Largest violation of the strength, relative to the largest stress, or of admissible
     *  flow, relative to the largest strain rate or jump. */
    double violation = 0.;

    /** Lower bound: largest error of div s + body force (times the size of the cell) and of
     *  tractions across faces and on the boundary, relative to the largest stress. Upper
     *  bound: largest change of volume and normal jump where phi = 0, relative to the
     *  largest rate and jump. */
    double error = 0.;

    unsigned int factorisations = 0, n_unknowns = 0;
    bool         converged = false;
    std::string  reason; ///< why the method did not converge
    bool         grows = false;

    /** Lower bound: stresses of the nodes of all cells. Upper bound: velocities of the
     *  nodes of all cells. */
    std::vector<Mandel>                 stress;
    std::vector<dealii::Tensor<1, dim>> velocity;
  };

  /**
   * Certifies stresses: coefficients in the cone, with the rounding of eigenvalues on the
   * safe side, and equilibrium to 1e-8. Where the strength is exceeded, all stresses are
   * scaled if there is no dead load; otherwise the bound is rejected.
   * @param stress of the nodes of all cells (simplex_nodes)
   */
  SolidBound
  certify_lower(const SolidScene          &bound,
                const unsigned int         order,
                const std::vector<Mandel> &stress,
                const double               lambda);

  /**
   * Certifies velocities: rates and jumps at all points in the cones of flow, with rounding
   * on the safe side; for phi = 0 volume and normal jumps vanish to 1e-8.
   * @param velocity of the nodes of all cells
   */
  SolidBound
  certify_upper(const SolidScene                          &bound,
                const unsigned int                         order,
                const std::vector<dealii::Tensor<1, dim>> &velocity);

  /** Solves the problem of one side on a mesh and certifies the result.
   *  @param order of velocities or stresses
   *  @param tolerance of the interior-point method, relative to the load */
  /** @{ */
  SolidBound
  certified_upper(const SolidScene  &bound,
                  const unsigned int order,
                  const double       tolerance);
  SolidBound
  certified_lower(const SolidScene  &bound,
                  const unsigned int order,
                  const double       tolerance);
  /** @} */
} // namespace geocone::GEOCONE_DIM

#endif
