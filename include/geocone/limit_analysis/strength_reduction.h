// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_strength_reduction_h
#define geocone_limit_analysis_strength_reduction_h

#include <geocone/base/state_row.h>
#include <geocone/limit_analysis/certified_bounds.h>

#include <functional>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  /**
   * Factor of safety F of a body: the divisor of c and tan(phi) of all its materials at
   * the limit. Let lambda^-(F) and lambda^+(F) be the bounds of the factor of all
   * loads. F is safe if lambda^- >= 1: the zero stress and the stresses in equilibrium
   * with lambda^- times the loads are both admissible, and so are their convex
   * combinations, one of which carries the loads. F fails if lambda^+ <= 1. Both are
   * certificates that need no convergence.
   *
   * On each mesh the roots of both bounds are found by secants of log lambda over log
   * F, and each is confirmed by one more solution a thousandth on the safe side.
   */
  class StrengthReduction
  {
  public:
    /** Returns the scene with the strength divided by F, on the present mesh. */
    using Reduced = std::function<BoundScene(const double F)>;

    struct Level
    {
      /** Both bounds of the load at `factor`. */
      double          factor = 1.;
      CertifiedBounds bounds;

      /** Bounds of F certified on this mesh, if any. */
      std::optional<double> lower, upper;

      /** Fields of these bounds, computed near their roots. */
      CertifiedBounds::Side lower_proof, upper_proof;

      /** All factorisations on the mesh, of either problem. */
      unsigned int iterations_lower = 0, iterations_upper = 0;
    };

    /** @param tolerance of the interior-point method, relative to the load
     *  @throws StepFailure if the body does not fail for any factor, or fails
     *  for all of them */
    Level
    on_mesh(const Reduced &reduced, const double tolerance);

    void
    state(StateRow &row)
    {
      row(factor, exponent);
    }

  private:
    /** Certifies factors near the root of each usable bound. */
    void
    prove_root(const Reduced &reduced,
               const double   tolerance,
               Level         &level) const;

    double factor   = 1.; ///< initial value for the next mesh
    double exponent = 1.; ///< -d log lambda/d log F
  };
} // namespace geocone::GEOCONE_DIM

#endif
