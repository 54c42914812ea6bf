// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a cone that hardens would not fulfil its law at the end of a step,
// Newton's matrix would not be the derivative of it, or implicit and explicit steps
// would harden differently. The law: s and z = S (s - t) lie on the cone of radius
// k + h |z_t|, by the natural map of that cone. Simple shear without friction has the
// closed form tau = c + (gamma - c/G) G H/(G + H).

#include <geocone/cone/varying_cone.h>
#include <geocone/kernels/point_block.h>
#include <geocone/laws/hardening_mohr_coulomb.h>

#include <sstream>

#include "../test.h"
#include "cone_tests.h"

namespace cone_hardening_01
{
  using namespace cone_tests;
  using namespace geocone;

  constexpr double K = 5., two_G = 2.;

  void
  check_cone(const FlowCone &cone)
  {
    Random       random;
    Largest      law, outside, difference;
    unsigned int counts[3] = {};
    for (unsigned int i = 0; i < 600; ++i)
      {
        const Mandel t = any_point<Mandel>(cone.a, cone.k, random);
        Mandel       s, s_plus, s_minus;
        MandelMatrix C, differences;
        const Mode   mode = return_map(cone, K, two_G, t, s, &C);
        const Mandel z(
          (s[0] - t[0]) / K, (s[1] - t[1]) / two_G, (s[2] - t[2]) / two_G);
        const FlowCone end = cone.hardened(FlowCone::tangential_norm(z));
        ++counts[static_cast<int>(mode)];
        outside.add(end.yield_function(s));
        outside.add(-cone.tension - s[0]);
        if (s[0] > -cone.tension + 1e-12)
          law.add(natural_map(end, s, Mandel(cone.psi(z)), two_G).norm());

        bool smooth = FlowCone::tangential_norm(t) > 0.1;
        for (int j = 0; j < 3; ++j)
          {
            Mandel        step = Mandel::Zero();
            MandelMatrix *none = nullptr;
            step[j]            = 1e-5;
            for (const double side : {50., 1.})
              smooth =
                smooth &&
                return_map(
                  cone, K, two_G, Mandel(t + side * step), s_plus, none) ==
                  mode &&
                return_map(
                  cone, K, two_G, Mandel(t - side * step), s_minus, none) ==
                  mode;
            differences.col(j) =
              (s_plus - s_minus) / 2e-5 * (j == 0 ? K : two_G);
          }
        if (smooth)
          difference.add((C - differences).norm());
      }
    std::cout << "a = " << cone.a << ", b = " << cone.b << ", k = " << cone.k
              << ", h = " << cone.hardening << ", cut-off " << cone.tension
              << ": " << counts[0] << " elastic, " << counts[1] << " cone, "
              << counts[2] << " apex" << std::endl;
    print_below("  natural map of the cone at the end", law, "1e-13");
    print_below("  outside of it", outside, "1e-13");
    print_below("  tangent against differences", difference, "1e-6");
  }

  /** Strength and dilatancy that fall with the slip of the step, faster here than there. */
  void
  check_varying(const double fall)
  {
    const auto cone_of = [&](const double slip) {
      const double part = std::exp(-fall * slip);
      return FlowCone{0.2 + 0.3 * part, 0.2 * part, 0.5 + 0.5 * part};
    };
    Random       random;
    Largest      law, outside, shear, difference;
    unsigned int counts[3] = {};
    for (unsigned int i = 0; i < 600; ++i)
      {
        const Mandel t = any_point<Mandel>(0.5, 1., random);
        Mandel       s, s_plus, s_minus;
        MandelMatrix C, differences, *none = nullptr;
        double       slip, other;
        const Mode mode = return_map_varying(cone_of, K, two_G, t, s, &C, slip);
        const Mandel z(
          (s[0] - t[0]) / K, (s[1] - t[1]) / two_G, (s[2] - t[2]) / two_G);
        const FlowCone end = cone_of(slip);
        ++counts[static_cast<int>(mode)];
        shear.add(std::abs(FlowCone::tangential_norm(z) - slip));
        outside.add(end.yield_function(s));
        law.add(natural_map(end, s, Mandel(end.psi(z)), two_G).norm());

        bool smooth = FlowCone::tangential_norm(t) > 0.1;
        for (int j = 0; j < 3; ++j)
          {
            Mandel step = Mandel::Zero();
            step[j]     = 1e-5;
            for (const double side : {50., 1.})
              smooth = smooth &&
                       return_map_varying(cone_of,
                                          K,
                                          two_G,
                                          Mandel(t + side * step),
                                          s_plus,
                                          none,
                                          other) == mode &&
                       return_map_varying(cone_of,
                                          K,
                                          two_G,
                                          Mandel(t - side * step),
                                          s_minus,
                                          none,
                                          other) == mode;
            differences.col(j) =
              (s_plus - s_minus) / 2e-5 * (j == 0 ? K : two_G);
          }
        if (smooth)
          difference.add((C - differences).norm());
      }
    std::cout << "falls by exp(-" << fall << " |z_t|): " << counts[0]
              << " elastic, " << counts[1] << " cone, " << counts[2] << " apex"
              << std::endl;
    print_below("  |z_t| against that of the cone", shear, "1e-13");
    print_below("  natural map of the cone at the end", law, "1e-13");
    print_below("  outside of it", outside, "1e-13");
    print_below("  tangent against differences", difference, "1e-5");
  }

