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

      /** Of the lower side: |V s.e| of each triangle for its own velocities. */
      std::vector<double> power;
    };
    Side upper, lower;

    /** The part of each triangle in the gap, see gap_of_cells(). */
    std::vector<double> gap;

    /** What the next mesh is to make equal: those parts, and of the lower bound the power
     *  on its own velocities times the size of the triangle, which shows where its
     *  stresses are at their limit although the upper bound's mechanism is elsewhere. */
    std::vector<double> uneven;

    /** Their sum over the gap of the bounds; 1 where both fields are exact. */
    double gap_share = 0.;
  };

  /** Solves the problem of one side and certifies what is found.
   *  @param tolerance of the interior-point method, relative to the load */
  /** @{ */
  CertifiedBounds::Side
  certified_upper(const BoundScene &bound, const double tolerance);
  CertifiedBounds::Side
  certified_lower(const BoundScene &bound, const double tolerance);
  /** @} */

  /** Solves both problems of a mesh and certifies what is found.
   *  @param tolerance of the interior-point method, relative to the load */
  CertifiedBounds
  certified_bounds(const BoundScene &bound, const double tolerance);

  /** Both bounds of the load of Davis's soil on a mesh, an estimate for flow that is not
   *  associated (doc/theory/limit_analysis.md), in the unit of the load. */
  std::array<double, 2>
  davis_estimate(const BoundedLoad &load,
                 const Scene       &scene,
                 const Triangles   &triangles,
                 const double       tolerance);

  /**
   * Sizes that make the parts of the gap equal on the next mesh, where a part falls
   * with the size to the power 3: its mean with the cells around counts, as a coarse
   * cell beside others that are refined would have to wait for one more mesh.
   * @param gap CertifiedBounds::uneven
   * @param n_wanted about so many triangles
   */
  CellSizes
  sizes_by_gap(const Triangles           &triangles,
               const std::vector<double> &gap,
               const double               n_wanted);
} // namespace geocone::GEOCONE_DIM

#endif
