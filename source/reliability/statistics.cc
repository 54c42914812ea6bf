// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/reliability/statistics.h>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>

#include <cmath>
#include <random>

namespace geocone
{
  namespace
  {
    /** Long double is not needed, whose constants would be computed at each start. */
    const boost::math::policies::policy<
      boost::math::policies::promote_double<false>>
      in_double;
  } // namespace

  double
  normal_distribution(const double z)
  {
    return 0.5 * std::erfc(-z * M_SQRT1_2);
  }

  double
  normal_quantile(const double p)
  {
    return -M_SQRT2 * boost::math::erfc_inv(2. * p, in_double);
  }

  std::array<double, 2>
  clopper_pearson(const unsigned int events,
                  const unsigned int trials,
                  const double       confidence)
  {
    const double tail = (1. - confidence) / 2., others = trials - events;
    // The probability of k events or more is the incomplete beta function.
    return {
      {events == 0
         ? 0.
         : boost::math::ibeta_inv(double(events), others + 1., tail, in_double),
       events == trials
         ? 1.
         : boost::math::ibetac_inv(events + 1., others, tail, in_double)}};
  }

  std::array<double, 2>
  mean_limits(const std::vector<double> &values, const double confidence)
  {
    const double n    = values.size();
    double       mean = 0., second = 0., third = 0.;
    for (const double value : values)
      mean += value / n;
    for (const double value : values)
      {
        const double left = value - mean;
        second += left * left / n;
        third += left * left * left / n;
      }
    if (!(second > 0.))
      return {{mean, mean}};
    const double deviation = std::sqrt(second * n / (n - 1.)),
                 l         = third / (std::pow(second, 1.5) * std::sqrt(n));
    const auto t_of        = [l](const double z) {
      return std::abs(l) < 1e-6
                      ? z
                      : 3. / l * (std::cbrt(1. + l * (z - l / 6.)) - 1.);
    };
    const double z     = normal_quantile((1. + confidence) / 2.),
                 error = deviation / std::sqrt(n);
    return {{mean - error * t_of(z), mean - error * t_of(-z)}};
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
