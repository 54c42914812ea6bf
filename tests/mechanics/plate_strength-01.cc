// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The return of random forces of plates to |m| + n^2 <= 1: within the strength, the closest
// admissible forces in the norm of the elastic energy (a variational inequality), with the
// derivative of differences; and a column with an eccentric load, 1.5 p + p^2 = 1, p = 1/2.

#include <geocone/terms/plate_strength.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

namespace mechanics_plate_strength_01
{
  using namespace geocone;
  using Pairs = std::vector<std::array<unsigned int, 2>>;

  double
  excess(const std::vector<PlateForce> &forces, const Pairs &pairs)
  {
    double most = -1.;
    for (const auto &[m, n] : pairs)
      most = std::max(most,
                      std::abs(forces[m].value) +
                        forces[n].value * forces[n].value - 1.);
    return most;
  }

  struct Errors
  {
    double strength = 0., projection = 0., derivative = 0.;
  };

  class Trial
  {
  public:
    /** A plate of segments 0, 2, ... and inner points 1, 3, ... */
    Trial(const unsigned int n_segments, const bool is_uniform)
    {
      for (unsigned int i = 0; i < 2 * n_segments - 1; ++i)
        {
          elastic.push_back({3. * (2. * uniform() - 1.),
                             is_uniform ? 1. : std::pow(10., 2. * uniform())});
          if (is_uniform && i > 1)
            elastic[i].value = elastic[i - 2].value; // as beside smooth soil
          if (i % 2 == 1)
            {
              pairs.push_back({{i, i - 1}});
              pairs.push_back({{i, i + 1}});
            }
        }
    }

    void
    check(const bool has_derivative, Errors &errors)
    {
      std::vector<PlateForce> x      = elastic;
      const auto              groups = return_to_interaction(x, pairs);
      errors.strength = std::max(errors.strength, excess(x, pairs));
      for (unsigned int trial = 0; trial < 50; ++trial)
        {
          std::vector<PlateForce> other = x;
          const double            size  = std::pow(10., -3. * uniform());
          for (PlateForce &force : other)
            force.value += size * (2. * uniform() - 1.);
          while (excess(other, pairs) > 0.)
            for (PlateForce &force : other)
              force.value *= 0.99;
          double sum = 0.;
          for (unsigned int i = 0; i < x.size(); ++i)
            sum += x[i].compliance * (elastic[i].value - x[i].value) *
                   (other[i].value - x[i].value);
          errors.projection = std::max(errors.projection, sum);
        }
      for (const YieldingForces &group : groups)
        for (unsigned int l = 0; has_derivative && l < group.forces.size(); ++l)
          {
            constexpr double        d    = 1e-6;
            std::vector<PlateForce> more = elastic, less = elastic;
            more[group.forces[l]].value += d;
            less[group.forces[l]].value -= d;
            return_to_interaction(more, pairs);
            return_to_interaction(less, pairs);
            for (unsigned int k = 0; k < group.forces.size(); ++k)
              errors.derivative =
                std::max(errors.derivative,
                         std::abs((more[group.forces[k]].value -
                                   less[group.forces[k]].value) /
                                    (2. * d) -
                                  group.derivative(k, l)));
          }
    }

  private:
    double
    uniform()
    {
      static std::mt19937                     engine(1);
      static std::uniform_real_distribution<> distribution(0., 1.);
      return distribution(engine);
    }

    std::vector<PlateForce> elastic;
    Pairs                   pairs;
  };

  void
  test()
  {
    Errors errors, tied;
    for (unsigned int trial = 0; trial < 400; ++trial)
      {
        Trial(1 + trial % 12, false).check(true, errors);
        Trial(2 + trial % 40, true).check(false, tied);
      }
    for (const Errors &those : {errors, tied})
      std::cout << "within the strength: "
                << (those.strength < 1e-12 ? "yes" : "no")
                << "\nclosest: " << (those.projection < 1e-9 ? "yes" : "no")
                << "\n";
    std::cout << "derivative: " << (errors.derivative < 1e-6 ? "yes" : "no")
              << "\n";
    // The elastic moment is 1.5 times the axial force; both are far beyond.
    const double            p = 0.5;
    std::vector<PlateForce> column(2);
    const double multiplier = 3.; // of the flow rule, from p backwards
    column[0].value         = 1.5 * p + multiplier;
    column[1].value         = -p * (1. + 2. * multiplier);
    return_to_interaction(column, {{{0, 1}}});
    std::cout << "eccentric load: "
              << (std::abs(column[0].value - 0.75) < 1e-13 &&
                      std::abs(column[1].value + 0.5) < 1e-13
                    ? "yes"
                    : "no")
              << "\n";
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_plate_strength_01
