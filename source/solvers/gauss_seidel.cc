// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/stop_request.h>
#include <geocone/solvers/gauss_seidel.h>
#include <geocone/solvers/one_cone.h>

#include <ctime>

namespace geocone
{
  using Eigen::VectorXd;

  ReducedReport
  GaussSeidel::solve(const ReducedProblem &problem, VectorXd &s) const
  {
    const std::clock_t        start = std::clock();
    const unsigned int        n     = problem.n_cones();
    std::vector<MandelMatrix> blocks(n);
    for (unsigned int p = 0; p < n; ++p)
      blocks[p] = problem.diagonal_block(p);
    const bool                  constrained = problem.n_multipliers() > 0;
    VectorXd                    lambda      = problem.multipliers(s);
    Eigen::LLT<Eigen::MatrixXd> factors;
    if (constrained)
      factors.compute(problem.L);

    ReducedReport report;
    report.errors.push_back(problem.natural_map_error(s));
    while (!(report.errors.back() <= tolerance) &&
           report.iterations < max_sweeps)
      {
        if (const int signal = stop_request_of_rank())
          throw Stopped(signal); // one process holds the whole problem
        ++report.iterations;
        double error = 0., size = 0.;
        for (unsigned int p = 0; p < n; ++p)
          {
            const FlowCone     &cone = problem.cones[p];
            const MandelMatrix &W    = blocks[p];
            const Mandel        old  = s.segment<n_mandel>(n_mandel * p);
            Mandel              z = problem.q.segment<n_mandel>(n_mandel * p);
            for (int i = 0; i < n_mandel; ++i)
              z[i] += problem.W.row(n_mandel * p + i).dot(s);
            if (constrained)
              z -= problem.C.middleRows<n_mandel>(n_mandel * p) * lambda;
            error =
              std::max(error, natural_map_norm(cone, old, z, natural_scale(W)));

            Mandel s_p = old;
            if constexpr (dim == 2) // ReducedProblem's cones are of the plane
              s_p = solve_one_cone(cone, W, z - W * old, old);
            s.segment<n_mandel>(n_mandel * p) = s_p;
            size = std::max(size, s_p.norm() + cone.k);
          }
        if (constrained)
          lambda = factors.solve(problem.C.transpose() * s - problem.d);
        report.errors.push_back(error > 0. ? error / size : 0.);
        if (!s.allFinite()) // which no further sweep mends
          {
            report.errors.back() = std::nan("");
            break;
          }
        if (report.errors.back() <= tolerance ||
            report.iterations == max_sweeps)
          report.errors.back() = problem.natural_map_error(s);
      }
    report.error       = report.errors.back();
    report.converged   = report.error <= tolerance;
    report.cpu_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    return report;
  }
} // namespace geocone
