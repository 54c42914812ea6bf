// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_statistics_h
#define geocone_limit_analysis_statistics_h

#include <array>
#include <cstdint>
#include <vector>

namespace geocone
{
  /** Standard normal distribution function. */
  double
  normal_distribution(const double z);

  /** Inverse of normal_distribution(), for 0 < p < 1. */
  double
  normal_quantile(const double p);

  /**
   * Limits of the probability of an event that occurred in @p events of @p trials, each
   * exceeded with the probability (1 - confidence)/2 (Clopper and Pearson 1934): the p for
   * which as many events or more (fewer) have this probability.
   */
  std::array<double, 2>
  clopper_pearson(const unsigned int events,
                  const unsigned int trials,
                  const double       confidence);

  /** Standard normal numbers of a stream, the same on every machine and number of
   *  ranks. @param key identifies the stream */
  std::vector<double>
  normal_numbers(const std::vector<std::uint32_t> &key, const unsigned int n);
} // namespace geocone

#endif
