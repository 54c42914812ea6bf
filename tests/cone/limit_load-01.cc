// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, the limit load of a run, its main result, would not be the
// plateau of its curve: a peak of inertia, a point of a saw-tooth, or the last
// load of a curve that still rises.

#include <geocone/output/limit_load.h>

#include "../test.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace cone_limit_load_01
{
  using geocone::find_limit_load;
  using geocone::LimitLoad;
  using geocone::LoadPoint;

  using Curve = std::vector<LoadPoint>;

  /** n equal steps up to the displacement 1. */
  Curve
  sample(const unsigned int n, const std::function<double(double)> &load)
  {
    Curve curve;
    for (unsigned int i = 1; i <= n; ++i)
      {
        const double u = i / double(n);
        curve.push_back({u, load(u)});
      }
    return curve;
  }

  void
  print(const std::string &name,
        const Curve       &curve,
        const double       tolerance = 0.01)
  {
    const LimitLoad limit = find_limit_load(curve, tolerance);
    std::cout << name << ": ";
    if (limit.found)
      std::cout << "value " << limit.value << ", band " << limit.band_low
                << " to " << limit.band_high << ", from " << limit.begins_at
                << ", drift " << 100. * limit.drift << " %";
    else
      std::cout << "not found, drift " << 100. * limit.drift << " %";
    std::cout << ", peak " << limit.peak << std::endl;
  }

  void
  test()
  {
    std::cout.precision(10);
    const auto plateau = [](const double u) {
      return std::fmin(100., 400. * u);
    };

    // Loads 100 from u = 1/4 on.
    print("flat", sample(20, plateau));
    // The same with the elastic part up to 0.6 (1/4 of the curve remains) and to
    // 0.8 (1/8), and to 0.97 (nothing).
    for (const double knee : {0.6, 0.8, 0.97})
      print("flat from " + std::to_string(knee).substr(0, 4),
            sample(100, [knee](const double u) {
              return 100. * std::fmin(1., u / knee);
            }));
    // 150 for u in (0.2, 0.3]: 1.5 times the limit load.
    print("inertia", sample(20, [&](const double u) {
            return u > 0.21 && u < 0.31 ? 150. : plateau(u);
          }));
    // The overshoot until 0.6 is in the last half, but not in the last quarter.
    print("late inertia", sample(20, [&](const double u) {
            return u > 0.41 && u < 0.61 ? 150. : plateau(u);
          }));
    print("saw-tooth", sample(40, [&](const double u) {
            const int step = std::lround(40. * u);
            return plateau(u) + (step % 2 == 0 ? 2. : -2.);
          }));

    // Means of a line's halves: drift = slope (u_2 - u_1)/mean, over the last
    // 1/8.
    print("rising", sample(80, [](const double u) { return 100. * u; }));
    print("slowly rising",
          sample(80, [](const double u) { return 100. + 4. * u; }),
          0.05);
    print("slowly rising, small tolerance",
          sample(80, [](const double u) { return 100. + 4. * u; }),
          0.001);
    print("softening",
          sample(80, [](const double u) { return 200. - 100. * u; }));

    // Steps growing by 3: the last half is within the last step, which is
    // compared with the load before.
    const Curve growing = {
      {1., 60.}, {3., 90.}, {9., 98.}, {27., 100.}, {81., 100.5}};
    print("growing steps", growing);
    print("growing steps, small tolerance", growing, 0.004);
    print("growing steps, rising",
          {{1., 60.}, {3., 90.}, {9., 98.}, {27., 100.}, {81., 105.}});

    // Elastic steps that double: the last one is all of the last half, or all but a hundredth.
    print("elastic", {{0.1, 10.}, {0.5 + 1e-12, 50.}, {1., 100.}});
    print("elastic, almost", {{0.1, 10.}, {0.505, 50.5}, {1., 100.}});

    // Pushed along -y and counted so: both signs change, and the work does not.
    Curve downward = sample(20, plateau);
    for (LoadPoint &point : downward)
      point = {-point.displacement, -point.load};
    print("downward", downward);

    // Back from 1 to 0.9, elastic, in more steps than the loading had: not a
    // part of the plateau.
    Curve unloading = sample(20, plateau);
    for (unsigned int i = 1; i <= 40; ++i)
      unloading.push_back({1. - 0.0025 * i, 100. - 5. * i});
    print("unloading", unloading);
    // ... and half of the way forth again.
    for (unsigned int i = 1; i <= 20; ++i)
      unloading.push_back({0.9 + 0.0025 * i, -100. + 5. * i});
    print("reloading", unloading);

    // A stage of gravity before the loading: with the footing held, with it
    // settling, and with the displacement counted from zero again after that.
    for (const std::string kind : {"held", "settling", "reset"})
      {
        Curve curve;
        for (unsigned int i = 1; i <= 5; ++i)
          curve.push_back({kind == "held" ? 0. : 0.01 * i, 0.});
        for (LoadPoint point : sample(20, plateau))
          {
            point.displacement += kind == "settling" ? 0.05 : 0.;
            curve.push_back(point);
          }
        print("gravity, " + kind, curve);
      }

    print("empty", {});
    print("one point", {{1., 100.}});
    print("two points", {{1., 100.}, {2., 100.2}});
    print("no load", sample(20, [](double) { return 0.; }));
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_limit_load_01
