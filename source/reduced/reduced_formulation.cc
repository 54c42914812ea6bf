// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/reduced_formulation.h>
#include <geocone/reduced/reduced_newton.h>
#include <geocone/reduced/reduction.h>

namespace geocone::GEOCONE_DIM
{
  using dealii::TimerOutput;

  void
  ReducedFormulation::solve(const StepWorkspace &work) const
  {
    SolverReport        &report = work.report;
    const Reduction      reduction(work.problem);
    const ReducedProblem problem = solver == Solver::newton
                                     ? reduction.problem().projected()
                                     : reduction.problem();
    Eigen::VectorXd      s       = reduction.stress_at_start();
    ReducedNewton        newton;
    GaussSeidel          sweeps;
    newton.max_iterations = sweeps.max_sweeps = max_iterations;
    sweeps.stops_if_slow                      = true;
    work.record(work.evaluate(), 0., 0., 0.);
    // Below 1e-15 there is only rounding error.
    for (double accuracy = tolerance; accuracy > 0.9e-15; accuracy /= 10.)
      {
        newton.tolerance = sweeps.tolerance = accuracy;
        ReducedReport found;
        {
          TimerOutput::Scope scope(work.timer, "solve");
          found = solver == Solver::gauss_seidel ? sweeps.solve(problem, s)
                                                 : newton.solve(problem, s);
        }
        report.iterations += found.iterations;
        if (solver != Solver::gauss_seidel)
          report.factorisations += found.iterations;
        reduction.recover_velocity(s, work.v);
        const ResidualReport state = work.evaluate();
        work.record(state, 1., 0., 0.);
        if (!std::isfinite(state.norm))
          {
            work.report_not_a_number();
            return;
          }
        report.converged =
          work.is_balanced(state, tolerance, absolute_tolerance);
        if (report.converged)
          return;
        if (!found.converged)
          break;
      }
    report.reason =
      format("the stresses leave a residual of %.1e after %u %s",
             report.residual,
             report.iterations,
             solver == Solver::gauss_seidel ? "sweeps" : "iterations");
  }
} // namespace geocone::GEOCONE_DIM
