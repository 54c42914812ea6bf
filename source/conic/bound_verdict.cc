// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/conic/bound_verdict.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    /** Tolerated rounding error of equilibrium and of incompressibility. */
    constexpr double tolerated = 1e-8;
  } // namespace

  void
  StressCheck::add(const double utilisation, const double k, const double norm)
  {
    take_larger(largest, norm);
    if (!(utilisation <= 1.))
      {
        take_larger(violation, (utilisation - 1.) * k);
        // Scaled stresses have the rounding of eigenvalues again.
        theta = std::min(theta, (1. - 1e-13) / utilisation);
      }
  }

  void
  StressCheck::add_error(const double residual)
  {
    take_larger(error, residual);
  }

  double
  StressCheck::judge(BoundVerdict &verdict, const double load) const
  {
    verdict.violation    = violation / largest;
    verdict.error        = error / largest;
    const bool is_scaled = !is_dead && theta > 0.;
    if (!is_scaled && theta < 1.)
      verdict.rejection = format(
        "its stresses exceed the strength by %.1e of the largest one, and a "
        "dead load or soil without cohesion leaves nothing to scale",
        verdict.violation);
    const double factor = is_scaled ? theta : 1.;
    verdict.load        = factor * load;
    if (!std::isfinite(verdict.load + verdict.error + verdict.violation))
      verdict.rejection = "it is not a number";
    else if (!(verdict.error < tolerated))
      verdict.rejection =
        format("its stresses miss equilibrium by %.1e of the largest one",
               verdict.error);
    verdict.certified = verdict.rejection.empty();
    return factor;
  }

  void
  VelocityCheck::judge(BoundVerdict &verdict,
                       const double  power,
                       const double  work) const
  {
    verdict.violation =
      std::max(rate_missed / largest_rate, jump_missed / fastest);
    verdict.error =
      std::max(volume_change / largest_rate, normal_jump / fastest);
    verdict.load     = power / work;
    const double sum = rate_missed + jump_missed + volume_change + normal_jump +
                       largest_rate + fastest;
    if (!std::isfinite(power + work + sum) || !(work > least_work * fastest))
      verdict.rejection = "its velocities do no work";
    else if (!(verdict.error < tolerated))
      verdict.rejection = format(
        "its volume and its normal jumps change by %.1e of the largest rate "
        "where phi = 0",
        verdict.error);
    else if (rate_missed > 0. || jump_missed > 0.)
      verdict.rejection =
        format("its rates miss the cone by %.1e of the largest one",
               verdict.violation);
    verdict.certified = verdict.rejection.empty();
  }
} // namespace geocone
