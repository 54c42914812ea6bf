// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_failure_probability_h
#define geocone_reliability_failure_probability_h

#include <geocone/base/state_row.h>

#include <array>
#include <limits>
#include <vector>

namespace geocone
{
  /** Result of one sample. */
  struct SampleRecord
  {
    unsigned int number  = 0;  ///< from 1
    int          verdict = 0;  ///< SampleVerdict::Kind
    double       weight  = 1.; ///< SamplingDensity::weight()

    /** Bounds on the load factor; NaN if a bound is not certified or was not
     *  needed. */
    double lower = std::numeric_limits<double>::quiet_NaN(), upper = lower;

    unsigned int cells = 0, factorisations = 0;
    double       cpu_seconds = 0.;

    bool
    fails() const
    {
      return verdict < 0;
    }
    bool
    is_undecided() const
    {
      return verdict == 0;
    }
    /** Returns true if fields of earlier samples decide this one. */
    bool
    is_without_solution() const
    {
      return factorisations == 0;
    }

    void
    state(StateRow &row)
    {
      row(number,
          verdict,
          weight,
          lower,
          upper,
          cells,
          factorisations,
          cpu_seconds);
    }
  };

  /** Probability of failure, estimated from failed and undecided samples. */
  struct FailureProbability
  {
    unsigned int n_samples = 0, n_failed = 0, n_undecided = 0;
    double       lower = 0., upper = 1.; ///< means of weights of these samples
    std::array<double, 2> limits = {{0., 1.}}; ///< confidence limits

    double mean_weight = 1.; ///< of all samples; its expectation is 1

    /** Number of equal weights with the variance of the failed ones. */
    double effective_failed = 0.;

    /**
     * Evaluates the results of the samples. Limits are those of Clopper and Pearson if
     * all weights are 1, else those of mean_limits(), the lower one of failed samples and
     * the upper one of failed and undecided samples. If none of these has a weight, the
     * upper one is Clopper and Pearson's times the largest weight.
     * @param confidence probability with which the limits include the probability
     * of failure; asymptotic for weights
     * @param largest_weight that a sample may have
     */
    FailureProbability(const std::vector<SampleRecord> &samples,
                       const double                     confidence,
                       const double                     largest_weight);
  };
} // namespace geocone

#endif
