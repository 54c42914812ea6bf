// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Convex hulls, and the shortest way between two of them: of random points against all
// directions in turn, of squares, segments, single points, and of sets that meet.

#include <geocone/shapes/convex_hull.h>

#include "../test.h"

#include <cmath>
#include <cstdio>
#include <random>

namespace mechanics_convex_hull_01
{
  using namespace geocone;
  using dealii::Point;
  using dealii::Tensor;
  using Points = std::vector<Point<2>>;

  /** The margin between two sets along a direction. */
  double
  margin(const Points &from, const Points &to, const Tensor<1, 2> &n)
  {
    double end = -1e300, begin = 1e300;
    for (const Point<2> &x : from)
      end = std::max(end, n * x);
    for (const Point<2> &x : to)
      begin = std::min(begin, n * x);
    return begin - end;
  }

  Tensor<1, 2>
  direction(const double angle)
  {
    return Tensor<1, 2>({std::cos(angle), std::sin(angle)});
  }

  void
  test()
  {
    std::mt19937                     engine(1);
    std::uniform_real_distribution<> uniform(0., 1.);
    unsigned int n_apart = 0, n_wrong = 0, n_wrong_hulls = 0;
    for (unsigned int trial = 0; trial < 200; ++trial)
      {
        const unsigned int n = 1 + trial % 7;
        Points             a, b;
        for (unsigned int i = 0; i < n; ++i)
          {
            a.emplace_back(uniform(engine), uniform(engine));
            b.emplace_back(uniform(engine) + 0.01 * trial, uniform(engine));
          }
        // A hull is convex and holds all points.
        const Points hull = convex_hull(a);
        for (std::size_t i = 0; i < hull.size() && hull.size() > 2; ++i)
          {
            const Tensor<1, 2> edge = hull[(i + 1) % hull.size()] - hull[i];
            for (const Point<2> &x : a)
              n_wrong_hulls +=
                edge[0] * (x[1] - hull[i][1]) - edge[1] * (x[0] - hull[i][0]) <
                -1e-15;
          }
        double best = -1e300;
        for (unsigned int k = 0; k < 20000; ++k)
          best =
            std::max(best, margin(a, b, direction(k * 2. * M_PI / 20000.)));
        const Tensor<1, 2> n_ab = way_between(a, b);
        if (best > 1e-4)
          {
            ++n_apart;
            n_wrong += !(margin(a, b, n_ab) >= best - 1e-12 &&
                         std::abs(n_ab.norm() - 1.) < 1e-14);
          }
        else if (best < -1e-4)
          n_wrong += n_ab.norm() > 0.;
      }
    std::printf("random sets: %s apart, %u wrong ways, %u wrong hulls\n",
                n_apart > 50 ? "many" : "FEW",
                n_wrong,
                n_wrong_hulls);

    const auto print = [](const char *what, const Points &a, const Points &b) {
      const Tensor<1, 2> n = way_between(a, b);
      std::printf("%s: %.6f %.6f\n", what, n[0] + 0., n[1] + 0.);
    };
    const Points square = {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}, {0.5, 0.5}};
    print("a square and one beside it",
          square,
          {{2., 0.3}, {3., 0.3}, {3., 2.}, {2., 2.}});
    print("a square and a point off its corner", square, {{2., 2.}});
    print("a square and a line above it", square, {{-5., 1.5}, {5., 1.5}});
    print("a square and a part of it", square, {{0.2, 0.2}, {0.4, 0.3}});
    print("a square and a line through it", square, {{-1., 0.5}, {2., 0.5}});
    print("a square and one that shares an edge", square, {{1., 0.}, {1., 1.}});
    print("no points", square, {});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_convex_hull_01
