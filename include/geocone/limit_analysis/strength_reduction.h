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
   * Strict bounds of the factor of safety F of a body. F is the divisor of c and tan(phi)
   * of all materials at which the limit state is reached. Let lambda^-(F) and lambda^+(F)
   * be the bounds of the factor of all loads. F is safe if lambda^- >= 1: the zero stress
   * and the stresses in equilibrium with lambda^- times the loads are both admissible,
   * and so are their convex combinations, one of which carries the loads. The body fails
   * for F if lambda^+ <= 1. Both are certificates that do not require convergence.
   *
   * On each mesh the roots of both bounds are found by the secant method for log lambda
   * over log F, and each is confirmed by one more solution a thousandth on the safe side.
   */
  class StrengthReduction
  {
  public:
    /** Function that returns the input of the limit analysis on the current mesh for
     *  strength divided by F. */
    using Reduced = std::function<BoundScene(const double F)>;

    struct Level
    {
      /** Last strength reduction factor F for which problems were solved, with the bounds
       *  of the load factor. */
      double          factor = 1.;
      CertifiedBounds bounds;

      /** Certified bounds of the factor of safety on the mesh. No value if a bound is not
       *  certified. */
      std::optional<double> lower, upper;

      /** Solutions by which the bounds of the factor of safety are certified. */
      CertifiedBounds::Side lower_proof, upper_proof;

      /** Number of matrix factorisations on the mesh for the lower-bound (upper-bound)
       *  problems. */
      unsigned int iterations_lower = 0, iterations_upper = 0;
    };

    /** Computes both bounds of the factor of safety on a mesh.
     *  @param tolerance of the interior-point method, relative to the load
     *  @throws StepFailure if the body fails for no factor F, or for all factors */
    Level
    on_mesh(const Reduced &reduced, const double tolerance);

    void
    state(StateRow &row)
    {
      row(factor, exponent);
    }

  private:
    /** Certifies the bounds of the factor of safety. Problems are solved near the root of
     *  each certified positive bound of the load factor. */
    void
    prove_root(const Reduced &reduced,
               const double   tolerance,
               Level         &level) const;

    double factor   = 1.; ///< initial guess for the next mesh
    double exponent = 1.; ///< -d log lambda/d log F
  };
} // namespace geocone::GEOCONE_DIM

#endif
