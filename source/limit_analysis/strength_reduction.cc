// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/limit_analysis/strength_reduction.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
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

    /** Whether the bound is certified and positive. */
    bool
    is_usable(const CertifiedBounds::Side &side)
    {
      return side.bound.certified && std::isfinite(side.bound.load) &&
             side.bound.load > 0.;
    }

    /** A factor certified by one bound, near the root of lambda = 1.
     *  @param sign -1: the lower bound, +1: the upper one
     *  @param proof the solution that certifies it */
    template <typename Solve>
    std::optional<double>
    prove(const Solve           &solve,
          double                 factor,
          double                 load,
          double                 exponent,
          const int              sign,
          unsigned int          &iterations,
          CertifiedBounds::Side &proof)
    {
      double                margin = 1e-3;
      std::optional<double> proven;
      for (unsigned int attempt = 0; attempt < 6; ++attempt)
        {
          const double tried =
            factor * std::pow(load, 1. / exponent) * (1. + sign * margin);
          const CertifiedBounds::Side side = solve(checked(tried));
          iterations += side.solution.factorisations;
          if (!is_usable(side))
            return proven;
          if (sign * (1. - side.bound.load) >= 0.)
            {
              // Close enough to the root.
              const bool is_close =
                std::abs(std::log(side.bound.load)) < 4. * margin * exponent;
              if (!proven || sign * (tried - *proven) < 0.)
                {
                  proven = tried;
                  proof  = side;
                }
              if (is_close)
                return proven;
            }
          else
            margin *= 2.;
          // Secant through this point and another one of the curve.
          if (std::abs(std::log(tried / factor)) > 1e-4)
            exponent = std::clamp(-std::log(side.bound.load / load) /
                                    std::log(tried / factor),
                                  0.3,
                                  50.);
          factor = tried;
          load   = side.bound.load;
        }
      return proven;
    }
  } // namespace

  void
  StrengthReduction::prove_root(const Reduced &reduced,
                                const double   tolerance,
                                Level         &level) const
  {
    const CertifiedBounds::Side &upper = level.bounds.upper,
                                &lower = level.bounds.lower;
    if (is_usable(lower))
      level.lower = prove(
        [&](const double F) { return certified_lower(reduced(F), tolerance); },
        factor,
        lower.bound.load,
        exponent,
        -1,
        level.iterations_lower,
        level.lower_proof);
    if (is_usable(upper))
      level.upper = prove(
        [&](const double F) { return certified_upper(reduced(F), tolerance); },
        factor,
        upper.bound.load,
        exponent,
        +1,
        level.iterations_upper,
        level.upper_proof);
  }

  StrengthReduction::Level
  StrengthReduction::on_mesh(const Reduced &reduced, const double tolerance)
  {
    Level level;
    // The last solution far from the root: factor and load.
    std::optional<std::pair<double, double>> last;
    // With sufficient friction any weight is carried: the load has no limit and the
    // body is safe.
    std::optional<double> without_limit;
    for (unsigned int attempt = 0;; ++attempt)
      {
        level.factor = checked(factor);
        level.bounds = certified_bounds(reduced(factor), tolerance);
        const auto &[upper, lower, gap, uneven, share] = level.bounds;
        (void)uneven;
        level.iterations_lower += lower.solution.factorisations;
        level.iterations_upper += upper.solution.factorisations;
        if (upper.solution.grows || lower.solution.grows)
          {
            without_limit = factor;
            factor        = last && last->first > factor
                              ? std::sqrt(factor * last->first)
                              : factor * 1.3;
            continue;
          }
        if (!is_usable(upper) && !is_usable(lower))
          throw StepFailure(
            format("neither bound of the loads is certified where the strength "
                   "is divided by %g: the upper one: ",
                   factor) +
            upper.bound.rejection +
            "; the lower one: " + lower.bound.rejection +
            "\n  remedy:  check that the body can fail by its loads, its "
            "supports and strengths, or take other cells");
        // The midpoint is between 1/5 and 5 times its distance from there.
        const double load        = !is_usable(lower) ? upper.bound.load
                                   : !is_usable(upper)
                                     ? lower.bound.load
                                     : std::sqrt(lower.bound.load * upper.bound.load);
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
            prove_root(reduced, tolerance, level);
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
} // namespace geocone::GEOCONE_DIM
