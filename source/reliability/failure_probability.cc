// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/reliability/failure_probability.h>
#include <geocone/reliability/importance_sampling.h>
#include <geocone/reliability/statistics.h>

#include <algorithm>

namespace geocone
{
  FailureProbability::FailureProbability(
    const std::vector<SampleRecord> &samples,
    const double                     confidence,
    const double                     largest_weight)
    : n_samples(samples.size())
  {
    if (n_samples == 0)
      return;
    std::vector<double> failed, possible; // weights, or zero
    double              sum = 0., squares = 0., all = 0.;
    bool                is_weighted = false;
    for (const SampleRecord &sample : samples)
      {
        n_failed += sample.fails();
        n_undecided += sample.is_undecided();
        failed.push_back(sample.fails() ? sample.weight : 0.);
        possible.push_back(sample.is_undecided() ? sample.weight
                                                 : failed.back());
        sum += failed.back();
        squares += failed.back() * failed.back();
        all += sample.weight;
        is_weighted |= sample.weight != 1.;
      }
    mean_weight             = all / n_samples;
    effective_failed        = squares > 0. ? sum * sum / squares : 0.;
    const unsigned int most = n_failed + n_undecided;
    if (!is_weighted)
      {
        lower  = double(n_failed) / n_samples;
        upper  = double(most) / n_samples;
        limits = {{clopper_pearson(n_failed, n_samples, confidence)[0],
                   clopper_pearson(most, n_samples, confidence)[1]}};
        return;
      }
    lower = sum / n_samples;
    upper = 0.;
    for (const double weight : possible)
      upper += weight / n_samples;
    limits[0] = std::max(0., mean_limits(failed, confidence)[0]);
    limits[1] = std::min(
      1.,
      most > 0 ? mean_limits(possible, confidence)[1]
               : largest_weight * clopper_pearson(0, n_samples, confidence)[1]);
  }
} // namespace geocone
