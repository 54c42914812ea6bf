// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/statistics.h>

#include <cmath>
#include <random>

namespace geocone
{
  namespace
  {
    /** Root of an increasing function between @p a and @p b, by bisection to rounding. */
    template <typename Function>
    double
    root_between(double a, double b, const Function &f)
    {
      for (unsigned int i = 0; i < 200; ++i)
        {
          const double middle = a + (b - a) / 2.;
          if (middle == a || middle == b)
            break;
          (f(middle) < 0. ? a : b) = middle;
        }
      return a + (b - a) / 2.;
    }

    /** Probability of at most @p k events in @p n trials of probability p. */
    double
    at_most(const unsigned int k, const unsigned int n, const double p)
    {
      double sum = 0.;
      for (unsigned int i = 0; i <= k; ++i)
        sum += std::exp(std::lgamma(n + 1.) - std::lgamma(i + 1.) -
                        std::lgamma(n - i + 1.) + i * std::log(p) +
                        (n - i) * std::log1p(-p));
      return sum;
    }
  } // namespace

  double
  normal_distribution(const double z)
  {
    return 0.5 * std::erfc(-z * M_SQRT1_2);
  }

  double
  normal_quantile(const double p)
  {
    // The tail near 0 is not subject to cancellation.
    if (p > 0.5)
      return -normal_quantile(1. - p);
    return root_between(
      -40., 0.5, [p](const double z) { return normal_distribution(z) - p; });
  }

  std::array<double, 2>
  clopper_pearson(const unsigned int events,
                  const unsigned int trials,
                  const double       confidence)
  {
    const double tail = (1. - confidence) / 2.;
    const double lower =
      events == 0 ? 0. : root_between(0., 1., [&](const double p) {
        return 1. - at_most(events - 1, trials, p) - tail;
      });
    const double upper =
      events == trials ? 1. : root_between(0., 1., [&](const double p) {
        return tail - at_most(events, trials, p);
      });
    return {{lower, upper}};
  }

  std::vector<double>
  normal_numbers(const std::vector<std::uint32_t> &key, const unsigned int n)
  {
    std::seed_seq       seed(key.begin(), key.end());
    std::mt19937_64     generator(seed);
    std::vector<double> numbers(n);
    // std::normal_distribution differs between libraries: Box and Muller (1958).
    const auto uniform = [&]() {
      return ((generator() >> 11) + 0.5) * 0x1p-53;
    };
    for (unsigned int i = 0; i < n; i += 2)
      {
        const double radius = std::sqrt(-2. * std::log(uniform())),
                     angle  = 2. * M_PI * uniform();
        numbers[i]          = radius * std::cos(angle);
        if (i + 1 < n)
          numbers[i + 1] = radius * std::sin(angle);
      }
    return numbers;
  }
} // namespace geocone
