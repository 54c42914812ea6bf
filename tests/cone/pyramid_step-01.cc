// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// An explicit step of a block of points by Mohr-Coulomb's law of all principal
// stresses: the kernel that takes four at once against the path that any law in closed
// form takes, update() of the turned stress. Random states in which all of them differ
// and such in which two or all are equal, with and without friction that remembers and
// cohesion that grows; large spins.

#include <geocone/laws/spatial_mohr_coulomb.h>

#include <array>
#include <iostream>
#include <sstream>

#include "../cone/cone_tests.h"
#include "../test.h"

namespace cone_pyramid_step_01
{
  using namespace cone_tests;
  using namespace geocone;

  constexpr unsigned int n = PointBlock::capacity;
  using Lanes              = std::array<double, n>;

  struct Points
  {
    std::array<Lanes, dim *dim> l    = {};
    std::array<Lanes, n_mandel> s    = {};
    std::array<Lanes, 3>        own  = {}; // history
    Lanes                       l_zz = {}, plastic = {}, work, modulus;

    std::array<double *, 3> history;

    PointBlock
    block(const bool around_axis)
    {
      PointBlock points;
      points.n_points = n;
      for (unsigned int i = 0; i < dim * dim; ++i)
        points.l[i] = l[i].data();
      for (int i = 0; i < n_mandel; ++i)
        points.s[i] = s[i].data();
      for (unsigned int i = 0; i < 3; ++i)
        history[i] = own[i].data();
      points.history        = history.data();
      points.plastic_strain = plastic.data();
      points.work           = work.data();
      points.wave_modulus   = modulus.data();
      points.step           = 0.01;
      points.l_zz           = around_axis ? l_zz.data() : nullptr;
      return points;
    }
  };

  /** A state of one of several kinds, and an increment. */
  void
  fill(Points &a, const unsigned int p, Random &random)
  {
    const unsigned int kind = static_cast<unsigned int>(random(0., 4.));
    const double       size = kind == 3 ? 1e-4 : 0.01;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          const double spin = i == j || kind == 1 ? 0. : random(-0.3, 0.3);
          a.l[dim * i + j][p] =
            spin + (i == j || kind != 1 ? random(-size, size) : 0.);
          if (i != j)
            a.l[dim * j + i][p] = -spin;
        }
    a.l_zz[p] = random(-size, size);
    if (kind == 0 || kind == 2) // anything
      for (int i = 0; i < n_mandel; ++i)
        a.s[i][p] = random(-2e4, 2e4);
    else // two stresses or all are equal, and no axes turn; or all is well inside
      {
        const double pressure = kind == 3 ? -2e4 : random(-2e4, 1e3);
        for (unsigned int d = 0; d < dim; ++d)
          a.s[index_of_normal[d]][p] = pressure;
        if (random(0., 1.) > 0.5)
          a.s[0][p] += random(-1e3, 1e3);
        if (kind == 1 && random(0., 1.) > 0.5)
          for (unsigned int d = 1; d < dim; ++d)
            a.l[(dim + 1) * d][p] = a.l[0][p];
      }
    for (Lanes &values : a.own)
      values[p] = random(0., 1e4);
  }

  void
  compare(const std::string &name, const std::string &parameters)
  {
    dealii::ParameterAcceptor::clear();
    SpatialMohrCoulomb law("Materials/soil");
    dealii::ParameterAcceptor::declare_all_parameters();
    dealii::ParameterAcceptor::prm.parse_input_from_string(
      "subsection Materials\nsubsection soil\nset Young modulus = 1e6\n" +
      parameters + "end\nend\n");
    dealii::ParameterAcceptor::parse_all_parameters();
    law.prepare();

    Random       random;
    Largest      difference, work, plastic, own;
    unsigned int n_elastic = 0, n_edge = 0, n_apex = 0;
    for (unsigned int round = 0; round < 200; ++round)
      {
        Points a;
        for (unsigned int p = 0; p < n; ++p)
          fill(a, p, random);
        Points     b           = a;
        const bool around_axis = dim == 2 && round % 2 == 0;
        LawCounts  counts;
        law.advance(a.block(around_axis), counts);
        law.Material::advance(b.block(around_axis), counts);
        for (unsigned int p = 0; p < n; ++p)
          {
            for (int i = 0; i < n_mandel; ++i)
              difference.add(std::abs(a.s[i][p] - b.s[i][p]) / 1e4);
            for (unsigned int i = 0; i < 3; ++i)
              own.add(std::abs(a.own[i][p] - b.own[i][p]) / 1e4);
            work.add(std::abs(a.work[p] - b.work[p]) / 1e3);
            plastic.add(std::abs(a.plastic[p] - b.plastic[p]));
            n_elastic += a.plastic[p] == 0.;
            if (a.plastic[p] == 0.)
              continue;
            Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
            for (unsigned int d = 0; d < dim; ++d)
              tensor(d, d) = a.s[index_of_normal[d]][p];
            for (int i = 0; i < n_shears; ++i)
              tensor(shears[i].second, shears[i].first) =
                tensor(shears[i].first, shears[i].second) =
                  a.s[shears[i].place][p];
            if constexpr (dim == 2)
              tensor(2, 2) = law.stress_zz({{a.s[0][p], a.s[1][p], a.s[2][p]}},
                                           &a.own[0][p]);
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
              tensor, Eigen::EigenvaluesOnly);
            const Eigen::Vector3d e = eigen.eigenvalues();
            const unsigned int    n_equal =
              (e[1] - e[0] < 1e-8) + (e[2] - e[1] < 1e-8);
            n_edge += n_equal == 1;
            n_apex += n_equal == 2;
          }
      }
    std::cout << name << std::endl;
    print("  some points are elastic", n_elastic > 0);
    print("  some end in edges", n_edge > 0);
    print("  some end at the apex, where there is one",
          (n_apex > 0) == (name != "without friction"));
    print_below("  difference of stress/10 kPa", difference, "1e-12");
    print_below("  difference of the history/10 kPa", own, "1e-12");
    print_below("  difference of work/1 kPa", work, "1e-12");
    print_below("  difference of plastic strain", plastic, "1e-12");
  }

  void
  test()
  {
    const std::string c_phi = "set Cohesion = 1000\nset Friction angle = 30\n";
    compare("associated", c_phi + "set Dilatancy angle = 30\n");
    compare("dilatancy", c_phi + "set Dilatancy angle = 10\n");
    compare("sand",
            "set Friction angle = 35\nset Dilatancy angle = 0\n"
            "set Cohesion = 0\n");
    compare("without friction",
            "set Cohesion = 5000\nset Friction angle = 0\n"
            "set Dilatancy angle = 0\n");
    compare("memory",
            c_phi + "set Dilatancy angle = 0\nset Friction memory = 0.02\n");
    compare("growing cohesion",
            c_phi + "set Dilatancy angle = 10\nset Friction memory = 0.02\n"
                    "set Cohesion gradient = 100\n");
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_pyramid_step_01
