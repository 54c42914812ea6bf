// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_lag_continuation_h
#define geocone_newton_lag_continuation_h

#include <geocone/newton/newton_loop.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Continuation in the lag of friction. Lagged friction is easier to solve
   * (its law is closer to associated flow, and explicit at lag 1). The exact
   * law is reached on a path of solutions with a lag that decreases to 0; each
   * is the initial guess of the next, with the line search.
   */
  struct LagContinuation
  {
    double       tolerance          = 1e-10; ///< relative
    double       absolute_tolerance = 1e-12; ///< (N/m)
    unsigned int allowed            = 40;    ///< iterations for one lag
    unsigned int allowed_on_path    = 60;    ///< for the whole path
    bool         elastic_first      = false; ///< uses D as the first tangent

    /** Whether a step whose path does not reach lag 0 retains the least lag
     *  reached; otherwise the step is not solved. */
    bool keeps_lag = true;

    /** Solves the law from the solution with explicit friction, a convex
     *  problem. */
    void
    solve_from_explicit_friction(const StepWorkspace &work) const
    {
      from_explicit_friction(0., tolerance, work);
    }

    /** Follows the solutions from first_lag down to 0, or as far as
     *  possible. */
    void
    solve_on_path(const StepWorkspace &work) const;

  private:
    static constexpr double first_lag = 0.5;

    void
    from_explicit_friction(const double         lag,
                           const double         accuracy,
                           const StepWorkspace &work) const;

    /** Solves the law with first_lag, starting from explicit friction if
     *  necessary. */
    void
    solve_first(const StepWorkspace &work) const;

    /** A Newton iteration with one lag. */
    NewtonLoop
    loop(const double       lag,
         const double       accuracy,
         const unsigned int most) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
