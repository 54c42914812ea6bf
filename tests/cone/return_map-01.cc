// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, stresses would not be those of the law. return_map() is
// compared with another algorithm that knows none of its formulas: with w for
// the dilatancy defect (a-b)|z_t|, the law s = t + D z, -Psi(z) in the normal
// cone of C at s, is the D^{-1}-projection of t - K w n onto C, which bisection
// finds; and w is iterated to its fixed point. Then the result is put into the
// law itself, by the measures that judge computed states, and these must also
// notice states that are wrong.

#include <geocone/cone/second_order_cone.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_return_map_01
{
  using namespace cone_tests;
  using geocone::FlowCone;
  using geocone::Mode;
  using geocone::natural_map;

  /** argmin over s in C of (s - t).D^{-1}(s - t): on the ray s_t = r t_t/|t_t|.
   */
  template <typename V>
  V
  nearest(const double a,
          const double k,
          const double K,
          const double two_G,
          const V     &t)
  {
    constexpr int m = V::RowsAtCompileTime;
    const double  T = t.template tail<m - 1>().norm();
    // For given r, the best s_n is the one nearest to t_n with r <= a s_n + k.
    const auto normal = [&](const double r) {
      return a > 0. ? std::fmax(t[0], (r - k) / a) : t[0];
    };
    const auto derivative = [&](const double r) {
      return (r - T) / two_G + (a > 0. ? (normal(r) - t[0]) / (a * K) : 0.);
    };
    double low = 0., high = a > 0. ? T : std::fmin(T, k);
    if (derivative(high) <= 0.)
      low = high;
    if (derivative(low) >= 0.)
      high = low;
    for (double middle;
         middle = (low + high) / 2., low < middle && middle < high;)
      (derivative(middle) < 0. ? low : high) = middle;
    V s;
    s[0] = normal(high);
    s.template tail<m - 1>() =
      t.template tail<m - 1>() * (T > 0. ? high / T : 0.);
    return s;
  }

  /** D^{-1} x. */
  template <typename V>
  V
  compliance(const double K, const double two_G, const V &x)
  {
    V z  = x / two_G;
    z[0] = x[0] / K;
    return z;
  }

  template <typename V>
  V
  brute_force(const FlowCone &cone,
              const double    K,
              const double    two_G,
              const V        &t)
  {
    constexpr int m = V::RowsAtCompileTime;
    double        w = 0.;
    for (unsigned int i = 0;; ++i)
      {
        V shifted = t;
        shifted[0] -= K * w;
        const V      s = nearest(cone.a, cone.k, K, two_G, shifted);
        const double w_next =
          (cone.a - cone.b) *
          compliance(K, two_G, V(s - shifted)).template tail<m - 1>().norm();
        if (std::abs(w_next - w) <= 1e-16 * (1. + w) || i == 2000)
          return s;
        w = w_next;
      }
  }

  struct Errors
  {
    Largest difference, infeasible, map, dual, product, inequality, creation;
  };

  /** The rest has no dimension, so that K/2G, a, b and k = 0 or 1 are all. */
  template <typename V>
  void
  check_law(const FlowCone &cone,
            const double    K,
            unsigned int (&counts)[3],
            Errors &errors)
  {
    const double two_G = 1.;
    Random       random;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const V    t = any_point<V>(cone.a, cone.k, random);
        V          s;
        const Mode mode = geocone::return_map(
          cone, K, two_G, t, s, static_cast<MatrixOf<V> *>(nullptr));
        ++counts[static_cast<int>(mode)];
        errors.difference.add((s - brute_force(cone, K, two_G, t)).norm());

        const V z = compliance(K, two_G, V(s - t));
        const V y = cone.psi(z);
        errors.infeasible.add(cone.yield_function(s));
        for (const double rho : {0.01, 1., 100.})
          errors.map.add(natural_map(cone, s, y, rho).norm());
        errors.dual.add(cone.dual_violation(y));
        errors.product.add(std::abs(cone.complementarity_product(y, s)));
        // What the law says before any reformulation: <y, c - s> >= 0.
        for (unsigned int j = 0; j < 20; ++j)
          errors.inequality.add(
            -y.dot(feasible_point<V>(cone.a, cone.k, random) - s));
        // Plastic flow dissipates energy, and never creates it.
        errors.creation.add(z.dot(s));
      }
  }

  const char *const wrong_states[6] = {"flow inside",
                                       "not returned",
                                       "stress inside",
                                       "stress outside",
                                       "flow turned",
                                       "dilatancy a"};

  /** Counts wrong states, and those of them that are taken for solutions. */
  template <typename V>
  void
  count_unnoticed(const FlowCone &cone,
                  const double    K,
                  unsigned int (&tried)[6],
                  unsigned int (&unnoticed)[6])
  {
    constexpr int m = V::RowsAtCompileTime;
    Random        random;
    const auto    judge = [&](const int kind, const V &s, const V &y) {
      ++tried[kind];
      unnoticed[kind] += !(natural_map(cone, s, y, 1.).norm() > 1e-6);
    };
    for (unsigned int i = 0; i < 200; ++i)
      {
        const V    t = any_point<V>(cone.a, cone.k, random);
        V          s;
        const Mode mode = geocone::return_map(
          cone, K, 1., t, s, static_cast<MatrixOf<V> *>(nullptr));
        const V z = compliance(K, 1., V(s - t));
        if (mode == Mode::elastic && cone.yield_function(s) < -0.1)
          judge(0, s, cone.psi(V(1e-3 * random.vector<V>(1.))));
        if (mode == Mode::elastic || z.norm() < 0.1)
          continue;

        judge(1, t, V(V::Zero()));
        V towards_axis = V::Zero();
        towards_axis.template tail<m - 1>() =
          1e-3 * t.template tail<m - 1>() / FlowCone::tangential_norm(t);
        towards_axis[0] = -1e-3 * cone.a;
        if (mode == Mode::cone && s.template tail<m - 1>().norm() > 0.1)
          judge(2, V(s - towards_axis), cone.psi(z));
        judge(3, V(s + towards_axis), cone.psi(z));
        if (mode == Mode::cone && s.template tail<m - 1>().norm() > 0.1)
          {
            V turned = z;
            turned[1] += 0.1 * z[2];
            turned[2] -= 0.1 * z[1];
            if (std::hypot(z[1], z[2]) > 0.1 * z.norm())
              judge(4, s, cone.psi(turned));
          }
        // Without Psi the flow of b < a is not normal to C.
        if (mode == Mode::cone && cone.b < cone.a)
          judge(5, s, z);
      }
  }

  void
  test()
  {
    const double degree = std::acos(-1.) / 180.;
    std::cout.precision(3);
    for (const double a :
         {0., std::sin(25. * degree), std::sin(45. * degree), 0.99})
      for (const double ratio : {1., 0.5, 0.})
        {
          if (a == 0. && ratio < 1.)
            continue;
          unsigned int counts[3] = {}, tried[6] = {}, unnoticed[6] = {};
          Errors       errors;
          for (const double k : {0., 1.})
            for (const double K : {2.5, 50.}) // Poisson's ratio 0.3 and 0.49
              {
                const FlowCone cone{a, ratio * a, k};
                check_law<Vector3>(cone, K, counts, errors);
                check_law<Vector6>(cone, K, counts, errors);
                count_unnoticed<Vector3>(cone, K, tried, unnoticed);
                count_unnoticed<Vector6>(cone, K, tried, unnoticed);
              }
          std::cout << "a = " << a << ", b = " << ratio * a << ": " << counts[0]
                    << " elastic, " << counts[1] << " cone, " << counts[2]
                    << " apex" << std::endl;
          print_below(
            "  difference from brute force", errors.difference, "1e-9");
          print_below("  yield function", errors.infeasible, "1e-11");
          print_below("  natural map", errors.map, "1e-11");
          print_below("  dual violation", errors.dual, "1e-11");
          print_below("  complementarity", errors.product, "1e-10");
          print_below("  -<y, c - s>", errors.inequality, "1e-10");
          print_below("  energy created", errors.creation, "1e-11");
          std::cout << "  wrong states unnoticed:";
          for (unsigned int kind = 0; kind < 6; ++kind)
            std::cout << (kind > 0 ? ", " : " ") << wrong_states[kind] << " "
                      << unnoticed[kind] << " of " << tried[kind];
          std::cout << std::endl;
        }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_return_map_01
