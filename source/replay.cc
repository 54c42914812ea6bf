// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/parameter_file.h>
#include <geocone/mechanics/cone_files.h>
#include <geocone/mechanics/frozen_problem.h>
#include <geocone/output/run_folder.h>
#include <geocone/replay.h>
#include <geocone/scene/geometry.h>
#include <geocone/solvers/nonsmooth_newton.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>

namespace geocone
{
  namespace
  {
    /** Where the results go. */
    class ResultFolder : public dealii::ParameterAcceptor
    {
    public:
      explicit ResultFolder(const std::string &path)
        : dealii::ParameterAcceptor("/Output")
        , path(path)
      {
        if_exists.declare(
          *this, "If folder exists", ". What to do if it is not empty.");
      }

      /** Makes it, if there is to be one. @throws InputError */
      void
      make()
      {
        if (!path.empty())
          path = make_run_folder(MPI_COMM_SELF, path, true, if_exists);
      }

      std::string path; ///< empty: nowhere

    private:
      Choice<IfExists> if_exists = if_exists_choice();
    };

    /** What read() makes of a file; also what this lacks is said with a remedy. */
    template <typename Read>
    auto
    read_with_remedy(const Read &read, const std::string &remedy)
    {
      try
        {
          return read();
        }
      catch (const RunError &error)
        {
          const std::string text = error.what();
          if (text.find("\n  remedy:") != std::string::npos)
            throw;
          throw RunError(text + "\n  remedy:  " + remedy);
        }
    }

    /** What is left of a replay: numbers to compare, and stresses (Pa). */
    struct Outcome
    {
      nlohmann::json      summary;
      std::vector<Mandel> stress;
    };

    Outcome
    replay_incremental(const std::string              &file_name,
                       const std::vector<std::string> &overrides,
                       ResultFolder                   &folder)
    {
      const FrozenProblem frozen =
        read_with_remedy([&]() { return FrozenProblem::read(file_name); },
                         "name a file that 'Output/Freeze steps' has written, "
                         "or freeze the step again");
      const ParameterFile file =
        ParameterFile::from_text(frozen.materials, file_name, overrides);
      Materials       materials(file);
      const Regions   regions(file); // stand in the same section
      NonsmoothNewton newton;
      file.parse();
      materials.prepare();
      if (!frozen.points.hoop.empty())
        materials.set_axisymmetric();
      newton.prepare();

      ThawedProblem thawed(frozen, materials);
      folder.make();
      IncrementalProblem &problem = thawed.problem();
      newton.check(problem);
      LinearSystem system(
        newton.linear_solver(), MPI_COMM_SELF, problem.is_symmetric());
      dealii::TimerOutput timer(
        std::cout, dealii::TimerOutput::never, dealii::TimerOutput::cpu_times);
      dealii::Timer clock;
      system.set_pattern(problem, timer);
      Vector             v = thawed.start(), residual = problem.make_vector();
      const SolverReport report =
        newton.solve(problem, system, timer, v, residual, {});
      const double  cpu     = clock.cpu_time();
      const Quality quality = problem.internal_forces().quality();

      Outcome outcome;
      outcome.summary = {
        {"kind", frozen.particles ? "MPM" : "FEM"},
        {"unknowns", problem.free_dofs().n_rows},
        {"points", frozen.points.n_points()},
        {"constraints", problem.free_dofs().multipliers.n_rows()},
        {"non_associativity", problem.non_associativity()},
        {"converged", report.converged},
        {"iterations", report.iterations},
        {"factorisations", report.factorisations},
        {"residual", report.residual},
        {"friction_lag", report.friction_lag},
        {"natural_map_error", quality.natural_map},
        {"cone_excess_Pa", quality.cone_excess},
        {"reason", report.reason},
        {"cpu_s", cpu}};
      outcome.stress = problem.internal_forces().trial_stress();
      return outcome;
    }

    /** Whether it is a problem file of Siconos. */
    bool
    is_text(const std::string &file_name)
    {
      return std::filesystem::path(file_name).extension() == ".dat";
    }

    Outcome
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
      NonsmoothNewton newton;
      file.parse();
      newton.prepare();
      folder.make();

      Eigen::VectorXd     s      = Eigen::VectorXd::Zero(3 * problem.n_cones());
      const ReducedReport report = newton.solve_reduced(problem, s);

      double non_associativity = 0.;
      for (const FlowCone &cone : problem.cones)
        if (cone.a > 0.)
          non_associativity =
            std::max(non_associativity, (cone.a - cone.b) / cone.a);
      Outcome outcome;
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
  } // namespace

  bool
  replay(const std::string              &file_name,
         const std::vector<std::string> &overrides,
         const std::string              &folder,
         Log                            &log)
  {
    const std::filesystem::path path(file_name);
    ResultFolder                results(folder);
    const Outcome               outcome =
      is_text(file_name) || is_fclib(file_name)
                      ? replay_reduced(file_name, overrides, results)
                      : replay_incremental(file_name, overrides, results);
    nlohmann::json summary = outcome.summary;
    summary["name"]        = path.stem().string();
    log.print(format(
      "%s: %s, %u unknowns, %u points, %u constraints: %s, %u "
      "iterations, residual %.1e, natural-map error %.1e, %.3g s "
      "of CPU%s",
      path.stem().c_str(),
      summary["kind"].get<std::string>().c_str(),
      summary["unknowns"].get<unsigned int>(),
      summary["points"].get<unsigned int>(),
      summary["constraints"].get<unsigned int>(),
      summary["converged"].get<bool>() ? "solved" : "not solved",
      summary["iterations"].get<unsigned int>(),
      summary["residual"].get<double>(),
      summary["natural_map_error"].get<double>(),
      summary["cpu_s"].get<double>(),
      summary["friction_lag"].get<double>() > 0. ? ", friction lags" : ""));
    if (!summary["converged"].get<bool>())
      log.print("  " + summary["reason"].get<std::string>());
    if (!results.path.empty())
      {
        write_file(results.path + "/summary.json",
                   [&](std::ostream &out) { out << summary.dump(2) << "\n"; });
        write_file(results.path + "/stress.csv", [&](std::ostream &out) {
          out << "xx (Pa),yy (Pa),sqrt2 xy (Pa)\n";
          for (const Mandel &s : outcome.stress)
            out << format("%.17g,%.17g,%.17g\n", s[0], s[1], s[2]);
        });
      }
    return summary["converged"].get<bool>();
  }
} // namespace geocone
