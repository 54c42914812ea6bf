// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, the Jacobian of project() would not be an element of Clarke's
// generalised Jacobian, and Newton's method would lose its fast convergence. It
// is compared with central differences where P is smooth, with the limits from
// both sides where it is not, and there the property on which the convergence
// rests is checked: |P(x+d) - P(x) - J(x+d) d| = O(|d|^2).

#include <geocone/cone/second_order_cone.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_jacobian_01
{
  using namespace cone_tests;
  using geocone::FlowCone;
  using geocone::Mode;
  using geocone::project;

  template <typename V>
  MatrixOf<V>
  jacobian(const double a, const double k, const V &x)
  {
    MatrixOf<V> J;
    J.setConstant(std::nan("")); // all entries have to be written
    project(a, k, x, &J);
    return J;
  }

  /** f and q of the return map for K = 2G = 1: P has its kinks where they vanish.
   */
  template <typename V>
  double
  distance_to_kinks(const double a, const double k, const V &x)
  {
    const double T = FlowCone::tangential_norm(x);
    const double f = T - a * x[0] - k;
    const double q = T - f / (1. + a * a);
    return f < 0. || a == 0. ? std::abs(f) : std::fmin(f, std::abs(q));
  }

  template <typename V>
  void
  check_smooth(const double a, const double k)
  {
    constexpr int m = V::RowsAtCompileTime;
    Random        random;
    unsigned int  counts[3] = {0, 0, 0};
    Largest       difference, asymmetry, beyond;
    for (unsigned int i = 0; i < 500; ++i)
      {
        const V x = any_point<V>(a, k, random);
        if (distance_to_kinks(a, k, x) < 0.01)
          continue;
        MatrixOf<V> J = jacobian(a, k, x), differences;
        V           p;
        ++counts[static_cast<int>(
          geocone::return_map(FlowCone{a, a, k},
                              1.,
                              1.,
                              x,
                              p,
                              static_cast<MatrixOf<V> *>(nullptr)))];
        const double h = 1e-5;
        for (int j = 0; j < m; ++j)
          {
            V e  = V::Zero();
            e[j] = h;
            differences.col(j) =
              (project(a, k, V(x + e)) - project(a, k, V(x - e))) / (2. * h);
          }
        difference.add((J - differences).norm());
        asymmetry.add((J - J.transpose()).norm());
        // A projection's Jacobian has its eigenvalues in [0, 1].
        const V d = random.vector<V>(1.);
        beyond.add(-d.dot(J * d));
        beyond.add(d.dot(J * d) - d.dot(d));
      }
    std::cout << "m = " << m << ", a = " << a << ", k = " << k << ": "
              << counts[0] << " inside, " << counts[1] << " to the surface, "
              << counts[2] << " to the tip";
    bool       holds   = true;
    const auto require = [&](const std::string &what,
                             const Largest     &largest,
                             const double       tolerance) {
      if (!(largest.value < tolerance))
        std::cout << ", " << what << " " << largest.value;
      holds = holds && largest.value < tolerance;
    };
    require("error against differences", difference, 1e-6);
    require("asymmetry", asymmetry, 1e-14);
    require("eigenvalues beyond [0, 1]", beyond, 1e-14);
    print("; all properties hold", holds);
  }

  template <typename V>
  void
  check_kinks()
  {
    constexpr int m = V::RowsAtCompileTime;
    std::cout << "kinks for m = " << m << std::endl;
    Random       random;
    unsigned int n_points[2] = {0, 0}, n_no_limit[2] = {0, 0};
    Largest      remainder, gap;
    for (unsigned int i = 0; i < 300; ++i)
      {
        // On the surface |x_t| = a x_n + k, on that of the polar cone,
        // a |x_t| = -(x_n + k/a), and the outward direction there.
        const double a    = random(0.05, 0.99);
        const double k    = i % 2;
        const double r    = random(0.5, 3.);
        const int    kind = i % 3 > 0;
        V            u    = random.vector<V>(1.);
        u[0]              = 0.;
        u /= u.norm();
        V x = r * u, outward = u;
        x[0]       = kind == 0 ? (r - k) / a : -k / a - a * r;
        outward[0] = kind == 0 ? -a : 1. / a;
        outward /= outward.norm();

        const MatrixOf<V> J     = jacobian(a, k, x);
        const MatrixOf<V> below = jacobian(a, k, V(x - 1e-8 * outward));
        const MatrixOf<V> above = jacobian(a, k, V(x + 1e-8 * outward));
        ++n_points[kind];
        n_no_limit[kind] +=
          !((J - below).norm() < 1e-6) && !((J - above).norm() < 1e-6);
        // The two limits differ, or else these were no kinks.
        gap.add(1. / (above - below).norm());

        for (const double size : {1e-3, 1e-5})
          {
            V d = random.vector<V>(1.);
            d *= size / d.norm();
            const V y = x + d;
            remainder.add(
              (project(a, k, y) - project(a, k, x) - jacobian(a, k, y) * d)
                .norm() /
              (size * size));
          }
      }
    std::cout << "on the cone " << n_points[0] << " points, on the polar cone "
              << n_points[1] << "; neither of the limits: " << n_no_limit[0]
              << " and " << n_no_limit[1] << std::endl;
    print_below("1/|jump of the Jacobian|", gap, "1.5");
    print_below("|P(x+d) - P(x) - J(x+d) d|/|d|^2", remainder, "10");

    // At the tip itself, where all three parts meet, J is the limit of one.
    V tip               = V::Zero();
    tip[0]              = -2.;
    const MatrixOf<V> J = jacobian(0.5, 1., tip);
    print("at the tip J is 0 or I", J.isZero(0.) || J.isIdentity(0.));
  }

  void
  test()
  {
    std::cout.precision(3);
    const double degree = std::acos(-1.) / 180.;
    for (const double a : {0., 0.1, std::sin(25. * degree), 0.99})
      for (const double k : {0., 1.})
        {
          check_smooth<Vector3>(a, k);
          check_smooth<Vector6>(a, k);
        }
    check_kinks<Vector3>();
    check_kinks<Vector6>();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_jacobian_01
