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
   * The factor of safety F of a body: that by which c and tan(phi) of all its
   * materials are divided at the limit. With the bounds lambda^-(F) and lambda^+(F)
   * of the factor of all loads, F is safe if lambda^- >= 1 (all loads at once are
   * then borne, as stresses in equilibrium with nothing and with lambda^- times the
   * loads are both within the strength, and so is what lies between), and fails if
   * lambda^+ <= 1. Both are certificates: no convergence is asked for.
   *
   * On each mesh the roots of both bounds are found by secants of log lambda over
   * log F, and confirmed by one more solution a thousandth on the safe side.
   */
  class StrengthReduction
  {
  public:
    /** The scene with the strength divided by F, on the present mesh. */
    using Reduced = std::function<BoundScene(const double F)>;

    struct Level
    {
      /** Both bounds of the load at the factor. */
      double          factor = 1.;
      CertifiedBounds bounds;

      /** What has been proven on this mesh, if anything. */
      std::optional<double> lower, upper;

      /** All factorisations of the mesh, of either problem. */
      unsigned int iterations_lower = 0, iterations_upper = 0;
    };

    /** @param tolerance of the interior-point method, relative to the load
     *  @throws StepFailure if no factor makes the body fail, or none bears its
     *  loads */
    Level
    on_mesh(const Reduced &reduced, const double tolerance);

    void
    state(StateRow &row)
    {
      row(factor, exponent);
    }

  private:
    /** Proves factors near the root of each bound that is usable. */
    void
    prove_root(const Reduced &reduced,
               const double   tolerance,
               Level         &level) const;

    double factor   = 1.; ///< from where the next mesh begins
    double exponent = 1.; ///< -d log lambda/d log F
  };
} // namespace geocone::GEOCONE_DIM

#endif
