// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The footings of tests/frozen, without dilatancy as they are and with associated
// flow: what another code finds hard must be solved in a few Newton iterations
// from zero stress and in the usual number of sweeps, and both must find the same
// stress. A file that is not such a problem must be refused by name and reason.

#include <geocone/base/exceptions.h>
#include <geocone/base/version.h>
#include <geocone/lab/cone_files.h>
#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/reduced_newton.h>

#include "../cone/cone_tests.h"
#include "../test.h"

#include <fstream>
#include <sstream>

namespace solvers_siconos_01
{
  using namespace cone_tests;
  using namespace geocone;
  using Eigen::VectorXd;

  void
  solve(const ReducedProblem &problem,
        const unsigned int    max_iterations,
        const unsigned int    max_sweeps)
  {
    VectorXd   s = VectorXd::Zero(problem.q.size()), swept = s;
    const auto newton = ReducedNewton().solve(problem, s);
    const auto sweeps = GaussSeidel().solve(problem, swept);
    std::cout << "  b/a = " << problem.cones[0].b / problem.cones[0].a
              << std::endl;
    print("    Newton reaches 1e-10 without restart",
          newton.converged && problem.natural_map_error(s) <= 1e-10 &&
            newton.restarts == 0);
    print("    in at most " + std::to_string(max_iterations) + " iterations",
          newton.iterations <= max_iterations);
    print("    Gauss-Seidel reaches 1e-8",
          sweeps.converged && problem.natural_map_error(swept) <= 1e-8);
    print("    in at most " + std::to_string(max_sweeps) + " sweeps",
          sweeps.iterations <= max_sweeps);
    Largest difference;
    difference.add((swept - s).norm() / s.norm());
    print_below("    their difference", difference, "1e-5");
  }

  void
  refuse(const std::string &text)
  {
    std::ofstream("broken.dat") << text;
    try
      {
        read_siconos("broken.dat");
        std::cout << "  accepted" << std::endl;
      }
    catch (const InputError &error)
      {
        // Without the remedy that most have in common.
        const std::string text = error.what();
        std::cout << "  "
                  << text.substr(0, text.find("\n  allowed: an argument file"))
                  << std::endl;
      }
  }

  void
  test()
  {
    const std::string folder = GEOCONE_SOURCE_DIR "/tests/frozen/";
    for (const auto &[name, max_iterations, max_sweeps] :
         {std::make_tuple("plasticity_2d_footing_10.dat", 12, 300),
          std::make_tuple("plasticity_2d_footing_100.dat", 14, 2500)})
      {
        ReducedProblem problem = read_siconos(folder + name);
        std::cout << name << ": " << problem.n_cones()
                  << " cones, a = " << problem.cones[0].a << std::endl;
        solve(problem, max_iterations, max_sweeps);
        for (FlowCone &cone : problem.cones)
          cone.b = cone.a;
        solve(problem, max_iterations, max_sweeps);
      }

    std::cout << "one cone" << std::endl;
    const std::string matrix  = "3 3\t3\n 2 0 0 \n 0 2 0 \n 0 0 2 \n";
    const std::string library = "CSparse Version 4.4.1, (c) Timothy A. Davis\n";
    for (const std::string head :
         {"3\n1\n0\n3\n" + matrix,
          "3\n1\n1\n0\n3\n" + matrix,
          "3\n1\n1\n2\n3\n3\n1\n" + library +
            "triplet: 3-by-3, nzmax: 16 nnz: 4\n    0 0 : 2\n    1 1 : 1\n"
            "    2 2 : 2\n    1 1 : 1\n",
          "3\n1\n2\n3\n3\n2\n" + library +
            "3-by-3, nzmax: 4 nnz: 4, 1-norm: 2\n"
            "    col 0 : locations 0 to 0\n      0 : 2\n"
            "    col 1 : locations 1 to 2\n      1 : 2\n      2 : 0\n"
            "    col 2 : locations 3 to 3\n      2 : 2\n",
          "3\n1\n1\n2\n3\n3\n3\n" + library +
            "csr: 3-by-3, nzmax: 3 nnz: 4, 1-norm: 2\n"
            "    row 0 : locations 0 to 0\n      0 : 2\n"
            "    row 1 : locations 1 to 2\n      1 : 2\n      0 : 0\n"
            "    row 2 : locations 3 to 3\n      2 : 2\n"})
      {
        std::ofstream("whole.dat") << head << "-1 3 4\n0.5\n0.125\n";
        const ReducedProblem one = read_siconos("whole.dat");
        std::cout << "  W = " << one.W.coeff(1, 1)
                  << " I, q = " << one.q.transpose()
                  << ", a = " << one.cones[0].a << ", b = " << one.cones[0].b
                  << std::endl;
      }

    std::cout << "refused" << std::endl;
    try
      {
        read_siconos("missing.dat");
      }
    catch (const InputError &error)
      {
        std::cout << "  " << error.what() << std::endl;
      }
    const std::string good = "3 1 1 0 3 " + matrix;
    refuse("");
    refuse("2 1 1 0 2 2 2 2");
    refuse("3 1.5");
    refuse("3 1 2 0 3 3 3 3");
    refuse("3 1 1 1 3 3 3 3");
    refuse("3 1 0 3 6");
    refuse("3 1 1 0 3 3 3 3 2 0 0 0 2");
    refuse("3 1 1 0 3 3 3 3 2 0 zero 0 2 0 0 0 2");
    refuse("3 1 1 0 3 3 3 3 2 0 1e99 0 2 0 0 0 2");
    const std::string sparse =
      "3 1 1 2 3 3 1\nCSparse\ntriplet: 3-by-3, nzmax: ";
    refuse("3 1 1 2 3 3 4\nCSparse\n");
    refuse("3 1 1 2 3 3 1\ncsr:");
    refuse(sparse + "3 nnz: 1e18\n");
    refuse(sparse + "3 nnz: 9\n 0 0 : 1\n");
    refuse(sparse + "3 nnz: 1\n 3 0 : 1\n");
    refuse("3 1000000 1 0 3000000 3000000 3000000 3000000 1");
    refuse(good + "-1 3 4 0.5");
    refuse(good + "-1 3 nan 0.5 0.25");
    refuse(good + "-1 3 4 0.5 0.75");
    refuse(good + "-1 3 4 0.5 0.25 1");
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_siconos_01