  /** Simple shear with a mean stress, in steps, by both ways. */
  void
  shear(const char *name, const double phi, const double theta)
  {
    const double         c = 10e3, E = 26e6, nu = 0.3, H = 2e6, G = E / 2.6;
    const std::string    section = std::string("Materials/") + name;
    HardeningMohrCoulomb law(section);
    std::ostringstream   text;
    text << "subsection Materials\nsubsection " << name
         << "\nset Cohesion = " << c << "\nset Friction angle = " << phi
         << "\nset Dilatancy angle = " << theta << "\nset Young modulus = " << E
         << "\nset Poisson ratio = " << nu << "\nset Hardening modulus = " << H
         << "\nend\nend\n";
    auto &prm = dealii::ParameterAcceptor::prm;
    prm.parse_input_from_string(text.str());
    dealii::ParameterAcceptor::parse_all_parameters(prm);
    law.prepare();

    Mandel                stress = Mandel(-20e3, -20e3, 0.);
    std::array<double, 2> history;
    law.initialise(stress_of(extended(stress, -20e3)), 0., history.data());

    // Four lanes, as an explicit step wants them.
    using Lanes = std::array<double, PointBlock::lanes>;
    Lanes   xx = {}, s_xx, s_yy, s_xy = {}, plastic = {}, work, wave;
    Lanes   histories[2];
    double *arrays[2] = {histories[0].data(), histories[1].data()};
    s_xx.fill(-20e3);
    s_yy.fill(-20e3);
    histories[0].fill(history[0]);
    histories[1].fill(history[1]);

    Largest      closed, both, zz;
    LawCounts    counts;
    const double step = 1e-4;
    for (unsigned int n = 1; n <= 100; ++n)
      {
        const Mandel strain(0., 0., step / sqrt2), stress_n = stress;
        const auto   history_n = history;
        Mode         mode;
        Increment    increment;
        Response     response;
        increment.strain    = dealii::ArrayView<const Mandel>(&strain, 1);
        increment.stress_n  = dealii::ArrayView<const Mandel>(&stress_n, 1);
        increment.history_n = history_n.data();
        increment.n_history = 2;
        response.stress     = dealii::ArrayView<Mandel>(&stress, 1);
        response.mode       = dealii::ArrayView<Mode>(&mode, 1);
        response.history    = history.data();
        law.update(increment, response);

        // The same without rotation: symmetric gradient.
        Lanes xy;
        xy.fill(step / 2.);
        law.advance({PointBlock::lanes,
                     {{xx.data(), xy.data(), xy.data(), xx.data()}},
                     {{s_xx.data(), s_yy.data(), s_xy.data()}},
                     arrays,
                     plastic.data(),
                     work.data(),
                     wave.data()},
                    counts);
        const double tau = stress[2] / sqrt2, gamma = n * step;
        if (phi == 0.)
          closed.add(std::abs(tau - (G * gamma <= c ? G * gamma
                                                    : c + (gamma - c / G) * G *
                                                            H / (G + H))) /
                     c);
        both.add(std::abs(tau - s_xy[1]) / c);
        both.add(std::abs(stress[0] - s_xx[1]) / c);
        both.add(std::abs(stress[1] - s_yy[1]) / c);
        both.add(std::abs(history[1] - histories[1][1]));
        // Flow in the plane: the elastic strain zz stays.
        const double s_zz =
          law.stress_zz({{stress[0], stress[1], tau}}, history.data());
        zz.add(std::abs((s_zz + 20e3) - nu * (stress[0] + stress[1] + 40e3)) /
               c);
      }
    std::cout << name << ": gamma_p " << history[1] << std::endl;
    if (phi == 0.)
      print_below("  error of tau/c against the closed form", closed, "1e-12");
    print_below("  implicit against explicit", both, "1e-12");
    print_below("  out-of-plane stress", zz, "1e-12");
    print("  symmetric tangent", law.has_symmetric_tangent());
    print("  the cohesion has grown",
          law.flow_cone(history.data())->k >
            law.flow_cone(std::array<double, 2>().data())->k);
  }

  void
  test()
  {
    const double none = std::numeric_limits<double>::infinity();
    check_cone({0., 0., 1., none, 0.7});
    check_cone({0.423, 0.423, 1., none, 0.7});
    check_cone({0.423, 0.2, 1., none, 0.7});
    check_cone({0.423, 0., 1., none, 3.});
    check_cone({0.423, 0., 1., none, 0.});
    check_cone({0.2, 0.2, 1., 2., 0.7});
    check_varying(0.);
    check_varying(0.3);
    check_varying(3.);
    shear("Tresca", 0., 0.);
    shear("associated", 30., 30.);
    shear("without dilatancy", 30., 0.);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_hardening_01
