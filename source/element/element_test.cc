// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/element/element_test.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_element_test[] = {
      {"Element/*", "Discretisation/Method", {"point"}}};
  } // namespace

  ElementTest::ElementTest(const MPI_Comm       comm,
                           const ParameterFile &file,
                           Log                 &log)
    : Simulation(comm, log)
    , driven(file)
    , path(file)
    , element_output(comm, log)
  {}

  std::vector<std::string>
  ElementTest::prepare(const RunOptions &options)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError("Discretisation/Method",
                       "point",
                       "FEM | MPM | explicit MPM on several ranks",
                       "call it without mpirun: there is one point only");
    if (const std::string structures = ParameterFile::value("Structures/Names");
        !structures.empty())
      throw InputError("Structures/Names",
                       structures,
                       "none with Discretisation/Method = point",
                       "leave it out: there is no body");
    changed = driven.prepare();
    element_output.add_columns(*driven.point, driven.initial_volume);
    path.prepare(*driven.point, element_output.columns());
    if (options.dry_run)
      log.print(headline(options.name));
    if (changed.empty())
      return {};
    return {changed};
  }

  std::vector<unsigned int>
  ElementTest::programme() const
  {
    std::vector<unsigned int> n;
    for (const auto &stage : path.list)
      n.push_back(stage->positions().size());
    return n;
  }

  void
  ElementTest::prepare_output(const RunOptions &options)
  {
    element_output.prepare(options);
  }

  std::string
  ElementTest::headline(const std::string &name) const
  {
    std::size_t n = 0;
    for (const auto &stage : path.list)
      n += stage->positions().size();
    return format("%s: one point of '%s', %s, %zu stages, %zu increments",
                  name.c_str(),
                  driven.materials.name(0).c_str(),
                  components_of_point(),
                  path.list.size(),
                  n);
  }

  const char *
  ElementTest::components_of_point() const
  {
    return driven.point->has(4)   ? "3D"
           : driven.point->has(2) ? "axisymmetric"
                                  : "plane strain";
  }

  void
  ElementTest::add_line(const unsigned int stage)
  {
    element_output.add_line(driven.record(stage));
    largest_p = std::max(largest_p, element_output.value_of("p (Pa)"));
  }

  void
  ElementTest::record_start()
  {
    add_line(0);
  }

  void
  ElementTest::begin(const TimePoint &now)
  {
    driven.begin(path.list[now.stage]->control(*driven.point));
  }

  Simulation::StepOutcome
  ElementTest::advance(TimePoint &now)
  {
    const ElementStage &stage = *path.list[now.stage];
    if (now.in_stage == 0 || positions.empty()) // of this stage, or resumed
      positions = stage.positions();
    driven.follow(positions[now.in_stage], stage.name);
    add_line(now.stage + 1);
    return stage.stops(element_output.last_line().data()) ? StepOutcome::stage
                                                          : StepOutcome::well;
  }

  void
  ElementTest::write_surfaces()
  {
    // The initial state is computed again, now that the axis is known.
    const unsigned int axis = driven.main_component();
    std::string        ignored;
    const auto         start = driven.initial_point(ignored);
    const auto add = [&](const unsigned int state, const ElementPoint &point) {
      element_output.add_yield_curves(
        state, point.yield_curves({point.stress(), axis, 1.1 * largest_p}));
    };
    add(0, *start);
    add(1, *driven.point);
  }

  void
  ElementTest::record(const TimePoint &)
  {
    if (element_output.verbosity >= 2)
      log.print(format("  f = %.4g, p = %.6g Pa, q = %.6g Pa",
                       driven.path.at,
                       element_output.value_of("p (Pa)"),
                       element_output.value_of("q (Pa)")));
  }

  std::string
  ElementTest::progress(const TimePoint &now) const
  {
    // Increments take microseconds.
    return now.step % 100000 == 0 ? path.list[now.stage]->name : "";
  }

  void
  ElementTest::end(const TimePoint &now)
  {
    const ElementStage &stage = *path.list[now.stage];
    element_output.end_stage(stage.name);
    if (element_output.verbosity >= 1)
      log.print(format("%s%s: p = %.6g Pa, q = %.6g Pa, eps_v = %.4g %%",
                       stage.name.c_str(),
                       driven.path.at == positions.back() ? "" : " (stopped)",
                       element_output.value_of("p (Pa)"),
                       element_output.value_of("q (Pa)"),
                       100. * element_output.value_of("eps_v (-)")));
  }

  Json
  ElementTest::topics()
  {
    Json json = {{"size", {{"method", "point"}, {"points", 1}}},
                 {"material", driven.materials.name(0)},
                 {"changed_at_start", changed},
                 {"components", components_of_point()},
                 {"axis", component_names[driven.main_component()]},
                 {"counts",
                  {{"increments", driven.path.n_increments},
                   {"halved_increments", driven.path.n_cuts},
                   {"newton_iterations", driven.path.n_iterations},
                   {"worst_residual", driven.path.worst_residual},
                   {"substeps", driven.point->counts.substeps},
                   {"most_substeps", driven.point->counts.most},
                   {"forced_substeps", driven.point->counts.forced},
                   {"limited_stresses", driven.point->counts.limited}}},
                 {"cost", {{"total_s", total.wall_time()}}}};
    element_output.add_states(json);
    return json;
  }

  void
  ElementTest::finish(const double)
  {
    write_surfaces();
    if (driven.point->counts.forced > 0)
      log.warn(format("%llu substeps were forced: their error is above the "
                      "tolerance; lower 'Smallest substep' or take more "
                      "increments",
                      driven.point->counts.forced));
    if (driven.point->counts.limited > 0)
      log.warn(format("%llu stresses were kept at 'Lowest pressure'",
                      driven.point->counts.limited));
    log.print(format("%u increments, %u halved, %llu substeps, %llu forced, "
                     "%llu limited",
                     driven.path.n_increments,
                     driven.path.n_cuts,
                     driven.point->counts.substeps,
                     driven.point->counts.forced,
                     driven.point->counts.limited));
  }

  void
  ElementTest::state(StateRow &row)
  {
    driven.state(row);
    row(largest_p);
  }
} // namespace geocone::GEOCONE_DIM
