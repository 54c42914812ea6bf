// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, small probabilities of failure would be wrong, or their limits too
// narrow. A curved limit state, ln(lambda) = 0.3 (3 - a.u) + (b.u)^2/50 with unit vectors a and
// b, has the design point 3 a. With the slope 0.3 along a and the deviation 0.2 across it the mean
// of what fails is at 3 0.09/(0.09 + 0.04) = 2.077 along a, within three deviations of 2000 trials.
// Samples that fail behind the plane a.u = 3 have the probability Phi(-3) = 1.349898e-3. Means of
// 100 exponential numbers, of skewness 2, are above and below the limits in 2.5 % of the trials each,
// within 1 % (three standard deviations of 2000 trials): normal limits, without the skewness, have
// 1.4 and 4.7 %.

#include <geocone/reliability/failure_probability.h>
#include <geocone/reliability/importance_sampling.h>
#include <geocone/reliability/statistics.h>

#include "../test.h"

#include <cmath>
#include <cstdio>

namespace limit_load_importance_01
{
  using namespace geocone;
  using Eigen::VectorXd;

  VectorXd
  numbers(const unsigned int sample, const unsigned int n)
  {
    const std::vector<double> values = normal_numbers({7, sample}, n);
    return Eigen::Map<const VectorXd>(values.data(), n);
  }

  void
  check(const char *what, const bool holds)
  {
    std::printf("%s: %s\n", what, holds ? "yes" : "NO");
  }

  void
  test()
  {
    constexpr unsigned int n = 6;
    VectorXd               a(n), b(n);
    a << 1., 1., 1., 1., 0., 0.;
    b << 1., -1., 0., 0., 1., -1.;
    a.normalize();
    b.normalize();
    const DesignPoint point = design_point(n, [&](const VectorXd &u) {
      return LimitState{0.3 * (3. - a.dot(u)) + std::pow(b.dot(u), 2) / 50.,
                        -0.3 * a + b.dot(u) / 25. * b};
    });
    check("design point",
          point.converged && (point.numbers - 3. * a).norm() < 0.01);
    const DesignPoint failed = design_point(n, [&](const VectorXd &) {
      return LimitState{-0.1, a};
    });
    check("a mean body that fails", failed.mean_fails());

    // Two mechanisms, 3 along a and 3.5 along c, and a third one that is far.
    VectorXd c = VectorXd::Zero(n), far = c;
    c[4]              = 1.;
    far[5]            = 1.;
    const auto points = design_points(n, [&](const VectorXd &u) {
      const LimitState states[] = {{0.3 * (3. - a.dot(u)), -0.3 * a},
                                   {0.3 * (3.5 - c.dot(u)), -0.3 * c},
                                   {0.3 * (6. - far.dot(u)), -0.3 * far}};
      return *std::min_element(
        states, states + 3, [](const LimitState &one, const LimitState &other) {
          return one.log_load < other.log_load;
        });
    });
    check("design points of two mechanisms",
          points.size() == 2 && (points[0].numbers - 3. * a).norm() < 0.01 &&
            (points[1].numbers - 3.5 * c).norm() < 0.01);

    // Linear, with the slope -0.3 along a and the deviation 0.2 across it.
    DesignPoint along = point;
    along.numbers     = 3. * a;
    std::vector<VectorXd> pilots;
    for (unsigned int i = 0; i < 2000; ++i)
      pilots.push_back(numbers(10000 + i, n));
    const double distance =
      distance_of_centre(along, pilots, [&](const VectorXd &u) {
        return LimitState{0.3 * (3. - a.dot(u)) + 0.2 * b.dot(u),
                          -0.3 * a + 0.2 * b};
      });
    check("distance of the centre",
          std::abs(distance - 3. * 0.09 / (0.09 + 0.04)) < 0.06);

    const SamplingDensity     density({point.numbers}, 2000);
    std::vector<SampleRecord> samples(2000);
    for (unsigned int s = 0; s < samples.size(); ++s)
      {
        const VectorXd u   = density.moved(s + 1, numbers(s + 1, n));
        samples[s].verdict = a.dot(u) > 3. ? -1 : 1;
        samples[s].weight  = density.weight(u);
      }
    const FailureProbability found(samples, 0.99, 10.);
    const double             exact = normal_distribution(-3.);
    check("probability in its limits",
          found.limits[0] < exact && exact < found.limits[1]);
    check("limits within 15 %",
          found.limits[1] < 1.15 * found.lower &&
            found.limits[0] > 0.85 * found.lower);
    check("mean weight", std::abs(found.mean_weight - 1.) < 0.15);
    // No sample fails: the largest weight times 1 - 0.005^(1/2000).
    for (SampleRecord &sample : samples)
      sample.verdict = 1;
    const double none = FailureProbability(samples, 0.99, 10.).limits[1];
    check("limit without failed samples",
          std::abs(none / (10. * (1. - std::pow(0.005, 1. / 2000.))) - 1.) <
            1e-6);
    // An undecided sample with a weight widens the interval by this weight.
    samples[0].verdict = -1;
    samples[1].verdict = 0;
    const FailureProbability wide(samples, 0.99, 10.);
    check("undecided weight",
          std::abs((wide.upper - wide.lower) * 2000. / samples[1].weight - 1.) <
            1e-9);

    unsigned int below = 0, above = 0;
    for (unsigned int trial = 0; trial < 2000; ++trial)
      {
        std::vector<double> values;
        for (const double z : normal_numbers({11, trial}, 100))
          values.push_back(-std::log(normal_distribution(z)));
        const auto limits = mean_limits(values, 0.95);
        above += limits[0] > 1.;
        below += limits[1] < 1.;
      }
    check("limits above the mean", std::abs(above / 2000. - 0.025) < 0.01);
    check("limits below the mean", std::abs(below / 2000. - 0.025) < 0.01);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace limit_load_importance_01
