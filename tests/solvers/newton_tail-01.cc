// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Near the solution the Newton iteration must be quadratic: r_{k+1} <= C r_k^2
// with the same constant for all steps, for associated and non-associated flow.
// A wrong tangent would make it linear.

#include "../simulate.h"
#include "../test.h"

#include <cstdio>
#include <sstream>

namespace solvers_newton_tail_01
{
  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    for (const char *dilatancy : {"25", "12.5"})
      {
        simulate(
          GEOCONE_SOURCE_DIR "/tests/footing_coarse.prm",
          {std::string("Materials/soil/Dilatancy angle = ") + dilatancy});
        std::ifstream in("results/newton.csv");
        std::string   line;
        std::getline(in, line);
        int    n_checked = 0, n_quadratic = 0, last_step = 0;
        double last = 1.;
        while (std::getline(in, line))
          {
            std::vector<double> v;
            std::istringstream  parts(line);
            for (std::string part; std::getline(parts, part, ',');)
              v.push_back(std::stod(part));
            const int    step     = v[0];
            const double residual = v[5];
            // Where no point switches the active set has been found; rounding
            // ends it.
            if (step == last_step && v[11] == 0. && last < 1e-3 && last > 1e-9)
              {
                ++n_checked;
                n_quadratic += residual <= 1e3 * last * last + 1e-13;
              }
            last      = residual;
            last_step = step;
          }
        std::printf(
          "theta = %s: at least 6 pairs checked: %s, all quadratic: %s\n",
          dilatancy,
          n_checked >= 6 ? "yes" : "NO",
          n_quadratic == n_checked ? "yes" : "NO");
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_newton_tail_01
