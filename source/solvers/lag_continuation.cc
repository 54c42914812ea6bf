// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/solvers/lag_continuation.h>

#include <algorithm>

namespace geocone
{
  NewtonLoop
  LagContinuation::loop(const double       lag,
                        const double       accuracy,
                        const unsigned int most) const
  {
    NewtonLoop result;
    result.law.friction_lag   = lag;
    result.tolerance          = accuracy;
    result.absolute_tolerance = absolute_tolerance;
    result.allowed            = most;
    return result;
  }

  void
  LagContinuation::from_explicit_friction(const double         lag,
                                          const double         accuracy,
                                          const StepWorkspace &work) const
  {
    LineSearch search;
    NewtonLoop explicit_friction    = loop(1., NewtonLoop::near, allowed);
    explicit_friction.elastic_first = elastic_first;
    explicit_friction.run(search, work);
    if (work.report.converged)
      loop(lag, accuracy, allowed).run(search, work);
  }

  void
  LagContinuation::solve_first(const StepWorkspace &work) const
  {
    const Vector start = work.v;
    LineSearch   search;
    NewtonLoop   first  = loop(first_lag, NewtonLoop::near, allowed);
    first.elastic_first = elastic_first;
    first.run(search, work);
    if (work.report.converged)
      return;
    work.v = start;
    from_explicit_friction(first_lag, NewtonLoop::near, work);
  }

  void
  LagContinuation::solve_on_path(const StepWorkspace &work) const
  {
    SolverReport      &report = work.report;
    const unsigned int before = report.iterations;
    solve_first(work);
    if (!report.converged)
      return;

    // The last solution that was reached, and its lag.
    const Vector first       = work.v;
    Vector       reached     = work.v;
    double       reached_lag = first_lag, fall = 0.55 * first_lag;
    bool         shortened = false;
    LineSearch   search;
    const auto   go_to = [&](const double next, const double accuracy) {
      NewtonLoop newton = loop(next, accuracy, 15);
      newton.moves      = true;
      newton.run(search, work);
    };
    while (reached_lag > 0. && report.iterations - before < allowed_on_path)
      {
        double next = reached_lag - fall;
        if (next < 0.5 * fall)
          next = 0.;
        const unsigned int spent = report.iterations;
        go_to(next, next > 0. ? NewtonLoop::near : tolerance);
        if (!report.converged)
          {
            // A second shorter stage rarely helped: the path turns.
            if (shortened)
              break;
            shortened = true;
            work.v    = reached;
            fall      = 0.4 * (reached_lag - next);
            continue;
          }
        reached     = work.v;
        reached_lag = next;
        // At most 55 % of it at a time: near 0 the path turns most.
        const unsigned int n = report.iterations - spent;
        fall                 = std::min((n <= 2   ? 3.
                                         : n <= 4 ? 2.
                                         : n <= 6 ? 1.2
                                                  : 0.8) *
                          fall,
                        std::max(0.55 * reached_lag, 0.05));
      }
    if (reached_lag == 0.)
      return;
    if (!keeps_lag)
      {
        report.converged = false;
        report.reason    = format("the exact law was not reached in %u "
                                  "iterations: a friction lag of %.2g is left",
                               report.iterations,
                               reached_lag);
        return;
      }

    // Near a turn of the path what has been reached may be no solution.
    work.v = reached;
    go_to(reached_lag, tolerance);
    if (report.converged)
      return;
    work.v            = first;
    NewtonLoop newton = loop(first_lag, tolerance, 40);
    newton.moves      = true;
    newton.run(search, work);
  }
} // namespace geocone
