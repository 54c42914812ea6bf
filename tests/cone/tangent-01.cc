// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, Newton's matrix would not be the derivative of its residual
// (slow or no convergence), or not be symmetric where the solver takes it for
// symmetric. ds/de is compared with central differences in all modes, in cone
// axes for 3 and 6 components and in Mandel components with Elasticity as the
// materials use them.

#include <geocone/cone/second_order_cone.h>
#include <geocone/kernels/elasticity.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_tangent_01
{
  using namespace cone_tests;
  using geocone::Elasticity;
  using geocone::FlowCone;
  using geocone::from_cone_axes;
  using geocone::Mandel;
  using geocone::MandelMatrix;
  using geocone::Mode;
  using geocone::to_cone_axes;

  /** f and q of the return map: it has its kinks where they vanish. */
  template <typename V>
  bool
  near_kink(const FlowCone &cone,
            const double    K,
            const double    two_G,
            const V        &t)
  {
    const double T = FlowCone::tangential_norm(t);
    const double f = cone.yield_function(t);
    const double q = T - two_G * f / (two_G + cone.a * cone.b * K);
    return std::abs(f) < 0.01 || (f > 0. && std::abs(q) < 0.01) ||
           (f > 0. && T < 0.1);
  }

  struct Result
  {
    unsigned int counts[3] = {0, 0, 0};
    Largest      difference, asymmetry;
    double       least_cone_asymmetry = 1e10;

    template <typename M>
    void
    add(const Mode mode, const M &C, const M &differences, const double K)
    {
      const double skew = (C - C.transpose()).norm() / K;
      ++counts[static_cast<int>(mode)];
      difference.add((C - differences).norm() / K);
      asymmetry.add(skew);
      if (mode == Mode::cone)
        least_cone_asymmetry = std::fmin(least_cone_asymmetry, skew);
    }

    void
    print(const FlowCone &cone) const
    {
      std::cout << "a = " << cone.a << ", b = " << cone.b << ", k = " << cone.k
                << ": " << counts[0] << " elastic, " << counts[1] << " cone, "
                << counts[2] << " apex; symmetric: "
                << (asymmetry.value < 1e-14       ? "yes"
                    : least_cone_asymmetry > 1e-3 ? "no"
                                                  : "sometimes")
                << ", ";
      print_below("error against differences", difference, "1e-6");
    }
  };

  /** In cone axes, t = D e with D = diag(K, 2G, ...). */
  template <typename V>
  Result
  check_cone_axes(const FlowCone &cone, const double K, const double two_G)
  {
    constexpr int m = V::RowsAtCompileTime;
    Random        random;
    Result        result;
    for (unsigned int i = 0; i < 300; ++i)
      {
        const V t = any_point<V>(cone.a, cone.k, random);
        if (near_kink(cone, K, two_G, t))
          continue;
        MatrixOf<V> C, differences, *none = nullptr;
        C.setConstant(std::nan("")); // all entries have to be written
        V          s, s_plus, s_minus;
        const Mode mode = geocone::return_map(cone, K, two_G, t, s, &C);
        for (int j = 0; j < m; ++j)
          {
            V step  = V::Zero();
            step[j] = 1e-5; // stress
            geocone::return_map(cone, K, two_G, V(t + step), s_plus, none);
            geocone::return_map(cone, K, two_G, V(t - step), s_minus, none);
            differences.col(j) =
              (s_plus - s_minus) / 2e-5 * (j == 0 ? K : two_G);
          }
        result.add(mode, C, differences, K);
      }
    return result;
  }

  /** As a material does it: Mandel components, s = s_n + D e. */
  Result
  check_mandel(const FlowCone &cone, const Elasticity &elasticity)
  {
    const double K      = elasticity.normal_stiffness();
    const double two_G  = elasticity.two_G;
    const auto   update = [&](const Mandel &stress_n,
                            const Mandel &strain,
                            Mandel       &stress,
                            MandelMatrix *C) {
      Mandel       s;
      MandelMatrix tangent;
      const Mode   mode =
        geocone::return_map(cone,
                            K,
                            two_G,
                            to_cone_axes(stress_n + elasticity.stress(strain)),
                            s,
                            C != nullptr ? &tangent : nullptr);
      stress = from_cone_axes(s);
      if (C != nullptr)
        *C = from_cone_axes(tangent);
      return mode;
    };
    Random random;
    Result result;
    for (unsigned int i = 0; i < 300; ++i)
      {
        const Mandel t = any_point<Mandel>(cone.a, cone.k, random);
        if (near_kink(cone, K, two_G, t))
          continue;
        const Mandel stress_n = random.vector<Mandel>(1.);
        const Mandel strain =
          elasticity.strain(Mandel(from_cone_axes(t) - stress_n));
        Mandel       s, s_plus, s_minus;
        MandelMatrix C, differences;
        const Mode   mode = update(stress_n, strain, s, &C);
        const double h    = 1e-5 / K;
        for (int j = 0; j < 3; ++j)
          {
            Mandel step = Mandel::Zero();
            step[j]     = h;
            update(stress_n, Mandel(strain + step), s_plus, nullptr);
            update(stress_n, Mandel(strain - step), s_minus, nullptr);
            differences.col(j) = (s_plus - s_minus) / (2. * h);
          }
        result.add(mode, C, differences, K);
      }
    return result;
  }

  void
  check_axes()
  {
    Random  random;
    Largest there_and_back, products, maps, elastic, inverse, diagonal;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const Mandel s = random.vector<Mandel>(1.),
                     e = random.vector<Mandel>(1.);
        there_and_back.add((from_cone_axes(to_cone_axes(s)) - s).norm());
        there_and_back.add((to_cone_axes(from_cone_axes(s)) - s).norm());
        products.add(std::abs(to_cone_axes(s).dot(to_cone_axes(e)) - s.dot(e)));
        // A map is the same in both axes: (C x in cone axes) = C (x in cone
        // axes).
        MandelMatrix C;
        for (int j = 0; j < 3; ++j)
          C.col(j) = random.vector<Mandel>(1.);
        maps.add(
          (from_cone_axes(C) * e - from_cone_axes(Mandel(C * to_cone_axes(e))))
            .norm());

        const Elasticity elasticity(random(0.5, 2.), random(-0.9, 0.49));
        const double     K = elasticity.normal_stiffness();
        elastic.add((elasticity.stiffness() * e - elasticity.stress(e)).norm() /
                    K);
        inverse.add((elasticity.strain(elasticity.stress(e)) - e).norm());
        MandelMatrix D = elasticity.two_G * MandelMatrix::Identity();
        D(0, 0)        = K;
        diagonal.add((from_cone_axes(D) - elasticity.stiffness()).norm() / K);
      }
    print_below("axes there and back", there_and_back, "1e-14");
    print_below("change of scalar products", products, "1e-14");
    print_below("maps in both axes", maps, "1e-14");
    print_below("stiffness against stress()", elastic, "1e-14");
    print_below("strain() of stress()", inverse, "1e-13");
    print_below("diag(K, 2G, 2G) against stiffness()", diagonal, "1e-14");

    // Pressure 1 is sqrt2 along the axis; |s_t| is sqrt2 times Mohr's radius.
    std::cout
      << "pressure: " << to_cone_axes(Mandel(-1., -1., 0.)).transpose()
      << std::endl
      << "shear: "
      << to_cone_axes(Mandel(3., -3., geocone::sqrt2 * 4.)).tail<2>().norm() /
           geocone::sqrt2
      << std::endl;
    // E = 2.6, nu = 0.3: 2G = 2, lambda = 1.5, K = 5.
    const Elasticity elasticity(2.6, 0.3);
    std::cout << "moduli: " << elasticity.two_G << " " << elasticity.lambda
              << " " << elasticity.normal_stiffness() << std::endl;
  }

  void
  test()
  {
    std::cout.precision(10);
    check_axes();

    std::cout.precision(3);
    const double a25 = std::sin(std::acos(-1.) / 180. * 25.);
    for (const FlowCone &cone : {FlowCone{0., 0., 1.},
                                 FlowCone{0.1, 0.1, 1.},
                                 FlowCone{a25, a25, 1.},
                                 FlowCone{a25, a25 / 2., 1.},
                                 FlowCone{a25, 0., 1.},
                                 FlowCone{0.9, 0.9, 0.},
                                 FlowCone{0.9, 0.45, 0.},
                                 FlowCone{0.9, 0., 0.}})
      for (const double nu : {0.3, 0.49})
        {
          std::cout << "nu = " << nu << std::endl;
          const Elasticity elasticity(1. + nu, nu); // 2G = 1
          const double     K = elasticity.normal_stiffness();
          check_cone_axes<Vector3>(cone, K, 1.).print(cone);
          check_cone_axes<Vector6>(cone, K, 1.).print(cone);
          check_mandel(cone, elasticity).print(cone);
        }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_tangent_01
