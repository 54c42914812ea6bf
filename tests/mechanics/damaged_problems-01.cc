// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Problems in files, frozen ones and those of Siconos, that are damaged: by bytes,
// and by values that no step has. Each must be read or refused. What is refused by
// value is refused by its name.

#include <geocone/base/version.h>
#include <geocone/lab/cone_files.h>
#include <geocone/problem/frozen_problem.h>
#include "../damage.h"
#include "../test.h"

#include <deal.II/base/mpi.h>

#include <cmath>

namespace mechanics_damaged_problems_01
{
  using namespace geocone;

  const std::string folder = GEOCONE_SOURCE_DIR "/tests/frozen/";

  /** Writes a frozen problem in which something is wrong, and reads it. */
  void
  refuse(const std::string                          &what,
         const std::function<void(FrozenProblem &)> &spoil)
  {
    FrozenProblem frozen =
      FrozenProblem::read(folder + "mpm_segments_assoc_cold.h5");
    spoil(frozen);
    frozen.write("spoilt.h5");
    std::string answer = "read";
    try
      {
        FrozenProblem::read("spoilt.h5");
      }
    catch (const RunError &error)
      {
        answer = error.what();
        answer = answer.substr(0, answer.find('\n'));
      }
    std::cout << "  " << what << ": " << answer << std::endl;
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    for (const std::string name :
         {"mpm_q1_assoc_step3.h5", "fem_q1_half_step3.h5"})
      damage::check(name, folder + name, "damaged.h5", 300, []() {
        FrozenProblem::read("damaged.h5");
      });
    damage::check("dense problem of Siconos",
                  folder + "plasticity_2d_footing_10.dat",
                  "damaged.dat",
                  300,
                  []() { read_siconos("damaged.dat"); });
    std::ofstream("sparse.dat")
      << "3\n1\n1\n2\n3\n3\n2\nCSparse Version 4.4.1\n"
         "3-by-3, nzmax: 3 nnz: 3, 1-norm: 2\n"
         "    col 0 : locations 0 to 0\n      0 : 2\n"
         "    col 1 : locations 1 to 1\n      1 : 2\n"
         "    col 2 : locations 2 to 2\n      2 : 2\n-1 3 4\n0.5\n0.125\n";
    damage::check(
      "sparse problem of Siconos", "sparse.dat", "damaged.dat", 500, []() {
        read_siconos("damaged.dat");
      });

    std::cout << "by value" << std::endl;
    const double nan = std::nan(""), inf = HUGE_VAL;
    refuse("nothing", [](FrozenProblem &) {});
    for (const std::string text :
         {"end\nend",
          "subsection Materials\nend\nend",
          "subsection Materials\nset Names = soil",
          "subsection Materials\nend\nsubsection Output\nset Folder = x\nend",
          "include /dev/zero",
          "subsection Materials\nset Names = a/b\nend",
          "subsection Materials\nsubsection a/b\nend\nend"})
      refuse("materials", [&](FrozenProblem &f) { f.materials = text; });
    refuse("h", [&](FrozenProblem &f) { f.h = nan; });
    refuse("consistent part", [](FrozenProblem &f) { f.consistent_part = 2.; });
    refuse("functions of a consistent mass", [](FrozenProblem &f) {
      f.consistent_part = 1.;
      f.points.values.clear();
    });
    refuse("n_nodes", [](FrozenProblem &f) { f.points.n_nodes = 1 << 30; });
    refuse("first_point",
           [](FrozenProblem &f) { f.points.first_point[1] = 0; });
    refuse("a node", [](FrozenProblem &f) { f.points.nodes[0] = 0x7fffffff; });
    refuse("a gradient",
           [&](FrozenProblem &f) { f.points.gradients[3] = inf; });
    refuse("a function", [&](FrozenProblem &f) { f.points.values[3] = nan; });
    refuse("a weight", [](FrozenProblem &f) { f.points.weight[0] = 0.; });
    refuse("mass of a point", [](FrozenProblem &f) { f.points.mass[0] = -1.; });
    refuse("masses of points",
           [](FrozenProblem &f) { f.points.mass.pop_back(); });
    refuse("a stress", [](FrozenProblem &f) { f.points.stress[0][1] = 1e300; });
    refuse("a place", [&](FrozenProblem &f) { f.points.position[0][1] = nan; });
    refuse("a kind", [](FrozenProblem &f) { f.kind[0] = 7; });
    refuse("a mass", [&](FrozenProblem &f) { f.mass[0] = nan; });
    refuse("a negative mass", [](FrozenProblem &f) { f.mass[0] = -1.; });
    refuse("a velocity", [&](FrozenProblem &f) { f.velocity_L[5] = nan; });
    refuse("a start", [](FrozenProblem &f) { f.start.pop_back(); });
    refuse("a target", [&](FrozenProblem &f) { f.q[0] = nan; });
    refuse("a constrained dof", [](FrozenProblem &f) {
      f.constrained_dofs[1] = f.constrained_dofs[0];
    });
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_damaged_problems_01
