// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shakedown_shakedown_bounds_h
#define geocone_shakedown_shakedown_bounds_h

#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/output/simplex_table.h>
#include <geocone/shakedown/elastic_stresses.h>
#include <geocone/shakedown/varying_loads.h>

#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Largest ShakedownBounds::load_difference that is a rounding error. */
  constexpr double rounding_of_work = 1e-9;

  /** Shakedown factors of a plane body on one mesh, from below by Melan's theorem and from
   *  above by Koiter's (doc/theory/shakedown.md). */
  struct ShakedownBounds
  {
    /** Static and kinematic problem with the elastic stresses of the mesh; certified:
     *  the fields are admissible for these. */
    CertifiedSide lower, upper;

    /** Factor of the lower one with which the out-of-plane stresses are admissible,
     *  too, at most 1. */
    double out_of_plane = 1.;

    /** Upper bound that includes the error of the elastic stresses; infinite if this
     *  error exceeds the work, or both elastic stresses carry different loads. */
    double proven = std::numeric_limits<double>::infinity();

    /** Relative difference of the work of the loads of both elastic stresses. */
    double load_difference = 0.;

    /** Factor of alternating plasticity at a single point, with the elastic stresses of
     *  the mesh; infinite where phi > 0. */
    double alternating = std::numeric_limits<double>::infinity();

    /** Factor at first yield without residual stresses; NaN beside dead loads. */
    double elastic_limit = std::numeric_limits<double>::quiet_NaN();

    /** Largest error of the averaged elastic stresses of all loads, in the energy norm,
     *  relative to these stresses. */
    double elastic_error = 0.;

    /** @name Mechanism of the upper bound */
    /** @{ */
    double net_share   = 0.; ///< of plastic strains that remain after a cycle
    double state_share = 0.; ///< of plastic strains in the most active state
    unsigned int        state = 0;  ///< the most active one
    std::vector<double> net, total; ///< mean plastic strains of triangles (-)
    /** @} */

    std::vector<double> gap, refinement_indicator; ///< of triangles
    LinearField         residual; ///< stresses of the lower one
  };

  /** Computes both factors on a mesh.
   *  @param bound with tractions as loads, without interfaces, structures and cut-offs
   *  @param tolerance of the interior-point method, relative to the load
   *  @throws StepFailure if the elastic stresses are not found */
  ShakedownBounds
  shakedown_bounds(const BoundScene   &bound,
                   const VaryingLoads &loads,
                   const double        tolerance);

  /** Creates the field file of a mesh. The arguments must outlive the table. */
  SimplexTable<Triangles>
  table_of_shakedown(const BoundScene &bound, const ShakedownBounds &found);
} // namespace geocone::GEOCONE_DIM

#endif
