// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The cost of an explicit step of the subloading law per point: blocks of points
// on different paths, strain increments of 1e-5, cycles of shear with some
// compression and spin. Prints nanoseconds per point-step for some sets of
// features, the best of several runs.

#include <geocone/laws/material_library.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace geocone;

void
measure(const std::string &name, const std::string &parameters)
{
  dealii::ParameterAcceptor::clear();
  const auto law = make_material("subloading", "Materials/soil");
  dealii::ParameterAcceptor::prm.parse_input_from_string(
    "subsection Materials\nsubsection soil\n" + parameters + "end\nend\n");
  dealii::ParameterAcceptor::parse_all_parameters();
  law->prepare();

  constexpr unsigned int n = PointBlock::capacity, n_steps = 2000;
  const unsigned int     m    = law->n_history();
  double                 best = 1e300;
  LawCounts              counts;
  for (unsigned int run = 0; run < 10; ++run)
    {
      counts = {};
      std::vector<double> s_xx(n, -60e3), s_yy(n, -100e3), s_xy(n, 0.), work(n),
        modulus(n), plastic(n, 0.), l_xx(n), l_xy(n), l_yx(n), l_yy(n);
      std::vector<std::vector<double>> history(m, std::vector<double>(n));
      std::vector<double *>            arrays;
      for (auto &array : history)
        arrays.push_back(array.data());
      std::vector<double> one(m);
      law->initialise({{-60e3, -100e3, -60e3, 0.}}, 0., one.data());
      for (unsigned int k = 0; k < m; ++k)
        history[k].assign(n, one[k]);
      PointBlock block;
      block.n_points = n;
      block.l        = {{l_xx.data(), l_xy.data(), l_yx.data(), l_yy.data()}};
      block.s        = {{s_xx.data(), s_yy.data(), s_xy.data()}};
      block.history  = arrays.data();
      block.plastic_strain = plastic.data();
      block.work           = work.data();
      block.wave_modulus   = modulus.data();

      double seconds = 0.;
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          for (unsigned int i = 0; i < n; ++i)
            {
              const double phase = 2. * std::acos(-1.) *
                                   (step / 1000. + i / static_cast<double>(n));
              const double sign = std::cos(phase) > 0. ? 1. : -1.;
              l_xy[i]           = sign * 2e-5;
              l_yx[i]           = 0.;
              l_xx[i]           = 2e-6 * std::sin(phase);
              l_yy[i]           = -3e-6;
            }
          const auto begin = std::chrono::steady_clock::now();
          law->advance(block, counts);
          seconds += std::chrono::duration<double>(
                       std::chrono::steady_clock::now() - begin)
                       .count();
        }
      best = std::min(best, seconds);
    }
  std::cout << name << ": " << 1e9 * best / (n * n_steps)
            << " ns per point-step, "
            << static_cast<double>(counts.substeps) / counts.updates
            << " substeps on average, " << counts.most << " at most, "
            << counts.forced << " forced" << std::endl;
}

int
main()
{
  const std::string state = "set Initial size pcb = 260e3\n"
                            "set Initial centre ratio chi = 0.5\n"
                            "set Elastic cohesion pe = 2000\n";
  measure("all features",
          state +
            "set Apex ratio xi = 0.02\nset Yield slope M = 0.8\n"
            "set Strength ratio k = 0.714\nset Potential ratio alpha = 0.9\n"
            "set Subloading rate cR = 60\n"
            "set Rotational hardening rate cbeta = 20\n"
            "set Structure loss rate cb = 15\n"
            "set Similarity centre rate ca = 30\n"
            "set Initial structure ratio = 2\n"
            "set Initial anisotropy = -0.1, 0.2, -0.1, 0\n");
  measure("without anisotropy",
          state + "set Subloading rate cR = 60\n"
                  "set Structure loss rate cb = 15\n"
                  "set Similarity centre rate ca = 30\n"
                  "set Initial structure ratio = 2\n");
  measure("Modified Cam Clay with a subloading surface",
          state + "set Subloading rate cR = 60\n");
  // R <= Rmin throughout.
  measure("elastic",
          "set Initial size pcb = 1e9\nset Elastic cohesion pe = 2000\n");
}
