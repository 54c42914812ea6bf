// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, cycles would leave 0 <= R <= 1, reversals would be missed, or
// strain would not accumulate as the reference program measured. Also what
// happens without stiffness, when p comes to -pe.

#include "../test.h"
#include "subloading_tests.h"

#include <algorithm>

namespace subloading_cyclic_01
{
  using namespace subloading_tests;

  void
  test()
  {
    // Undrained triaxial cycles of +-0.3 %, ten of them after a first +0.3 %.
    // Reference: R <= 0.323, Rb from 2 to 1.52; p = 73.3 falls to 65 at first.
    {
      const SubloadingModel<6> model(all_features(1e-4));
      auto                     y      = structured_state<6>(0);
      const Vector6            strain = 1e-5 * axial<6>(1., -.5, 0);
      double                   most = 0., least_p = 100., inside = -1.;
      unsigned int             forced = 0;
      for (int leg = 0; leg < 21; ++leg)
        for (int i = 0; i < (leg == 0 ? 300 : 600); ++i)
          {
            forced +=
              model.integrate(y, (leg % 2 == 0 ? 1. : -1.) * strain).forced;
            const double R = model.ratio(y);
            most           = std::max(most, R);
            least_p        = std::min(least_p, pressure(y.stress));
            inside         = std::max(inside,
                              model.yield_function(y.a, y.beta, y.pcb) /
                                (y.pcb * y.pcb));
          }
      std::cout << "undrained cycles: R up to " << std::round(1e3 * most) / 1e3
                << ", Rb " << std::round(1e2 * y.Rb) / 1e2 << ", least p "
                << std::round(least_p) << std::endl;
      print("  the centre stays inside", inside < 0.);
      print("  no substep was forced", forced == 0);
    }

    // Oedometric stress cycles between 80 and 160. Reference: the residual strain
    // grows by (1.53 1.10 0.76 0.40 0.10 -0.09 -0.18) 1e-3.
    {
      const SubloadingModel<4> model(all_features(1e-5));
      auto                     y     = structured_state<4>(1);
      double                   total = 0., most = 0.;
      const auto               go_to = [&](const double stress) {
        // Small strains up to the target, and the last one by the secant.
        const double sign = stress > y.stress[1] ? 1. : -1.;
        while (true)
          {
            auto         z = y;
            const double e = sign * 1e-5;
            model.integrate(z, axial<4>(e, 0., 1));
            most = std::max(most, model.ratio(z));
            if (sign * (z.stress[1] - stress) >= 0.)
              {
                const double part =
                  (stress - y.stress[1]) / (z.stress[1] - y.stress[1]);
                model.integrate(y, axial<4>(part * e, 0., 1));
                total += part * e;
                return;
              }
            y = z;
            total += e;
          }
      };
      std::vector<double> at_80;
      for (int cycle = 0; cycle < 8; ++cycle)
        {
          go_to(160.);
          go_to(80.);
          at_80.push_back(total);
        }
      std::cout << "oedometric cycles: residual strain increments (1e-3)";
      for (std::size_t i = 1; i < at_80.size(); ++i)
        std::cout << " " << std::round(1e5 * (at_80[i] - at_80[i - 1])) / 1e2;
      std::cout << std::endl;
      // Reference: up to 0.364, at its stops.
      print("  R up to 0.364", std::abs(most - .364) < .004);
    }

    // Large cycles: R never passes 1 by more than the tolerance.
    for (const double tolerance : {1e-3, 1e-5})
      {
        const SubloadingModel<4> model(all_features(tolerance));
        auto                     y     = structured_state<4>(1);
        double                   least = 1., most = 0.;
        for (int cycle = 0; cycle < 4; ++cycle)
          for (int i = 0; i < 800; ++i)
            {
              const double sign = i < 200 || i >= 600 ? 1. : -1.;
              model.integrate(y, Vector4(0., 0., 0., sign * sqrt2 * 1e-3));
              least = std::min(least, model.ratio(y));
              most  = std::max(most, model.ratio(y));
            }
        print("cycles of +-20 %: 0 <= R <= 1 + STOL",
              least >= 0. && most > .99 && most <= 1. + tolerance);
        if (!(most <= 1. + tolerance))
          std::cout << most << std::endl;
      }

    // Isotropic extension by 10 % and back: p stays above -pe. The elastic line
    // p + pe = (p0 + pe) exp(eps_v/kappa) is left at most for a higher p.
    for (const double tension : {0., 1.})
      {
        SubloadingConstants c = all_features(1e-4);
        c.xi                  = .02 * tension;
        c.pe                  = 2. * tension;
        const SubloadingModel<6> model(c);
        auto                     y      = structured_state<6>(0);
        double                   least  = 1e300;
        unsigned int             forced = 0, most = 0;
        bool                     limited = false;
        for (const double sign : {-1., 1.})
          for (int i = 0; i < 100; ++i)
            {
              const auto report =
                model.integrate(y, sign * axial<6>(1e-3 / 3., 1e-3 / 3., 0));
              forced += report.forced;
              most    = std::max(most, report.substeps);
              limited = limited || report.limited;
              least   = std::min(least, pressure(y.stress) + c.pe);
            }
        print("extension: p > -pe, nothing forced or limited",
              least > 0. && forced == 0 && !limited && most < 100);
        print("  and compressed again",
              std::isfinite(y.stress.norm()) && pressure(y.stress) > 50.);
        // The whole extension in one call.
        c.tolerance  = 1e-3;
        auto       z = structured_state<6>(0);
        const auto report =
          SubloadingModel<6>(c).integrate(z, axial<6>(-.08 / 3., -.08 / 3., 0));
        print("  8 % in one call",
              report.forced == 0 && report.substeps < 120 &&
                pressure(z.stress) + c.pe > 0.);
      }

    // Without end: the pressure is kept, and it is counted.
    {
      SubloadingConstants c = cam_clay(1e-4);
      c.lowest_pressure     = .001;
      const SubloadingModel<6> model(c);
      auto                     y       = isotropic_state<6>(100., 0., 100.);
      bool                     limited = false;
      for (int i = 0; i < 100; ++i)
        limited =
          model.integrate(y, axial<6>(-.01, -.01, 0)).limited || limited;
      print("extension without end is limited",
            limited && std::abs(pressure(y.stress) - .001) < 1e-12);
      // From there the elastic line: p = .001 exp(eps_v/kappa).
      model.integrate(y, axial<6>(.01, .01, 0));
      Comparison back;
      back.add(pressure(y.stress), .001 * std::exp(3.));
      back.print_within("and closes again", 1e-9);
    }

    // With stiffness in tension (pe > 0) and no apex there (xi = 0), soil that is
    // pulled apart by 100 % yields until its surface has the smallest size, and
    // bears load again at once: without the limit pcb would be 260 exp(-1/.07).
    {
      SubloadingConstants c = all_features(1e-4);
      c.xi                  = 0.;
      c.smallest_size       = 1.;
      const SubloadingModel<6> model(c);
      auto                     y       = structured_state<6>(0);
      bool                     limited = false;
      unsigned int             forced  = 0;
      double                   most    = 0.;
      for (int i = 0; i < 2200; ++i)
        {
          const double e =
            (i < 1000 ? -1. : 1.) * (i % 1000 < 500 ? 1e-3 : 1.1e-3) / 3.;
          const auto report = model.integrate(y, axial<6>(1.2 * e, .9 * e, 0));
          limited           = limited || report.limited;
          forced += report.forced;
          most = std::max(most, model.ratio(y));
          if (i == 999)
            print("pulled apart: the size is the smallest",
                  limited && y.pcb > .99 && y.pcb < 1.01);
        }
      print("  R <= 1 + O(STOL), nothing forced", most <= 1.001 && forced == 0);
      print("  loads of more than 1 MPa when compressed",
            pressure(y.stress) > 1e3);
    }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace subloading_cyclic_01
