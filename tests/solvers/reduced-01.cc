// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Two solvers that share nothing but the law must find the same solution of
// random small problems, with multipliers as
// unknowns and with them eliminated (eq 75), from zero and from elsewhere: for
// associated flow there is no other (eq 63). The multipliers are checked against
// their equations, not against a solver. A long chain has a sparse Jacobian.

#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/reduced_newton.h>

#include "../test.h"
#include "reduced_problems.h"

namespace solvers_reduced_01
{
  using namespace cone_tests;
  using namespace geocone;
  using Eigen::VectorXd;

  /** Largest component of x - y, relative to the size of y and the cohesion. */
  double
  difference(const ReducedProblem &problem,
             const VectorXd       &x,
             const VectorXd       &y)
  {
    return (x - y).lpNorm<Eigen::Infinity>() /
           (y.lpNorm<Eigen::Infinity>() + problem.cones[0].k + 1e-300);
  }

  template <typename Solver>
  VectorXd
  solved(Solver                solver,
         const ReducedProblem &problem,
         const VectorXd       &start,
         unsigned int         &failed,
         unsigned int         &iterations)
  {
    VectorXd s        = start;
    solver.tolerance  = 1e-12;
    const auto report = solver.solve(problem, s);
    failed += !(report.converged && problem.natural_map_error(s) <= 1e-12);
    iterations = std::max(iterations, report.iterations);
    return s;
  }

  void
  test()
  {
    Random        random;
    GaussSeidel   sweeps;
    ReducedNewton newton, natural, paper;
    natural.map = ReducedNewton::Map::natural_map;
    paper.map   = ReducedNewton::Map::natural_map;
    paper.rho   = 1e6;
    for (const double dilatancy : {0., 0.5, 1.})
      {
        unsigned int failed = 0, n_sweeps = 0, n_iterations = 0, n_paper = 0;
        Largest      solvers, maps, multipliers, starts, constraints;
        for (const double a : {0., 0.1, 0.42, 0.8})
          for (const double k : {0., 1e3})
            for (const unsigned int n_multipliers : {0, 1, 3})
              for (unsigned int i = 0; i < 5; ++i)
                {
                  const ReducedProblem problem = reduced_problems::coupled(
                    8, n_multipliers, {a, dilatancy * a, k}, 1., random);
                  VectorXd       start = VectorXd::Zero(problem.q.size());
                  const VectorXd s =
                    solved(newton, problem, start, failed, n_iterations);
                  solvers.add(
                    difference(problem,
                               solved(sweeps, problem, start, failed, n_sweeps),
                               s));
                  maps.add(difference(
                    problem,
                    solved(natural, problem, start, failed, n_iterations),
                    s));
                  maps.add(
                    difference(problem,
                               solved(paper, problem, start, failed, n_paper),
                               s));
                  multipliers.add(difference(
                    problem,
                    solved(
                      newton, problem.projected(), start, failed, n_iterations),
                    s));
                  for (double &x : start)
                    x = random(-1e4, 1e4);
                  starts.add(difference(
                    problem,
                    solved(newton, problem, start, failed, n_iterations),
                    s));
                  if (n_multipliers == 0)
                    continue;
                  const VectorXd lambda = problem.multipliers(s);
                  constraints.add(
                    (problem.L * lambda - problem.C.transpose() * s + problem.d)
                      .norm() /
                    problem.d.norm());
                  const ReducedProblem projected = problem.projected();
                  constraints.add(
                    (projected.W * s + projected.q - problem.z(s, lambda))
                      .norm() /
                    problem.q.norm());
                }
        std::cout << "b/a = " << dilatancy << std::endl;
        print("  all solved to 1e-12", failed == 0);
        print("  at most 300 sweeps", n_sweeps <= 300);
        print("  at most 20 Newton iterations", n_iterations <= 20);
        print("  at most 20 with rho the same for all cones", n_paper <= 20);
        print_below("  Gauss-Seidel against Newton", solvers, "1e-9");
        print_below("  natural map against return map", maps, "1e-9");
        print_below("  without against with multipliers", multipliers, "1e-9");
        print_below("  from elsewhere against from zero", starts, "1e-9");
        print_below("  constraints and eq (75)", constraints, "1e-10");
      }

    // Each cone is coupled to the next one.
    const unsigned int n = 200;
    ReducedProblem     chain;
    chain.cones.assign(n, {0.42, 0.1, 1e3});
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned int i = 0; i < 3 * n; ++i)
      {
        entries.emplace_back(i, i, 3e-6);
        if (i + 3 < 3 * n)
          {
            entries.emplace_back(i, i + 3, -1e-6);
            entries.emplace_back(i + 3, i, -1e-6);
          }
      }
    chain.W.resize(3 * n, 3 * n);
    chain.W.setFromTriplets(entries.begin(), entries.end());
    chain.q.resize(3 * n);
    for (double &x : chain.q)
      x = random(-1e-2, 1e-2);
    unsigned int   failed = 0, n_sweeps = 0, n_iterations = 0;
    const VectorXd zero = VectorXd::Zero(3 * n);
    const VectorXd s    = solved(newton, chain, zero, failed, n_iterations);
    print("chain: solved to 1e-12", failed == 0);
    print("  at most 15 Newton iterations", n_iterations <= 15);
    Largest solvers;
    solvers.add(
      difference(chain, solved(sweeps, chain, zero, failed, n_sweeps), s));
    print_below("  Gauss-Seidel against Newton", solvers, "1e-9");
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_reduced_01
