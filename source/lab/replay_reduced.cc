// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/parameter_file.h>
#include <geocone/lab/cone_files.h>
#include <geocone/lab/replay.h>
#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/reduced_newton.h>
#include <geocone/reduced/stress_methods.h>

#include <algorithm>
#include <filesystem>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Whether a file is a problem file of Siconos. */
    bool
    is_text(const std::string &file_name)
    {
      return std::filesystem::path(file_name).extension() == ".dat";
    }

    /**
     * Solves a given reduced problem: by Gauss-Seidel if @p newton requests that
     * formulation, otherwise by Newton's method with the natural map if requested, else
     * with the return map.
     * @param[in,out] s stresses in cone axes (Pa)
     */
    ReducedReport
    solve_reduced(const NonsmoothNewton &newton,
                  const ReducedProblem  &problem,
                  Eigen::VectorXd       &s)
    {
      const StepLimits limits = newton.limits();
      if (newton.formulation_name() == gauss_seidel)
        {
          GaussSeidel solver;
          solver.tolerance = limits.relative_tolerance;
          if (limits.max_iterations > 0)
            solver.max_sweeps = limits.max_iterations;
          return solver.solve(problem, s);
        }
      ReducedNewton solver;
      solver.tolerance = limits.relative_tolerance;
      if (limits.max_iterations > 0)
        solver.max_iterations = limits.max_iterations;
      if (newton.formulation_name() == "natural map")
        solver.map = ReducedNewton::Map::natural_map;
      return solver.solve(problem, s);
    }
  } // namespace

  bool
  is_reduced_problem(const std::string &file_name)
  {
    return is_text(file_name) || is_fclib(file_name);
  }

  ReplayResult
  replay_reduced(const std::string              &file_name,
                 const std::vector<std::string> &overrides,
                 ResultFolder                   &folder)
  {
    const ReducedProblem problem = read_with_remedy(
      [&]() {
        return is_text(file_name) ? read_siconos(file_name)
                                  : read_fclib(file_name);
      },
      "copy it again, or write it anew");
    const ParameterFile file =
      ParameterFile::from_text("", file_name, overrides);
    NonsmoothNewton newton(stress_methods());
    file.parse();
    newton.prepare();
    folder.make();

    Eigen::VectorXd     s      = Eigen::VectorXd::Zero(3 * problem.n_cones());
    const ReducedReport report = solve_reduced(newton, problem, s);

    double non_associativity = 0.;
    for (const FlowCone &cone : problem.cones)
      if (cone.a > 0.)
        non_associativity =
          std::max(non_associativity, (cone.a - cone.b) / cone.a);
    ReplayResult outcome;
    outcome.summary = {
      {"kind", "reduced"},
      {"unknowns", s.size()},
      {"points", problem.n_cones()},
      {"constraints", problem.n_multipliers()},
      {"non_associativity", non_associativity},
      {"converged", report.converged},
      {"iterations", report.iterations},
      {"factorisations", 0},
      {"residual", report.error},
      {"friction_lag", 0.},
      {"natural_map_error", problem.natural_map_error(s)},
      {"cone_excess_Pa", 0.},
      {"reason", report.converged ? "" : "it did not converge"},
      {"cpu_s", report.cpu_seconds}};
    for (unsigned int p = 0; p < problem.n_cones(); ++p)
      outcome.stress.push_back(from_cone_axes(Mandel(s.segment<3>(3 * p))));
    return outcome;
  }
} // namespace geocone::GEOCONE_DIM
