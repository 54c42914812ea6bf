// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_lag_continuation_h
#define geocone_newton_lag_continuation_h

#include <geocone/newton/newton_loop.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Numerical continuation from lagged friction (strength from the stresses at
   * t_n) to the exact friction law. A law with lagged friction is easier to
   * solve, since it is closer to associated flow; lag 1 is explicit friction.
   * The exact law is reached on a path of solutions with a lag that decreases
   * to 0; each solution is the initial guess of the next, with the line search.
   */
  struct LagContinuation
  {
    double       tolerance          = 1e-10; ///< relative, for |R_free|
    double       absolute_tolerance = 1e-12; ///< for |R_free| (N/m)
    unsigned int allowed            = 40;    ///< iterations per lag
    unsigned int allowed_on_path    = 60;    ///< iterations on the path
    bool         elastic_first      = false; ///< elastic tangent D first

    /** True if the continuation may end with lagged friction, before the exact
     *  law (friction lag 0) is reached. The solution for the smallest lag is
     *  then used. Otherwise the step fails. */
    bool keeps_lag = true;

    /** Solves the step with the exact friction law, starting from the solution
     *  with explicit friction (strength from the stresses at t_n). Explicit
     *  friction is a convex problem. */
    void
    solve_from_explicit_friction(const StepWorkspace &work) const
    {
      from_explicit_friction(0., tolerance, work);
    }

    /** Follows the path of solutions from the first friction lag (weight of
     *  lagged normal stress) towards the exact law, as long as the iterations
     *  converge. */
    void
    solve_on_path(const StepWorkspace &work) const;

  private:
    static constexpr double first_lag = 0.5;

    void
    from_explicit_friction(const double         lag,
                           const double         accuracy,
                           const StepWorkspace &work) const;

    /** Solves the problem with the first friction lag of the path, i.e. the
     *  largest weight of the lagged normal stress. If necessary, the initial
     *  guess is the solution for explicit friction. */
    void
    solve_first(const StepWorkspace &work) const;

    /** Creates the Newton iteration for a given friction lag (weight of the
     *  lagged normal stress in the yield condition). */
    NewtonLoop
    loop(const double       lag,
         const double       accuracy,
         const unsigned int most) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
