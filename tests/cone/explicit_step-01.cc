// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// An explicit step of a block of points: the kernel of the cones against the path
// that any law in closed form takes, update() of the turned stress. Random states
// and increments with all modes in them; large spins, which must not change
// invariants.

#include <geocone/laws/mohr_coulomb.h>

#include <array>
#include <iostream>
#include <random>

#include "../test.h"
#include "cone_tests.h"

namespace cone_explicit_step_01
{
  using namespace cone_tests;
  using namespace geocone;

  /** The same law, which does not tell that it has a cone. */
  class Veiled : public MohrCoulomb
  {
  public:
    using MohrCoulomb::MohrCoulomb;

    std::optional<FlowCone>
    flow_cone(const double *) const override
    {
      return std::nullopt;
    }
  };

  constexpr unsigned int n = PointBlock::capacity;

  struct Points
  {
    std::array<double, n> l_xx, l_xy, l_yx, l_yy, s_xx, s_yy, s_xy, plastic,
      work, modulus, constant;
    double *history = nullptr;

    PointBlock
    block()
    {
      history = constant.data();
      return {n,
              {{l_xx.data(), l_xy.data(), l_yx.data(), l_yy.data()}},
              {{s_xx.data(), s_yy.data(), s_xy.data()}},
              &history,
              plastic.data(),
              work.data(),
              modulus.data()};
    }
  };

  void
  compare(const char  *name,
          const double phi,
          const double theta,
          const double c)
  {
    const std::string section = std::string("Materials/") + name;
    MohrCoulomb       law(section);
    Veiled            veiled(section + " veiled");
    for (const std::string &of : {section, section + " veiled"})
      {
        std::ostringstream text;
        text << "subsection Materials\nsubsection " << of.substr(10)
             << "\nset Cohesion = " << c << "\nset Friction angle = " << phi
             << "\nset Dilatancy angle = " << theta
             << "\nset Young modulus = 1e6\nend\nend\n";
        dealii::ParameterAcceptor::prm.parse_input_from_string(text.str());
      }
    dealii::ParameterAcceptor::parse_all_parameters(
      dealii::ParameterAcceptor::prm);
    law.prepare();
    veiled.prepare();

    std::mt19937 engine(1);
    const auto   random = [&](const double size) {
      return size * (2. * (engine() + 0.5) / 4294967296. - 1.);
    };
    Largest      difference, work, plastic;
    unsigned int n_elastic = 0, n_apex = 0;
    for (unsigned int round = 0; round < 50; ++round)
      {
        Points a;
        for (unsigned int p = 0; p < n; ++p)
          {
            a.l_xx[p] = random(0.01), a.l_yy[p] = random(0.01);
            a.l_xy[p] = random(0.3), a.l_yx[p] = -a.l_xy[p] + random(0.01);
            a.s_xx[p] = random(2e4), a.s_yy[p] = random(2e4);
            a.s_xy[p] = random(1e4), a.plastic[p] = 0.;
            a.constant[p] = random(1e4);
          }
        Points    b = a;
        LawCounts counts;
        law.advance(a.block(), counts);
        veiled.advance(b.block(), counts);
        for (unsigned int p = 0; p < n; ++p)
          {
            difference.add(std::abs(a.s_xx[p] - b.s_xx[p]) / 1e4);
            difference.add(std::abs(a.s_yy[p] - b.s_yy[p]) / 1e4);
            difference.add(std::abs(a.s_xy[p] - b.s_xy[p]) / 1e4);
            work.add(std::abs(a.work[p] - b.work[p]) / 1e3);
            plastic.add(std::abs(a.plastic[p] - b.plastic[p]));
            n_elastic += a.plastic[p] == 0.;
            n_apex +=
              a.plastic[p] > 0. &&
              std::abs(a.s_xx[p] - a.s_yy[p]) + std::abs(a.s_xy[p]) < 1e-8;
          }
      }
    std::cout << name << std::endl;
    print("  some points are elastic", n_elastic > 0);
    print("  some end at the apex, where there is one",
          (n_apex > 0) == (phi > 0.));
    print_below("  difference of stress/10 kPa", difference, "1e-12");
    print_below("  difference of work/1 kPa", work, "1e-12");
    print_below("  difference of plastic strain", plastic, "1e-12");
  }

  void
  test()
  {
    compare("associated", 30., 30., 1000.);
    compare("without dilatancy", 30., 0., 0.);
    compare("Tresca", 0., 0., 5000.);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_explicit_step_01
