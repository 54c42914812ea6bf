// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// All formulations and first iterates must lead to the same steps, to rounding:
// the load, the elastic energy and the dissipation of each, for FEM (supports on
// nodes), for MPM with multipliers, and with B-bar, for associated flow and with
// half as much dilatancy. Each must get there by a way of its own: if a name
// stood for the return map after all, its Newton table would be the same. What
// only the first step can tell must be refused there.

#include <geocone/base/exceptions.h>

#include "../simulate.h"
#include "../test.h"

#include <cstdio>
#include <iterator>
#include <sstream>

namespace solvers_formulations_01
{
  using Strings = std::vector<std::string>;

  /** Steps of a run: load, elastic energy, dissipation; and its Newton table. */
  struct Steps
  {
    std::vector<std::vector<double>> rows;
    std::string                      table;
  };

  Steps
  run(const std::string &file, Strings options, const Strings &more)
  {
    options.insert(options.end(), more.begin(), more.end());
    simulate(GEOCONE_SOURCE_DIR "/tests/" + file, options);
    const auto fields = [](const std::string &line) {
      Strings            all;
      std::istringstream parts(line);
      for (std::string part; std::getline(parts, part, ',');)
        all.push_back(part);
      return all;
    };
    Steps         steps;
    std::ifstream in("results/statistics.csv");
    std::string   line;
    std::getline(in, line);
    const Strings names = fields(line);
    while (std::getline(in, line))
      {
        const Strings       values = fields(line);
        std::vector<double> row;
        for (std::size_t i = 0; i < names.size(); ++i)
          if (names[i].find("load") != std::string::npos ||
              names[i].find("elastic energy") != std::string::npos ||
              names[i].find("plastic dissipation") != std::string::npos)
            row.push_back(std::stod(values[i]));
        steps.rows.push_back(row);
      }
    std::ifstream table("results/newton.csv");
    steps.table.assign(std::istreambuf_iterator<char>(table), {});
    return steps;
  }

  /** Largest difference of a quantity, relative to its largest value. */
  double
  difference(const Steps &a, const Steps &b)
  {
    if (a.rows.size() != b.rows.size())
      return 1.;
    double worst = 0.;
    for (int k = 0; k < 3; ++k)
      {
        double largest = 0., size = 0.;
        for (std::size_t i = 0; i < a.rows.size(); ++i)
          {
            largest = std::max(largest, std::abs(a.rows[i][k] - b.rows[i][k]));
            size    = std::max(size, std::abs(a.rows[i][k]));
          }
        worst = std::max(worst, largest / size);
      }
    return worst;
  }

  void
  compare(const std::string &name,
          const std::string &file,
          const Strings     &scene,
          const Strings     &dilatancies     = {"25", "12.5"},
          const bool         return_map_only = false)
  {
    const std::string formulation = "Newton/Formulation = ",
                      first       = "Newton/First iterate = ";
    for (const std::string &dilatancy : dilatancies)
      {
        Strings options = scene;
        options.push_back(std::string("Materials/soil/Dilatancy angle = ") +
                          dilatancy);
        const Steps reference = run(file, options, {});
        std::printf(
          "%s, theta = %s: %zu steps, plastic: %d\n",
          name.c_str(),
          dilatancy.c_str(),
          reference.rows.size(),
          int(reference.rows.back()[2] > 0.01 * reference.rows.back()[1]));
        for (const Strings &other :
             {Strings{formulation + "natural map"},
              Strings{formulation + "natural map", "Newton/Rho = 0.01"},
              Strings{formulation + "reduced"},
              Strings{formulation + "reduced with multipliers"},
              Strings{formulation + "Gauss-Seidel"},
              Strings{first + "fixed point"},
              Strings{first + "Gauss-Seidel"},
              Strings{formulation + "natural map", first + "fixed point"},
              Strings{formulation + "natural map", first + "Gauss-Seidel"}})
          {
            if (return_map_only && other[0] != first + "fixed point")
              continue;
            const Steps steps = run(file, options, other);
            const bool  same  = difference(reference, steps) < 1e-9;
            std::printf(
              "  %s: same steps: %s, by another way: %s\n",
              (other[0] + (other.size() > 1 ? ", " + other[1] : "")).c_str(),
              same ? "yes" : "NO",
              steps.table != reference.table ? "yes" : "NO");
          }
      }
  }

  void
  refuse(const std::string &file, const Strings &scene, const Strings &more)
  {
    try
      {
        run(file, scene, more);
        std::printf("accepted\n");
      }
    catch (const geocone::InputError &error)
      {
        std::printf("%s\n", error.what());
      }
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

    const Strings fem = {"Time stepping/Inertia = true",
                         "Geometry/Box = 0, -1; 1, 0",
                         "Mesh/Cell size = 0.25",
                         "Loading/push/Duration = 0.02",
                         "Loading/push/Step size = 0.004",
                         "Boundary conditions/footing/Velocity y = -0.2"};
    const Strings mpm = {"Material point method/Ghost stiffness = 0",
                         "Geometry/Box = -0.5, -0.4; 0.5, 0",
                         "Mesh/Box = -0.5, -0.4; 0.5, 0.2",
                         "Loading/push/Duration = 0.02",
                         "Loading/push/First step size = 0.004",
                         "Loading/push/Step size = 0.004",
                         "Boundary conditions/footing/Velocity y = -0.2"};
    Strings       q1  = mpm;
    q1.push_back("Discretisation/Element = Q1");
    q1.push_back("Discretisation/B-bar = true");
    compare("FEM", "footing_coarse.prm", fem);
    compare("MPM with multipliers", "mpm/footing_coarse.prm", mpm);
    compare("MPM with one pressure per cell",
            "mpm/footing_coarse.prm",
            q1,
            {"25", "12.5"},
            true);
    // Without dilatancy B-bar is one of strains, which all formulations take. Automatic
    // is the natural map there.
    Strings isochoric = q1;
    isochoric.push_back("Newton/Formulation = return map");
    compare("MPM with B-bar", "mpm/footing_coarse.prm", isochoric, {"0"});

    const Strings reduced = {"Newton/Formulation = reduced"};
    for (const Strings &other :
         {reduced,
          Strings{"Newton/Formulation = natural map"},
          Strings{"Newton/First iterate = Gauss-Seidel"}})
      refuse("mpm/footing_coarse.prm", q1, other);
    refuse(
      "footing_coarse.prm", fem, {reduced[0], "Time stepping/Inertia = false"});
    refuse("footing_coarse.prm",
           fem,
           {reduced[0],
            "Observation/Reference = none",
            "Materials/Names = rock",
            "Materials/rock/Type = linear elastic"});
    refuse("mpm/footing_coarse.prm",
           mpm,
           {"Newton/First iterate = Gauss-Seidel",
            "Material point method/Consistent mass part = 0.5"});
    refuse("mpm/footing_coarse.prm",
           mpm,
           {reduced[0], "Material point method/Ghost stiffness = 1e-5"});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_formulations_01
