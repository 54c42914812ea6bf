// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, project() would not be the Euclidean projection onto the
// cone C = {|s_t| <= a s_n + k}, and the natural map, by which every computed
// state is judged, would judge wrongly. Checked are what defines a projection
// (feasible, <x - Px, c - Px> <= 0 for all c in C) and what follows from it
// (idempotent, nonexpansive, Moreau's decomposition with the dual cone of
// aperture 1/a), in 3 and 6 components, and the limits.

#include <geocone/cone/second_order_cone.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_projection_01
{
  using namespace cone_tests;
  using geocone::project;

  template <typename V>
  void
  check(const double a, const double k, const unsigned int n_points)
  {
    constexpr int m = V::RowsAtCompileTime;
    Random        random;
    unsigned int  inside = 0, surface = 0, tip = 0;
    Largest       infeasible, idempotence, expansion, inequality, moreau;
    for (unsigned int i = 0; i < n_points; ++i)
      {
        const V x = any_point<V>(a, k, random);
        const V y = any_point<V>(a, k, random);
        const V p = project(a, k, x);
        if (p == x)
          ++inside;
        else if (p.template tail<m - 1>().norm() > 0.)
          ++surface;
        else
          ++tip;

        infeasible.add(p.template tail<m - 1>().norm() - a * p[0] - k);
        idempotence.add((project(a, k, p) - p).norm());
        expansion.add((p - project(a, k, y)).norm() - (x - y).norm());
        V apex = V::Zero();
        if (a > 0.)
          apex[0] = -k / a;
        inequality.add((x - p).dot(apex - p));
        for (unsigned int j = 0; j < 20; ++j)
          inequality.add((x - p).dot(feasible_point<V>(a, k, random) - p));
        if (k == 0.)
          {
            // For a = 0 the cone is the axis, and its polar cone is s_n = 0.
            V polar  = x;
            polar[0] = 0.;
            if (a > 0.)
              polar = -project(1. / a, 0., V(-x));
            moreau.add((p + polar - x).norm());
            moreau.add(std::abs(p.dot(polar)));
          }
      }
    std::cout << "m = " << m << ", a = " << a << ", k = " << k << ": " << inside
              << " inside, " << surface << " to the surface, " << tip
              << " to the tip";
    bool       holds   = true;
    const auto require = [&](const std::string &what, const Largest &largest) {
      if (!(largest.value < 1e-12))
        std::cout << ", " << what << " " << largest.value;
      holds = holds && largest.value < 1e-12;
    };
    require("infeasibility", infeasible);
    require("|PPx - Px|", idempotence);
    require("|Px - Py| - |x - y|", expansion);
    require("<x - Px, c - Px>", inequality);
    require("Moreau's decomposition", moreau);
    print("; all properties hold", holds);
  }

  /** What C tends to for a -> 0 with k > 0: |s_t| <= k. */
  template <typename V>
  V
  onto_cylinder(const double k, const V &x)
  {
    constexpr int m = V::RowsAtCompileTime;
    V             p = x;
    p.template tail<m - 1>() *=
      std::fmin(1., k / x.template tail<m - 1>().norm());
    return p;
  }

  template <typename V>
  void
  check_limits()
  {
    constexpr int m = V::RowsAtCompileTime;
    std::cout << "limits for m = " << m << std::endl;
    Random  random;
    Largest cylinder, nearly_cylinder, scaling;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const V x = any_point<V>(0., 1., random);
        cylinder.add((project(0., 1., x) - onto_cylinder(1., x)).norm());
        nearly_cylinder.add(
          (project(1e-9, 1., x) - onto_cylinder(1., x)).norm());
        for (const double scale : {1e-8, 1e8})
          scaling.add(
            (project(0.5, scale, V(scale * x)) / scale - project(0.5, 1., x))
              .norm());
      }
    print_below("a = 0: distance to the cylinder", cylinder, "1e-14");
    print_below("a = 1e-9: distance to the cylinder", nearly_cylinder, "1e-7");
    print_below("P of a scaled problem, scaled back", scaling, "1e-13");

    // The tip is met to the last digit, also from points on the axis, where
    // s_t/|s_t| means nothing, and from the tip itself.
    bool exact = true;
    for (const double a : {1e-3, 0.1, 0.3, 0.99})
      for (const double k : {0., 0.7, 1., 3e4})
        {
          V tip   = V::Zero();
          tip[0]  = -k / a;
          V below = tip;
          below[0] -= 1.;
          V beside = below;
          beside[m - 1] += 0.9 / a;
          // In the polar cone: a |x_t| <= -(x_n + k/a), here 0.9 <= 1.
          exact = exact && project(a, k, below) == tip &&
                  project(a, k, beside) == tip && project(a, k, tip) == tip;
        }
    print("the tip is exact", exact);
  }

  void
  test()
  {
    // a = 3/4: f = |x_t| - a x_n = 5, g = f/(1 + a^2) = 3.2, and
    // Px = (a g, (1 - g/5) x_t) = (2.4, 1.08, 1.44).
    const Vector3 p = project(0.75, 0., Vector3(0., 3., 4.));
    std::cout.precision(10);
    std::cout << "by hand: " << p.transpose() << std::endl;
    std::cout.precision(3);

    const double degree = std::acos(-1.) / 180.;
    for (const double a :
         {0., 0.1, std::sin(25. * degree), std::sin(45. * degree), 0.99})
      for (const double k : {0., 1.})
        {
          check<Vector3>(a, k, 1000);
          check<Vector6>(a, k, 1000);
        }
    check_limits<Vector3>();
    check_limits<Vector6>();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_projection_01
