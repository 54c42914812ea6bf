// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/stop_request.h>
#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/one_cone.h>

#include <cmath>
#include <ctime>

namespace geocone::GEOCONE_DIM
{
  using Eigen::VectorXd;

  namespace
  {
    /** State z that is updated cone by cone, with its multipliers. */
    class Sweep
    {
      auto
      rows_of_C(const unsigned int p) const
      {
        return problem.C.middleRows<n_mandel>(n_mandel * p);
      }

      auto
      columns_of_response(const unsigned int p) const
      {
        return response.middleCols<n_mandel>(n_mandel * p);
      }

    public:
      Sweep(const ReducedProblem &problem, const VectorXd &s)
        : problem(problem)
        , lambda(problem.multipliers(s))
        , blocks(problem.n_cones())
      {
        if (problem.has_factors())
          of_nodes = problem.nodal(s);
        if (lambda.size() > 0)
          response = problem.L.llt().solve(problem.C.transpose());
        for (unsigned int p = 0; p < blocks.size(); ++p)
          {
            blocks[p] = problem.diagonal_block(p);
            if (lambda.size() > 0)
              blocks[p] -= rows_of_C(p) * columns_of_response(p);
          }
      }

      /** Derivative dz_p/ds_p. */
      const MandelMatrix &
      block(const unsigned int p) const
      {
        return blocks[p];
      }

      Mandel
      z(const VectorXd &s, const unsigned int p) const
      {
        Mandel result = problem.q.segment<n_mandel>(n_mandel * p);
        for (int i = 0; i < n_mandel; ++i)
          {
            const unsigned int row = n_mandel * p + i;
            result[i] +=
              problem.has_factors()
                ? problem.S[row] * s[row] + problem.G.row(row).dot(of_nodes)
                : problem.W.row(row).dot(s);
          }
        if (lambda.size() > 0)
          result -= rows_of_C(p) * lambda;
        return result;
      }

      /** Updates z for a stress increment ds of a cone. */
      void
      change(const unsigned int p, const Mandel &ds)
      {
        if (problem.has_factors())
          for (int i = 0; i < n_mandel; ++i)
            for (ReducedProblem::Matrix::InnerIterator g(problem.G,
                                                         n_mandel * p + i);
                 g;
                 ++g)
              of_nodes[g.col()] += problem.m[g.col()] * g.value() * ds[i];
        if (lambda.size() > 0)
          lambda += columns_of_response(p) * ds;
      }

    private:
      const ReducedProblem     &problem;
      VectorXd                  lambda;
      VectorXd                  of_nodes; ///< diag(m) G's
      Eigen::MatrixXd           response; ///< L^-1 C'
      std::vector<MandelMatrix> blocks;
    };

    /** Whether errors that continue to decrease as in their last half would still
     *  exceed the tolerance after max_sweeps. Evaluated after 1000, 2000, 4000...
     *  sweeps. */
    bool
    is_slow(const std::vector<double> &errors,
            const double               tolerance,
            const unsigned int         max_sweeps)
    {
      const unsigned int n = errors.size() - 1;
      if (n < 1000 || n % 1000 != 0 || (n / 1000 & (n / 1000 - 1)) != 0)
        return false;
      const double rate = std::log(errors[n] / errors[n / 2]) / (n - n / 2);
      return std::log(errors[n]) + rate * (max_sweeps - n) >
             std::log(tolerance);
    }
  } // namespace

  ReducedReport
  GaussSeidel::solve(const ReducedProblem &problem, VectorXd &s) const
  {
    const std::clock_t start = std::clock();
    Sweep              sweep(problem, s);
    ReducedReport      report;
    report.errors.push_back(problem.natural_map_error(s));
    while (!(report.errors.back() <= tolerance) &&
           report.iterations < max_sweeps)
      {
        if (const int signal = stop_request_of_rank())
          throw Stopped(signal); // one process holds the full problem
        ++report.iterations;
        double error = 0., size = 0.;
        for (unsigned int p = 0; p < problem.n_cones(); ++p)
          {
            const FlowCone     &cone = problem.cones[p];
            const MandelMatrix &W    = sweep.block(p);
            const Mandel        old  = s.segment<n_mandel>(n_mandel * p);
            const Mandel        z    = sweep.z(s, p);
            error =
              std::max(error, natural_map_norm(cone, old, z, natural_scale(W)));

            Mandel s_p = old;
            if constexpr (dim == 2) // ReducedProblem's cones are plane
              s_p = solve_one_cone(cone, W, z - W * old, old);
            s.segment<n_mandel>(n_mandel * p) = s_p;
            sweep.change(p, s_p - old);
            size = std::max(size, s_p.norm() + cone.k);
          }
        report.errors.push_back(error > 0. ? error / size : 0.);
        if (!s.allFinite()) // irreversible
          {
            report.errors.back() = std::nan("");
            break;
          }
        const bool gives_up =
          report.iterations == max_sweeps ||
          (stops_if_slow && is_slow(report.errors, tolerance, max_sweeps));
        if (gives_up || report.errors.back() <= tolerance)
          report.errors.back() = problem.natural_map_error(s);
        if (gives_up)
          break;
      }
    report.error       = report.errors.back();
    report.converged   = report.error <= tolerance;
    report.cpu_seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    return report;
  }
} // namespace geocone::GEOCONE_DIM
