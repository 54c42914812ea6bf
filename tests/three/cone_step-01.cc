// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// An explicit step in three dimensions: the kernel of the cones in R^6 against the path
// that any law in closed form takes, update() of the turned stress; random states with
// all shears. The rotation against that about the axis by twice the arc tangent.

#include <geocone/kernels/spin.h>
#include <geocone/laws/drucker_prager.h>

#include <Eigen/Geometry>
#include <array>
#include <iostream>
#include <sstream>

#include "../cone/cone_tests.h"
#include "../test.h"

namespace three_cone_step_01
{
  using namespace cone_tests;
  using namespace geocone;

  /** The same law, which does not tell that it has a cone. */
  class Veiled : public DruckerPrager
  {
  public:
    using DruckerPrager::DruckerPrager;

    std::optional<FlowCone>
    flow_cone(const double *) const override
    {
      return std::nullopt;
    }
  };

  constexpr unsigned int n = PointBlock::capacity;
  using Lanes              = std::array<double, n>;

  struct Points
  {
    std::array<Lanes, 9> l;
    std::array<Lanes, 6> s;
    Lanes                plastic = {}, work, modulus;

    PointBlock
    block()
    {
      PointBlock points;
      points.n_points = n;
      for (unsigned int i = 0; i < 9; ++i)
        points.l[i] = l[i].data();
      for (unsigned int i = 0; i < 6; ++i)
        points.s[i] = s[i].data();
      points.plastic_strain = plastic.data();
      points.work           = work.data();
      points.wave_modulus   = modulus.data();
      return points;
    }
  };

  void
  compare(const char  *name,
          const double phi,
          const double theta,
          const double c)
  {
    const std::string section = std::string("Materials/") + name;
    DruckerPrager     law(section);
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

    Random       random;
    Largest      difference, work, plastic;
    unsigned int n_elastic = 0, n_apex = 0;
    for (unsigned int round = 0; round < 50; ++round)
      {
        Points a;
        for (unsigned int p = 0; p < n; ++p)
          {
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j <= i; ++j)
                {
                  const double spin = i == j ? 0. : random(-0.3, 0.3);
                  a.l[3 * i + j][p] = spin + random(-0.01, 0.01);
                  if (i != j)
                    a.l[3 * j + i][p] = -spin;
                }
            for (unsigned int i = 0; i < 6; ++i)
              a.s[i][p] = random(-2e4, 2e4);
          }
        Points    b = a;
        LawCounts counts;
        law.advance(a.block(), counts);
        veiled.advance(b.block(), counts);
        for (unsigned int p = 0; p < n; ++p)
          {
            for (unsigned int i = 0; i < 6; ++i)
              difference.add(std::abs(a.s[i][p] - b.s[i][p]) / 1e4);
            work.add(std::abs(a.work[p] - b.work[p]) / 1e3);
            plastic.add(std::abs(a.plastic[p] - b.plastic[p]));
            n_elastic += a.plastic[p] == 0.;
            double deviator = 0.;
            for (const unsigned int i : {2, 4, 5})
              deviator += std::abs(a.s[i][p]);
            n_apex += a.plastic[p] > 0. && deviator < 1e-8;
          }
      }
    std::cout << name << std::endl;
    std::cout << "  some points are elastic: " << (n_elastic > 0 ? "yes" : "NO")
              << std::endl;
    std::cout << "  some end at the apex, where there is one: "
              << ((n_apex > 0) == (phi > 0.) ? "yes" : "NO") << std::endl;
    print_below("  difference of stress/10 kPa", difference, "1e-12");
    print_below("  difference of work/1 kPa", work, "1e-12");
    print_below("  difference of plastic strain", plastic, "1e-12");
  }

  void
  compare_rotations()
  {
    Random  random;
    Largest difference;
    for (unsigned int round = 0; round < 100; ++round)
      {
        std::array<double, 9> l;
        for (double &value : l)
          value = random(-1., 1.);
        std::array<double, 6> s;
        for (double &value : s)
          value = random(-1., 1.);
        const Eigen::Vector3d half =
          Eigen::Vector3d(l[7] - l[5], l[2] - l[6], l[3] - l[1]) / 4.;
        const Eigen::Matrix3d Q =
          Eigen::AngleAxisd(2. * std::atan(half.norm()), half.normalized())
            .toRotationMatrix();
        const Eigen::Matrix3d t = spatial_tensor(mandel_of_components(s));
        Spin(l).turn(s);
        const Eigen::Matrix3d turned = spatial_tensor(mandel_of_components(s));
        difference.add((turned - Q * t * Q.transpose()).norm());
      }
    print_below(
      "rotation by Cayley's transform: difference", difference, "1e-14");
  }

  void
  test()
  {
    compare("associated", 30., 30., 5e3);
    compare("without dilatancy", 30., 0., 5e3);
    compare("von Mises", 0., 0., 5e3);
    compare_rotations();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace three_cone_step_01
