// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_statistics_h
#define geocone_reliability_statistics_h

#include <array>
#include <cstdint>
#include <vector>

namespace geocone
{
  /** Cumulative distribution function of the standard normal distribution. */
  double
  normal_distribution(const double z);

  /** Quantile of the standard normal distribution for the
   *  probability p, 0 < p < 1. */
  double
  normal_quantile(const double p);

  /**
   * Clopper-Pearson confidence limits of the probability of an event that
   * occurred in @p events of @p trials. If the probability of the event equals
   * the lower (upper) limit, the probability of @p events or more (fewer) is
   * (1 - confidence)/2 (Clopper and Pearson 1934).
   */
  std::array<double, 2>
  clopper_pearson(const unsigned int events,
                  const unsigned int trials,
                  const double       confidence);

  /**
   * Confidence limits of the expectation of independent numbers, from Student's
   * statistic t without its skewness (Hall 1992): g(t) = t + l t^2/3 + l^2 t^3/27 + l/6,
   * l = skewness/sqrt(n), is taken as standard normal. The limits are asymptotic, with
   * errors of the confidence of order 1/n. @param values two at least
   */
  std::array<double, 2>
  mean_limits(const std::vector<double> &values, const double confidence);

  /** Independent standard normal numbers from a random stream. They are the
   *  same on every machine and for any number of ranks. @param key identifies
   *  the stream */
  std::vector<double>
  normal_numbers(const std::vector<std::uint32_t> &key, const unsigned int n);
} // namespace geocone

#endif
