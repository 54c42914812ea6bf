// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/newton/lag_continuation.h>

#include <algorithm>
#include <vector>

namespace geocone::GEOCONE_DIM
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
    NewtonLoop explicit_friction =
      loop(1., NewtonLoop::near_tolerance, allowed);
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
    NewtonLoop   first  = loop(first_lag, NewtonLoop::near_tolerance, allowed);
    first.elastic_first = elastic_first;
    first.run(search, work);
    if (work.report.converged)
      return;
    work.v = start;
    from_explicit_friction(first_lag, NewtonLoop::near_tolerance, work);
  }

  void
  LagContinuation::solve_on_path(const StepWorkspace &work) const
  {
    SolverReport      &report = work.report;
    const unsigned int before = report.iterations;
    solve_first(work);
    if (!report.converged)
      return;

    struct Reached
    {
      double lag;
      Vector v;
    };
    std::vector<Reached> path      = {{first_lag, work.v}};
    double               fall      = 0.55 * first_lag;
    bool                 shortened = false;
    LineSearch           search;
    const auto           go_to =
      [&](const double lag, const double accuracy, const unsigned int most) {
        NewtonLoop newton = loop(lag, accuracy, most);
        newton.moves      = true;
        newton.run(search, work);
      };
    while (path.back().lag > 0. && report.iterations - before < allowed_on_path)
      {
        double next = path.back().lag - fall;
        if (next < 0.5 * fall)
          next = 0.;
        const unsigned int spent = report.iterations;
        go_to(next, next > 0. ? NewtonLoop::near_tolerance : tolerance, 15);
        if (!report.converged)
          {
            // A second shorter stage rarely helped: the path turns.
            if (shortened)
              break;
            shortened = true;
            work.v    = path.back().v;
            fall      = 0.4 * (path.back().lag - next);
            continue;
          }
        path.push_back({next, work.v});
        // At most 55 % of it at a time: the path turns most near 0.
        const unsigned int n = report.iterations - spent;
        fall                 = std::min((n <= 2   ? 3.
                                         : n <= 4 ? 2.
                                         : n <= 6 ? 1.2
                                                  : 0.8) *
                          fall,
                        std::max(0.55 * next, 0.05));
      }
    if (path.back().lag == 0.)
      return;
    if (!keeps_lag)
      {
        report.converged = false;
        report.reason    = format("the exact law was not reached in %u "
                                  "iterations: a friction lag of %.2g is left",
                               report.iterations,
                               path.back().lag);
        return;
      }

    // Near a turning point the last state may not be a solution. The least lag
    // with a solution is used.
    for (; !path.empty(); path.pop_back())
      {
        work.v = path.back().v;
        go_to(path.back().lag, tolerance, path.size() > 1 ? 15 : 40);
        if (report.converged)
          return;
      }
  }
} // namespace geocone::GEOCONE_DIM
