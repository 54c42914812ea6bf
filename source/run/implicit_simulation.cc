// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/resources.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/folder/run_status.h>
#include <geocone/points/initial_overstress.h>
#include <geocone/run/implicit_simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <iostream>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_implicit_simulation[] = {
      {"Time stepping/*", "Discretisation/Method", {"FEM", "MPM"}}};
  } // namespace

  ImplicitSimulation::ImplicitSimulation(const MPI_Comm       comm,
                                         const ParameterFile &file,
                                         Log                 &log,
                                         const SizesOfScene  &sizes_of_scene)
    : SceneSimulation(comm, file, log)
    , sizes_of_scene(sizes_of_scene)
    , mesh(comm)
    , implicit_mpm(file)
    , run_output(comm, log)
    , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
  {}

  void
  ImplicitSimulation::prepare_output(const RunOptions &options)
  {
    run_output.prepare(options,
                       scene,
                       stepper->has_moving_points(),
                       stepper->points_may_leave(),
                       stepper->consolidates());
    freezer.prepare(run_output.folder());
    run_output.set_initial_energy(
      stepper->state_energies(kinematics, points, 0.));
  }

  std::string
  ImplicitSimulation::headline(const std::string &name) const
  {
    return format("%s: %s, %s, %u unknowns, %u points, %s, %u rank%s, solver "
                  "%s",
                  name.c_str(),
                  method.name().c_str(),
                  space.element().c_str(),
                  stepper->n_unknowns(),
                  Utilities::MPI::sum(points.n_points(), comm),
                  stepper->has_inertia() ? "with inertia" : "quasi-static",
                  Utilities::MPI::n_mpi_processes(comm),
                  Utilities::MPI::n_mpi_processes(comm) > 1 ? "s" : "",
                  stepper->linear_solver().name().c_str());
  }

  Json
  ImplicitSimulation::model()
  {
    return model_of(scene, model_mesh_of(mesh, scene, method.is_mpm()));
  }

  void
  ImplicitSimulation::begin(const TimePoint &now)
  {
    const Stage &stage = stage_of(now);
    if (stage.reset_displacement)
      {
        stepper->reset(kinematics, points);
        scaled = 0.;
      }
    if (stage.changes_body())
      {
        const BodyChange change =
          stepper->change_body(stage, now.time, timer, kinematics, points);
        run_output.change_body(change);
        for (const std::string &remark : change.remarks)
          log.print("stage " + stage.name + ": " + remark);
        for (const std::string &warning : change.warnings)
          log.warn("stage " + stage.name + ": " + warning);
      }
    step_control.begin_stage(stage.step_sizes()[0]);
  }

  Simulation::StepOutcome
  ImplicitSimulation::advance(TimePoint &now)
  {
    const Stage       &stage = stage_of(now);
    const double       h     = step_size(now);
    const unsigned int step  = now.step + 1;
    if (step_control.begin_step(h, now.in_stage > 0))
      {
        present      = {};
        present.step = step;
        present.time = now.time + h;
      }
    try
      {
        solve_step(step, now.time);
      }
    catch (const StepFailure &failure)
      {
        if (!stage.until_failure)
          {
            if (!scene.loading.reduces_strength())
              throw;
            if (const double factor = scene.loading.strength_factor(now.time);
                factor > 1.)
              log.warn(format("no equilibrium is found beyond the strength "
                              "factor %.4f: 'Loading/%s/Until failure = true' "
                              "makes that the answer",
                              factor,
                              stage.name.c_str()));
            else if (factor == 1.)
              log.warn("a body that does not carry its loads has a factor of "
                       "safety below 1: let the stages begin with a 'Strength "
                       "factor' below 1, e.g. 0.5, and rise from there");
            throw;
          }
        // The curve ends at the last converged substep.
        if (step_control.done() > 0.)
          {
            present.time = reached;
            TimePoint end = now;
            ++end.in_stage;
            ++end.step;
            end.time = reached;
            record(end);
          }
        run_output.set_failure({stage.name,
                                reached,
                                reached + 2. * step_control.size(),
                                failure.what()});
        write_fields(reached);
        return StepOutcome::run;
      }
    step_control.end_step();
    now.time += h;
    return StepOutcome::well;
  }

  void
  ImplicitSimulation::solve_step(const unsigned int step, const double t)
  {
    freezer.set_step(step);
    while (!step_control.is_done())
      {
        stop_if_asked(comm);
        const double size = step_control.next(), done = step_control.done();
        if (scene.loading.reduces_strength())
          scene.materials.reduce_strength(
            scene.loading.strength_factor(t + done + size));
        StepReport report =
          stepper->advance(kinematics,
                           points,
                           newton,
                           freezer,
                           timer,
                           t + done,
                           size,
                           step_control.accepted_excess_of_next());
        run_output.add_newton_table(step, t + done + size, size, report);
        present.iterations += report.newton.iterations;
        n_factorisations += report.newton.factorisations;
        present.regularised += report.newton.regularised;
        if (!report.converged)
          {
            ++present.failures;
            cut(step, t + done, size, report.newton);
            continue;
          }
        step_control.accept(report.newton);
        reached = t + step_control.done();
        scaled +=
          size * scene.loading.stage_at(reached - size / 2.).control_velocity;
        ++present.substeps;
        if (run_output.verbosity == 1 && !step_control.is_done() &&
            present.substeps % 20 == 0)
          log.progress(format("step %u  t = %.4g s  %u substeps, %u iterations "
                              "so far",
                              step,
                              reached,
                              present.substeps,
                              present.iterations));
        // Works are summed over the substeps; errors are the largest of them.
        report.works += present.last.works;
        report.contact.take_worse(present.last.contact);
        report.motion.take_worse(present.last.motion);
        report.identity_error =
          std::max(report.identity_error, present.last.identity_error);
        report.quality.take_worse(present.last.quality);
        report.newton.residual =
          std::max(report.newton.residual, present.last.newton.residual);
        report.newton.at_rounding_floor |=
          present.last.newton.at_rounding_floor;
        report.newton.friction_lag = std::max(report.newton.friction_lag,
                                              present.last.newton.friction_lag);
        present.last               = std::move(report);
      }
  }

  void
  ImplicitSimulation::cut(const unsigned int  step,
                          const double        t,
                          const double        size,
                          const SolverReport &report)
  {
    const double smaller = step_control.cut(step == 1, report);
    if (run_output.verbosity >= 2)
      log.print("    cut: " + report.reason);
    else if (run_output.verbosity == 1)
      log.progress(format("step %u  t = %.4g s  cut to %.3g s, %u "
                          "iterations so far",
                          step,
                          t,
                          smaller,
                          present.iterations));
    if (!step_control.is_exhausted())
      return;
    const std::string jump =
      step == 1 ? warn_of_overstress(points, scene.materials, comm) : "";
    throw StepFailure(
      format("the step %u failed at t = %.6g s, also when cut to "
             "%.3g s ('Time stepping/Maximum halvings' = %u):\n  ",
             step,
             t,
             size,
             step_control.most_halvings()) +
      report.reason + (jump.empty() ? "" : "\n  cause:   " + jump) +
      "\n  remedy:  " +
      (report.remedy.empty()
         ? "take smaller steps, allow more halvings or iterations, or "
           "check whether the body can carry its loads"
         : report.remedy));
  }

  void
  ImplicitSimulation::record(const TimePoint &now)
  {
    const Observation &observation = scene.observation;
    present.resets = now.in_stage == 1 && stage_of(now).reset_displacement;
    present.displacements =
      observed_points.displacements(points, kinematics.displacement);
    if (scene.materials.traits().undrained)
      present.pressures = observed_points.pressures(points);
    present.scaled = scaled;
    if (observation.of_scaled_loads)
      {
        present.displacement = scaled;
        present.load = std::abs(observation.factor) * present.last.load_factor;
      }
    else if (!observation.conditions.empty())
      {
        const double       sign = observation.factor < 0. ? -1. : 1.;
        const unsigned int c    = observation.conditions[0];
        const unsigned int d    = observation.component;
        present.displacement    = sign * kinematics.supports[c][d];
        present.load = observation.factor * present.last.reactions[c].force[d];
      }
    run_output.add_step(present);
  }

  std::string
  ImplicitSimulation::progress(const TimePoint &now) const
  {
    const std::string result = !scene.observation.has_load()
                                 ? run_output.text_of_motion(present.last)
                                 : format("u = %.4g mm  load = %.1f %s",
                                          1e3 * present.displacement,
                                          present.load,
                                          scene.geometry.unit("N/m").c_str());
    return format("t = %.4g s  ", now.time) + result +
           format("  %u iterations%s",
                  present.iterations,
                  present.last.newton.friction_lag > 0. ? " (friction lags)"
                                                        : "");
  }

  void
  ImplicitSimulation::write_fields(const double t)
  {
    run_output.write_fields(
      t, mesh, space, points, kinematics, stepper->moved_obstacles());
  }

  Json
  ImplicitSimulation::topics()
  {
    Json json    = run_output.results();
    json["size"] = {
      {"method", method.name()},
      {"element", space.element()},
      {"cells", mesh.triangulation().n_global_active_cells()},
      {"dofs", stepper->n_unknowns()},
      {"points", Utilities::MPI::sum(points.n_points(), comm)},
      {"lost_points", stepper->n_lost()},
      {"nonzeros", Utilities::MPI::sum(stepper->n_nonzeros(), comm)},
      {"ranks", Utilities::MPI::n_mpi_processes(comm)},
      {"imbalance", imbalance(points.n_points(), comm)},
      {"repartitions", stepper->n_repartitions()}};
    json["cost"] = cost();
    return json;
  }

  void
  ImplicitSimulation::finish(const double t)
  {
    if (exact_solution.is_given())
      run_output.set_field_errors(
        exact_solution.errors(mesh,
                              space,
                              points,
                              kinematics.displacement,
                              stepper->has_moving_points(),
                              t));
    if (stepper->has_moving_points())
      for (const std::string &warning :
           warn_of_moved_plates(scene.structures, present.last.plates, mesh))
        log.warn(warning);
  }

  void
  ImplicitSimulation::state(StateRow &row)
  {
    SceneSimulation::state(row);
    row(step_control, present, reached, scaled, kinematics.supports);
  }

  void
  ImplicitSimulation::save(Archive &archive)
  {
    save_nodes(archive, "velocity", mesh, space, kinematics.velocity);
    if (!method.is_mpm())
      save_nodes(archive, "displacement", mesh, space, kinematics.displacement);
    stepper->save(archive, points);
  }

  void
  ImplicitSimulation::load(const Archive &archive)
  {
    load_nodes(archive, "velocity", mesh, space, kinematics.velocity);
    if (!method.is_mpm())
      load_nodes(archive, "displacement", mesh, space, kinematics.displacement);
    stepper->load(archive, points);
  }

  Json
  ImplicitSimulation::cost() const
  {
    std::map<std::string, double> seconds =
      timer.get_summary_data(TimerOutput::total_wall_time);
    const double linear = seconds["factorise"] + seconds["solve"];
    const double steps  = step_loop.wall_time();
    const double megabytes = Utilities::MPI::sum(peak_memory_of_rank(), comm);
    Json         json      = {{"total_s", total.wall_time()},
                              {"cpu_s", Utilities::MPI::sum(cpu_time_of_rank(), comm)},
                              {"step_loop_s", steps},
                              {"residual_s", seconds["residual"]},
                              {"assembly_s", seconds["assemble"]},
                              {"analyse_s", seconds["analyse"]},
                              {"factorise_s", seconds["factorise"]},
                              {"solve_s", seconds["solve"]},
                              {"commit_s", seconds["commit"]},
                              {"transfer_s", seconds["transfer"]},
                              {"output_s", output_time.wall_time()},
                              {"linear_solver", stepper->linear_solver().name()},
                              {"factorisations", n_factorisations},
                              {"ratio_to_factorise_and_solve",
                  linear > 0. ? Json(steps / linear) : Json()},
                              {"peak_memory_MB", megabytes}};
    if (const LinearIterations *counts = stepper->linear_solver().iterations())
      {
        json["linear_iterations_mean"] =
          counts->systems > 0 ? Json(counts->total / double(counts->systems))
                              : Json();
        json["linear_iterations_max"]   = counts->most;
        json["factorisations_directly"] = counts->directly;
        json["linear_solutions_above_tolerance"] = counts->stopped;
      }
    return json;
  }
} // namespace geocone::GEOCONE_DIM
