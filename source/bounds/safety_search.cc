// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/resources.h>
#include <geocone/bounds/safety_search.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone
{
  namespace
  {
    /** Range of factors of practical interest. */
    constexpr double least = 1e-3, most = 1e3;

    /** @throws StepFailure outside that range */
    double
    checked(const double factor)
    {
      if (factor > most)
        throw StepFailure(
          format("no reduction of the strength makes the body fail (tried: "
                 "%g)\n  remedy:  check that it can fail: level ground carries "
                 "its own weight with any strength, and a side of the mesh "
                 "that is too near may confine it",
                 most));
      if (!(factor > least))
        throw StepFailure(
          "no strength carries the loads, not even a thousand times the given "
          "one\n  remedy:  check the loads, the supports and the units");
      return factor;
    }
  } // namespace

  bool
  SafetySearch::Attempt::is_usable() const
  {
    return certified && std::isfinite(load) && load > 0.;
  }

  std::optional<double>
  SafetySearch::prove(Solver       &solver,
                      const Side    side,
                      double        load,
                      unsigned int &iterations) const
  {
    const int             sign = side == lower ? -1 : 1;
    double                from = factor, slope = exponent, margin = 1e-3;
    std::optional<double> proven;
    for (unsigned int attempt = 0; attempt < 6; ++attempt)
      {
        const double tried =
          checked(from * std::pow(load, 1. / slope) * (1. + sign * margin));
        const Attempt found = solver.one(tried, side);
        iterations += found.factorisations;
        if (!found.is_usable())
          return proven;
        if (sign * (1. - found.load) >= 0.)
          {
            // Close enough to the root.
            const bool is_close =
              std::abs(std::log(found.load)) < 4. * margin * slope;
            if (!proven || sign * (tried - *proven) < 0.)
              {
                proven = tried;
                solver.keep(side);
              }
            if (is_close)
              return proven;
          }
        else
          margin *= 2.;
        // Secant through this point and another one of the curve.
        if (std::abs(std::log(tried / from)) > 1e-4)
          slope = std::clamp(
            -std::log(found.load / load) / std::log(tried / from), 0.3, 50.);
        from = tried;
        load = found.load;
      }
    return proven;
  }

  std::optional<double>
  SafetySearch::proven(Solver &solver, const Side side, const double start)
  {
    factor        = checked(start);
    Attempt found = solver.one(factor, side);
    while (found.grows)
      {
        factor = checked(1.3 * factor);
        found  = solver.one(factor, side);
      }
    unsigned int iterations = 0;
    return found.is_usable() ? prove(solver, side, found.load, iterations)
                             : std::nullopt;
  }

  SafetySearch::Level
  SafetySearch::on_mesh(Solver &solver)
  {
    Level level;
    // The last solution far from the root: factor and load.
    std::optional<std::pair<double, double>> last;
    // With sufficient friction any weight is carried: the load has no limit and the
    // body is safe.
    std::optional<double> without_limit;
    for (unsigned int attempt = 0;; ++attempt)
      {
        level.factor                      = checked(factor);
        const std::array<Attempt, 2> both = solver.both(factor);
        const auto &[below, above]        = both;
        for (const Side side : {lower, upper})
          level.iterations[side] += both[side].factorisations;
        if (above.grows || below.grows)
          {
            without_limit = factor;
            factor        = last && last->first > factor
                              ? std::sqrt(factor * last->first)
                              : factor * 1.3;
            continue;
          }
        if (!above.is_usable() && !below.is_usable())
          throw StepFailure(
            format("neither bound of the loads is certified where the strength "
                   "is divided by %g: the upper one: ",
                   factor) +
            above.rejection + "; the lower one: " + below.rejection +
            "\n  remedy:  check that the body can fail by its loads, its "
            "supports and strengths, or take other cells");
        // The midpoint is between 1/5 and 5 times its distance from there.
        const double load        = !below.is_usable() ? above.load
                                   : !above.is_usable()
                                     ? below.load
                                     : std::sqrt(below.load * above.load);
        const auto   next_factor = [&]() {
          const double next =
            factor * std::clamp(std::pow(load, 1. / exponent), 0.2, 5.);
          return without_limit && next <= *without_limit
                     ? std::sqrt(factor * *without_limit)
                     : next;
        };
        const double     next = next_factor();
        constexpr double near = 0.03;
        if (std::abs(std::log(next / factor)) < near || attempt == 30)
          {
            const auto proven = [&](const Side side) {
              return both[side].is_usable() ? prove(solver,
                                                    side,
                                                    both[side].load,
                                                    level.iterations[side])
                                            : std::nullopt;
            };
            run_both([&]() { level.upper = proven(upper); },
                     [&]() { level.lower = proven(lower); });
            factor = next;
            return level;
          }
        // One more solution far from the root determines the exponent.
        if (last && std::abs(std::log(factor / last->first)) > 1e-3)
          exponent = std::clamp(-std::log(load / last->second) /
                                  std::log(factor / last->first),
                                0.3,
                                50.);
        last   = {factor, load};
        factor = next_factor();
      }
  }
} // namespace geocone
