// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_certified_bounds_h
#define geocone_limit_analysis_certified_bounds_h

#include <geocone/limit_analysis/bounded_load.h>
#include <geocone/limit_analysis/certificate.h>
#include <geocone/mesh/fitted_mesh.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Both bounds of the load on a mesh, in units of the problem. */
  struct CertifiedBounds
  {
    struct Side
    {
      BoundSolution solution;
      Bound         bound;
      unsigned int  n_unknowns = 0;

      /** Lower bound: |V s.e| of each triangle, with e of the lower-bound
       *  velocities. */
      std::vector<double> power;
    };
    Side upper, lower;

    /** Contribution of each triangle to the gap, see gap_of_cells(). */
    std::vector<double> gap;

    /**
     * Refinement indicator, equal for all triangles of an ideal mesh:
     * contribution to the gap, plus the power of the lower-bound stresses on
     * the lower-bound velocities, times the size of the triangle. The latter
     * marks stresses at yield away from the upper bound's mechanism.
     */
    std::vector<double> uneven;

    /** Sum of the contributions over the gap; 1 where both fields are exact. */
    double gap_share = 0.;
  };

  /** Solves the problem of one side and certifies the result.
   *  @param tolerance of the interior-point method, relative to the load */
  /** @{ */
  CertifiedBounds::Side
  certified_upper(const BoundScene &bound, const double tolerance);
  CertifiedBounds::Side
  certified_lower(const BoundScene &bound, const double tolerance);
  /** @} */

  /** Solves both problems of a mesh and certifies the results.
   *  @param tolerance of the interior-point method, relative to the load */
  CertifiedBounds
  certified_bounds(const BoundScene &bound, const double tolerance);

  /** Both bounds of the load for Davis's soil on a mesh, in the unit of the load: an
   *  estimate for non-associated flow (doc/theory/limit_analysis.md). */
  std::array<double, 2>
  davis_estimate(const BoundedLoad &load,
                 const Scene       &scene,
                 const Triangles   &triangles,
                 const double       tolerance);
} // namespace geocone::GEOCONE_DIM

#endif
