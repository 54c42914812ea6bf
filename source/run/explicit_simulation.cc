// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/base/resources.h>
#include <geocone/folder/run_status.h>
#include <geocone/run/explicit_simulation.h>
#include <geocone/run/run_estimate.h>
#include <geocone/scene/magnitudes.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  ExplicitSimulation::ExplicitSimulation(const MPI_Comm       comm,
                                         const ParameterFile &file,
                                         Log                 &log)
    : SceneSimulation(comm, file, log)
    , stepper(comm, file)
    , explicit_output(comm, log)
  {}

  std::vector<std::string>
  ExplicitSimulation::prepare_method(const RunOptions &options)
  {
    const RunEstimate estimate = estimate_run(scene,
                                              method,
                                              stepper.background_mesh(),
                                              &stepper.seeds(),
                                              explicit_output.fields_asked());
    log.print(options.name + ": " + estimate.text());
    estimate.check(options.force);
    for (const auto &stage : scene.loading.list)
      stage->check_explicit();
    std::vector<std::string> remarks = stepper.prepare(scene, method);
    if (const std::string warning = scene.warn_of_time_histories();
        !warning.empty())
      remarks.push_back(warning);
    const BoundingBox<dim> body(scene.geometry.bounding_box());
    log.print(options.name + ": " + text_of_magnitudes(scene, body));
    const std::vector<std::string> absurd = warn_of_magnitudes(scene, body);
    remarks.insert(remarks.end(), absurd.begin(), absurd.end());
    observed_points.prepare_points(scene, stepper.points().groups(), comm);
    return remarks;
  }

  void
  ExplicitSimulation::prepare_output(const RunOptions &options)
  {
    explicit_output.prepare(options, scene, stepper.points().pore_water());
    state = stepper.points().state();
    explicit_output.set_initial(state);
  }

  std::string
  ExplicitSimulation::headline(const std::string &name) const
  {
    return format("%s: explicit MPM (%s), %s, %lu nodes, %lu points, %s, %u "
                  "rank%s",
                  name.c_str(),
                  stepper.order_name().c_str(),
                  stepper.element().c_str(),
                  stepper.points().grid().n_all_nodes(),
                  state.n_points,
                  stepper.points().grid().description().c_str(),
                  Utilities::MPI::n_mpi_processes(comm),
                  Utilities::MPI::n_mpi_processes(comm) > 1 ? "s" : "");
  }

  Json
  ExplicitSimulation::model()
  {
    BackgroundMesh &mesh  = stepper.background_mesh();
    const auto      lines = mesh.uniform_lines(scene, method);
    return model_of(scene,
                    lines[0].empty() ? model_mesh_of(mesh, scene, true)
                                     : model_mesh_of(lines, scene));
  }

  void
  ExplicitSimulation::begin(const TimePoint &now)
  {
    const Stage &stage = stage_of(now);
    for (const std::string &remark : stepper.begin_stage(stage, now.time))
      log.print("stage " + stage.name + ": " + remark);
  }

  Simulation::StepOutcome
  ExplicitSimulation::advance(TimePoint &now)
  {
    const double h = step_size(now);
    report         = stepper.advance(stage_of(now), now.time, h);
    now.time += h;
    return StepOutcome::well;
  }

  void
  ExplicitSimulation::record(const TimePoint &now)
  {
    state           = stepper.points().state();
    state.reactions = std::move(report.reactions);
    std::vector<double> pressures;
    if (stepper.points().pore_water().acts())
      pressures = observed_points.pressures(
        stepper.points().groups(),
        [&](const PointArrays &group, const unsigned int p) {
          return stepper.points().pore_water().excess_pressure(group, p);
        });
    explicit_output.add_step(
      {{now.step,
        now.time,
        state,
        observed_points.displacements(stepper.points().groups())},
       step_loop.last_cpu_time(),
       report,
       stepper.exchange(),
       pressures,
       stepper.moved_obstacles()});
  }

  std::string
  ExplicitSimulation::progress(const TimePoint &now) const
  {
    return format(
             "t = %.4g s  %lu explicit steps  ", now.time, stepper.n_steps) +
           explicit_output.text_of_motion(state);
  }

  void
  ExplicitSimulation::end(const TimePoint &now)
  {
    stepper.check_equilibrium(stage_of(now), state, report);
  }

  void
  ExplicitSimulation::write_fields(const double t)
  {
    explicit_output.write_points(t, stepper.points().groups());
    explicit_output.write_obstacles(t, stepper.moved_obstacles());
  }

  Json
  ExplicitSimulation::topics()
  {
    Json json    = explicit_output.results(stepper.points().law_counts());
    json["size"] = {
      {"method", method.name()},
      {"element", stepper.element()},
      {"cells", stepper.points().grid().n_cells()},
      {"nodes", stepper.points().grid().n_all_nodes()},
      {"points", state.n_points},
      {"ranks", Utilities::MPI::n_mpi_processes(comm)},
      {"imbalance", imbalance(stepper.points().n_of_rank(), comm)},
      {"repartitions", stepper.points().grid().n_repartitions()}};
    json["cost"] = cost();
    return json;
  }

  void
  ExplicitSimulation::save(Archive &archive)
  {
    stepper.save(archive);
  }

  void
  ExplicitSimulation::load(const Archive &archive)
  {
    stepper.load(archive);
    state = stepper.points().state();
  }

  Json
  ExplicitSimulation::cost() const
  {
    const auto  &seconds = stepper.seconds();
    const double updates =
      Utilities::MPI::sum(stepper.points().n_point_steps(), comm);
    const double cpu = Utilities::MPI::sum(step_loop.cpu_time(), comm);
    const double bytes =
      Utilities::MPI::sum(double(stepper.points().memory()), comm);
    return {{"total_s", total.wall_time()},
            {"cpu_s", Utilities::MPI::sum(cpu_time_of_rank(), comm)},
            {"step_loop_s", step_loop.wall_time()},
            {"step_loop_cpu_s", cpu},
            {"passes_s", seconds.passes},
            {"grid_s", seconds.grid},
            {"exchange_s", seconds.exchange},
            {"refresh_s", seconds.refresh},
            {"output_s", output_time.wall_time()},
            {"point_steps", updates},
            {"cpu_ns_per_point_step", updates > 0. ? 1e9 * cpu / updates : 0.},
            {"bytes_per_point", bytes / std::max<double>(state.n_points, 1.)}};
  }
} // namespace geocone::GEOCONE_DIM
