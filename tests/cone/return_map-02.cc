// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a point that stays at the tip of the cone would get a stress
// or a tangent that is no number, and end the run. The trial stress of such a
// point is the tip up to the last digits, and without tangential part or with
// one that is rounding: there q = a s_n + k is rounding, too, whose sign means
// nothing and which must not be divided by |t_t|.

#include <geocone/cone/second_order_cone.h>

#include "../test.h"
#include "cone_tests.h"
#include <limits>

namespace cone_return_map_02
{
  using namespace cone_tests;
  using geocone::FlowCone;
  using geocone::Mandel;
  using geocone::MandelMatrix;

  void
  test()
  {
    Random       random;
    unsigned int n_stresses = 0, n_tangents = 0, n_points = 0;
    for (unsigned int i = 0; i < 20000; ++i)
      {
        const double a   = random(0.01, 0.95);
        const double b   = a * (i % 3) / 2.;
        const double k   = random(0., 2.);
        const double K   = random(1., 50.);
        const Mandel tip = geocone::from_cone_axes(Mandel(-k / a, 0., 0.));
        for (const int digits : {-3, -1, 0, 1, 3})
          for (const double T : {0., 1e-300, 1e-17})
            {
              Mandel t = geocone::to_cone_axes(tip);
              t[0] *= 1. + digits * std::numeric_limits<double>::epsilon();
              t[1] = T;
              Mandel       s;
              MandelMatrix C;
              geocone::return_map(FlowCone{a, b, k}, K, 1., t, s, &C);
              ++n_points;
              // No part of a tangent is larger than K >= 2G.
              n_stresses += !((s - t).norm() < 1e-12 * (1. + k / a));
              n_tangents += !(C.norm() < 3. * K);
            }
      }
    std::cout << n_points << " points, wrong stresses: " << n_stresses
              << ", wrong tangents: " << n_tangents << std::endl;
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_return_map_02
