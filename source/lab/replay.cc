// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/files.h>
#include <geocone/base/parameter_file.h>
#include <geocone/geometry/regions.h>
#include <geocone/lab/replay.h>
#include <geocone/problem/frozen_problem.h>
#include <geocone/reduced/stress_methods.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Points with an initial memory: if their law has a memory that was not frozen, it
     *  is the stress at the start of the step. */
    MaterialPoints
    remembering(const MaterialPoints &frozen, const Materials &materials)
    {
      MaterialPoints points = frozen;
      if (frozen.n_history() > 1) // such a law's memory is not the last entry
        return points;
      points.history.width = 2;
      points.history.assign(2 * points.material.size(), 0.);
      bool remembered = false;
      for (unsigned int i = 0; i < points.material.size(); ++i)
        if (points.material[i] < materials.size())
          {
            const Material &law = materials[points.material[i]];
            if (law.friction_memory() > 0. && law.n_history() == 2)
              {
                const Mandel &s = points.stress[i];
                law.initialise(
                  stress_of(extended(s, 0.)), 0., &points.history[2 * i]);
                if (frozen.n_history() == 1)
                  points.history[2 * i] = frozen.history[i];
                remembered = true;
              }
          }
      return remembered ? points : frozen;
    }

    /** Frozen problem that can be solved, on one rank. */
    struct ThawedProblem
    {
      /** @param materials as read from the frozen section */
      ThawedProblem(const FrozenProblem &frozen, const Materials &materials)
        : points(remembering(frozen.points, materials))
      {
        const unsigned int n = frozen.kind.size();
        unknowns.free_row    = frozen.kind;
        for (int &row : unknowns.free_row)
          {
            unknowns.with_mass.push_back(row != Unknowns::massless_row);
            if (row == 0)
              {
                row = unknowns.n_rows++;
                unknowns.global_row.push_back(row);
              }
          }
        unknowns.n_owned_rows = unknowns.n_rows;
        if (unknowns.n_rows == 0)
          throw RunError("the frozen problem has no unknown");
        unknowns.multipliers =
          Multipliers(std::vector<unsigned int>(frozen.constrained_dofs.begin(),
                                                frozen.constrained_dofs.end()),
                      frozen.H,
                      frozen.q);

        IndexSet all(n);
        all.add_range(0, n);
        const auto layout = std::make_shared<const Utilities::MPI::Partitioner>(
          all, MPI_COMM_SELF);
        const auto vector = [&](const std::vector<double> &values) {
          Vector v(layout);
          std::copy(values.begin(), values.end(), v.begin());
          return v;
        };
        mass  = vector(frozen.mass);
        force = vector(frozen.force);
        start = vector(frozen.start);
        for (const unsigned int m : points.material)
          {
            if (m >= materials.size())
              throw RunError(
                "the frozen problem has points of a material that its "
                "materials lack: the file is damaged\n  remedy:  "
                "freeze the step again ('Output/Freeze steps')");
            if (materials[m].has_history() &&
                materials[m].n_history() > points.n_history())
              throw RunError(
                "the frozen problem lacks the history of its points, "
                "of which the material '" +
                materials.name(m) +
                "' has one\n  remedy:  freeze the step again "
                "('Output/Freeze steps')");
          }
        std::vector<GhostStencil> ghosts;
        for (std::size_t i = 0; 3 * i < frozen.ghost_nodes.size(); ++i)
          {
            GhostStencil stencil;
            for (unsigned int j = 0; j < 3; ++j)
              {
                stencil.node[j]        = frozen.ghost_nodes[3 * i + j];
                stencil.coefficient[j] = frozen.ghost_values[4 * i + j];
              }
            stencil.stiffness = frozen.ghost_values[4 * i + 3];
            ghosts.push_back(stencil);
          }
        problem = std::make_unique<IncrementalProblem>(
          points,
          materials,
          unknowns,
          layout,
          frozen.mass.empty() ? nullptr : &mass,
          frozen.consistent_part,
          std::move(ghosts));
        problem->begin_step(frozen.h,
                            frozen.force.empty() ? nullptr : &force,
                            vector(frozen.velocity_L),
                            vector(frozen.prescribed));
      }

      const MaterialPoints                points;
      Unknowns                            unknowns;
      Vector                              mass, force;
      Vector                              start; ///< initial guess
      std::unique_ptr<IncrementalProblem> problem;
    };

    ReplayResult
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
      const Regions   regions(materials.names()); // in the same section
      NonsmoothNewton newton(stress_methods());
      file.parse();
      materials.prepare();
      if (!frozen.points.hoop.empty())
        materials.set_axisymmetric();
      newton.prepare();

      ThawedProblem thawed(frozen, materials);
      folder.make();
      IncrementalProblem &problem = *thawed.problem;
      newton.check(problem);
      LinearSystem system(
        newton.linear_solver(), MPI_COMM_SELF, problem.is_symmetric());
      TimerOutput timer(std::cout, TimerOutput::never, TimerOutput::cpu_times);
      Timer       clock;
      system.set_pattern(problem, timer);
      Vector             v = thawed.start, residual = problem.make_vector();
      const SolverReport report =
        newton.solve(problem, system, timer, v, residual, {});
      const double          cpu     = clock.cpu_time();
      const InternalForces &forces  = problem.internal_forces();
      const Quality         quality = forces.quality(forces.excess_work());

      ReplayResult outcome;
      outcome.summary = {
        {"kind", frozen.particles ? "MPM" : "FEM"},
        {"unknowns", problem.free_dofs().n_rows},
        {"points", frozen.points.n_points()},
        {"constraints", problem.free_dofs().multipliers.n_rows()},
        {"non_associativity", materials.traits().non_associativity},
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

    /** Replays any problem; reduced problems exist in the plane only. */
    template <unsigned int dimension>
    ReplayResult
    replay_problem(const std::string              &file_name,
                   const std::vector<std::string> &overrides,
                   ResultFolder                   &folder)
    {
      if constexpr (dimension == 2)
        if (is_reduced_problem(file_name))
          return replay_reduced(file_name, overrides, folder);
      return replay_incremental(file_name, overrides, folder);
    }

    /** Names of the components of a Mandel vector, as a table header. */
    std::string
    names_of_components()
    {
      std::array<std::string, n_mandel> names;
      for (unsigned int d = 0; d < dim; ++d)
        names[index_of_normal[d]] = std::string(2, coordinate[d]);
      for (int k = 0; k < n_shears; ++k)
        {
          const auto [place, a, b] = shears[k];
          names[place] = std::string("sqrt2 ") + coordinate[a] + coordinate[b];
        }
      std::string line;
      for (const std::string &name : names)
        line += (line.empty() ? "" : ",") + name + " (Pa)";
      return line + "\n";
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
    const ReplayResult          outcome =
      replay_problem<dim>(file_name, overrides, results);
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
          out << names_of_components();
          for (const Mandel &s : outcome.stress)
            for (int i = 0; i < n_mandel; ++i)
              out << format("%.17g", s[i]) << (i + 1 < n_mandel ? "," : "\n");
        });
      }
    return summary["converged"].get<bool>();
  }
} // namespace geocone::GEOCONE_DIM
