// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Every element must reproduce a linear field exactly on distorted cells (patch
// test), and must converge to a smooth one with order p + 1 in the displacement
// and p in the stress. The cubic triangle does so only if the nodes of edges
// that cells see reversed are in the right order.

#include "../simulate.h"
#include "../test.h"

#include <cmath>
#include <cstdio>

namespace fem_orders_01
{
  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    const std::string                        plate =
      GEOCONE_SOURCE_DIR "/prm/verification/elastic_plate.prm";

    for (const std::string element : {"P1", "P2", "P3", "Q1", "Q2", "Q3"})
      {
        const std::vector<std::string> kind = {
          "Discretisation/Element = " + element,
          std::string("Mesh/Cells = ") +
            (element[0] == 'P' ? "triangles" : "quadrilaterals")};

        // E = 2.6, nu = 0.3: lambda = 1.5, G = 1.
        std::vector<std::string> patch = kind;
        for (const char *text :
             {"Mesh/Type = unstructured",
              "Mesh/Cell size = 0.3",
              "Boundary conditions/border/Velocity x = 0.3*x-0.2*y",
              "Boundary conditions/border/Velocity y = 0.5*x+0.1*y",
              "Exact solution/Displacement x = 0.3*x-0.2*y",
              "Exact solution/Displacement y = 0.5*x+0.1*y",
              "Exact solution/Stress xx = 1.2",
              "Exact solution/Stress yy = 0.8",
              "Exact solution/Stress xy = 0.3"})
          patch.push_back(text);
        const auto errors = simulate(plate, patch)["field_errors"];
        std::printf("%s patch test exact: %s\n",
                    element.c_str(),
                    errors["displacement"].get<double>() < 1e-12 &&
                        errors["stress"].get<double>() < 1e-12
                      ? "yes"
                      : "NO");

        double previous[2] = {};
        for (const char *size : {"0.25", "0.125"})
          {
            std::vector<std::string> uniform = kind;
            uniform.push_back(std::string("Mesh/Cell size = ") + size);
            const auto   e      = simulate(plate, uniform)["field_errors"];
            const double now[2] = {e["displacement"].get<double>(),
                                   e["stress"].get<double>()};
            if (previous[0] > 0.)
              std::printf("%s orders: displacement %.3f stress %.3f\n",
                          element.c_str(),
                          std::log2(previous[0] / now[0]),
                          std::log2(previous[1] / now[1]));
            std::copy(now, now + 2, previous);
          }
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace fem_orders_01
