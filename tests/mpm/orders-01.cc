// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Orders of convergence: of the column in the cell size (exact where the space
// contains the solution and the points integrate it), and of the stress and the
// energy of a body that turns in the time step.

#include "../simulate.h"
#include "../test.h"

#include <geocone/base/log.h>

#include <cmath>
#include <cstdio>

namespace mpm_orders_01
{
  /** The order of two errors, or that both are rounding. */
  std::string
  order(const double coarse, const double fine)
  {
    return coarse < 1e-12 && fine < 1e-12
             ? "exact"
             : geocone::format("%.2f", std::log2(coarse / fine));
  }

  void
  column(const std::string &element, const std::string &layout, const int k)
  {
    double errors[2][2];
    for (int i = 0; i < 2; ++i)
      {
        const auto e = simulate(
          GEOCONE_SOURCE_DIR "/prm/column.prm",
          {"Discretisation/Element = " + element,
           "Particles/Layout = " + layout,
           "Particles/Points per direction = " + std::to_string(k),
           std::string("Mesh/Cell size = ") + (i == 0 ? "0.125" : "0.0625"),
           "Output/Expectations = "})["field_errors"];
        errors[i][0] = e["displacement"].get<double>();
        errors[i][1] = e["stress"].get<double>();
      }
    std::printf("column, %s, %s %d x %d: displacement %s, stress %s\n",
                element.c_str(),
                layout.c_str(),
                k,
                k,
                order(errors[0][0], errors[1][0]).c_str(),
                order(errors[0][1], errors[1][1]).c_str());
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

    column("Q1", "sub-cells", 1);
    column("Q1", "sub-cells", 2);
    column("Q1", "Gauss", 2);
    column("B-spline 2", "sub-cells", 2);
    column("B-spline 2", "Gauss", 2);
    column("B-spline 3", "sub-cells", 4);
    column("B-spline 3", "Gauss", 2);
    column("B-spline 3", "Gauss", 3);
    column("Q2", "Gauss", 3);
    column("Q3", "Gauss", 3);

    double stress[2], loss[2];
    for (int i = 0; i < 2; ++i)
      {
        const std::string step =
          std::string("Loading/turn/Step size = ") + (i == 0 ? "0.02" : "0.01");
        stress[i] =
          simulate(GEOCONE_SOURCE_DIR "/tests/mpm/prestress-01.prm",
                   {step, "Output/Expectations = "})["field_errors"]["stress"]
            .get<double>();
        loss[i] =
          simulate(GEOCONE_SOURCE_DIR "/prm/rotating_square.prm",
                   {step,
                    "Materials/block/Young modulus = 1e8",
                    "Output/Expectations = "})["energy"]["loss_to_initial"]
            .get<double>();
      }
    std::printf("rotation: stress %s, energy %s\n",
                order(stress[0], stress[1]).c_str(),
                order(loss[0], loss[1]).c_str());
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mpm_orders_01
