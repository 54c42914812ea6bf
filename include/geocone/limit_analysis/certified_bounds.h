// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_certified_bounds_h
#define geocone_limit_analysis_certified_bounds_h

#include <geocone/limit_analysis/bounded_load.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/plane_bounds/certified_side.h>

#include <array>
#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Certified lower and upper bounds on the load, computed on one mesh, in
   *  scaled units. */
  struct CertifiedBounds
  {
    CertifiedSide upper, lower;

    /** Contribution of each triangle to the gap between the bounds, see
     *  gap_of_cells(). */
    std::vector<double> gap;

    /**
     * Refinement indicator of each triangle, which is equal for all triangles
     * of an optimal mesh. It is the contribution to the gap, plus a multiple of
     * the internal power of the lower bound times the size of the triangle. The
     * power marks stresses at yield away from the upper bound's mechanism.
     */
    std::vector<double> refinement_indicator;

    /** Sum of the contributions of all triangles to the gap, relative to the
     *  gap (1 if both fields are exact). */
    double gap_share = 0.;
  };

  /** Load with which a bound is compared, see ConicOptions. */
  struct BoundQuestion
  {
    double load    = std::numeric_limits<double>::quiet_NaN();
    double located = std::numeric_limits<double>::infinity();
  };

  /** Solves the upper-bound problem and certifies the upper bound.
   *  @param tolerance of the interior-point method, relative to the load */
  CertifiedSide
  certified_upper(const BoundScene &bound, const double tolerance);

  /** Solves the lower-bound problem and certifies the lower bound.
   *  @param tolerance of the interior-point method, relative to the load */
  CertifiedSide
  certified_lower(const BoundScene &bound, const double tolerance);

  /** Solves a given upper-bound problem until it is decided whether the upper
   *  bound is below a given load. See BoundQuestion. */
  CertifiedSide
  certified_upper(const BoundScene    &bound,
                  const BoundProblem  &above,
                  const double         tolerance,
                  const BoundQuestion &question);

  /** Solves a given lower-bound problem until it is decided whether the lower
   *  bound is above a given load. See BoundQuestion. */
  CertifiedSide
  certified_lower(const BoundScene    &bound,
                  const BoundProblem  &below,
                  const double         tolerance,
                  const BoundQuestion &question);

  /** Solves the upper-bound and lower-bound problems on a mesh and certifies the results.
   *  @param tolerance of the interior-point method, relative to the load */
  CertifiedBounds
  certified_bounds(const BoundScene &bound, const double tolerance);

  /** Returns the refinement indicator of each triangle
   *  (CertifiedBounds::refinement_indicator).
   *  @param gap contribution of each triangle to the gap
   *  @param lower solution of the lower bound */
  std::vector<double>
  uneven_gap(const BoundScene          &bound,
             const std::vector<double> &gap,
             const CertifiedSide       &lower);

  /** Computes Davis's estimate of the load for non-associated flow, in the unit of the
   *  load. It consists of both bounds for Davis's equivalent material on a mesh
   *  (doc/theory/limit_analysis.md). */
  std::array<double, 2>
  davis_estimate(const BoundedLoad &load,
                 const Scene       &scene,
                 const Triangles   &triangles,
                 const double       tolerance);
} // namespace geocone::GEOCONE_DIM

#endif
