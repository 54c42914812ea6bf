// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/conditions/held_width.h>
#include <geocone/materials/retention.h>
#include <geocone/output/run_status.h>
#include <geocone/problem/bars.h>
#include <geocone/run/implicit_simulation.h>
#include <geocone/run/run_estimate.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/scene/small_motion.h>
#include <geocone/seepage/flow_on_mesh.h>

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
    /** Rejects strength from suction. @throws InputError */
    void
    refuse_suction(const Scene &scene)
    {
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        if (scene.water.seepage.acts() &&
            scene.materials.law(m).retention().adds_strength())
          throw InputError("Materials/" + scene.materials.name(m) +
                             "/Bishop parameter",
                           "chi of a suction",
                           "none in steps of FEM and MPM",
                           "suction adds strength in bounds: 'Analysis/Kind' = "
                           "strength reduction or limit load");
    }

    const UsedWhere used_implicit_simulation[] = {
      {"Time stepping/*", "Discretisation/Method", {"FEM", "MPM"}}};
  } // namespace

  namespace
  {
    /** Warns of points with inadmissible initial stress, which is redistributed
     *  abruptly in the first step. Collective. */
    std::string
    outside_strength(const MaterialPoints &points,
                     const Materials      &materials,
                     const MPI_Comm        comm)
    {
      unsigned int n = 0, first = materials.size();
      for (unsigned int p = 0; p < points.n_points(); ++p)
        if (const auto overstress = materials[points.material[p]].overstress(
              points.stress[p], points.history_of(p));
            overstress && *overstress > 1e-6 * points.stress[p].norm())
          {
            ++n;
            first = std::min(first, points.material[p]);
          }
      n     = Utilities::MPI::sum(n, comm);
      first = Utilities::MPI::min(first, comm);
      if (n == 0)
        return "";
      return format("the initial stress of %u points is outside of the "
                    "strength, e.g. of the material '",
                    n) +
             materials.name(first) +
             "': the first step jumps to another one; set 'Initial stress/K0' "
             "= "
             "automatic where it is geostatic, or change the stress or the "
             "strength";
    }

    /** Whether a material of low dilatancy has nu > 0.49. */
    bool
    is_nearly_incompressible(const Materials &materials)
    {
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (const Elasticity &elastic = materials[m].elasticity();
            materials[m].non_associativity() >
              Material::strong_non_associativity &&
            elastic.normal_stiffness() >
              50. * elastic.stiffness()(2, 2)) // 1/(1 - 2 nu)
          return true;
      return false;
    }

    /** Effect of friction with memory on the steps, for the estimate.
     *  @throws InputError if there are too many substeps */
    std::string
    text_of_memory(const Scene &scene)
    {
      const double tau = scene.materials.traits().friction_memory;
      if (!std::isfinite(tau))
        return "";
      double longest = 0.;
      for (const auto &stage : scene.loading.list)
        for (const double size : stage->step_sizes())
          longest = std::max(longest, size);
      constexpr double most = 1e4;
      for (unsigned int i = 0; i < scene.materials.size(); ++i)
        if (const double own = scene.materials[i].friction_memory();
            own > 0. && 2. * longest / own > most)
          throw InputError(
            "Materials/" + scene.materials.name(i) + "/Friction memory",
            own,
            format("0 | automatic | at least %.3g s, so that steps of %.3g s "
                   "have at most %.0f substeps",
                   2. * longest / most,
                   longest,
                   most),
            "0 is the exact law; or take a longer memory, or shorter steps");
      return format(
        "friction has a memory of %.3g s, substeps at most half of it", tau);
    }
  } // namespace

  StepControl::StepControl()
    : ParameterAcceptor("/Time stepping")
  {
    add_parameter("Maximum halvings",
                  max_halvings,
                  "Maximum number of successive halvings of a step; beyond it "
                  "the run fails.");
    add_parameter("Easy iterations",
                  easy_iterations,
                  "Number of iterations up to which the next substep is 1.5 "
                  "times as long, up to the full step.");
    add_parameter(
      "Accepted excess",
      accepted_excess,
      "Tolerance of lagged friction [-], > 0 and <= 1, with 'Friction' = "
      "automatic: plastic work due to the difference from the exact strength "
      "over the plastic work of the substep. Substeps beyond it are halved up "
      "to three times in a row, then accepted with a warning.",
      prm,
      Patterns::Double(0., 1.));
  }

  void
  StepControl::prepare()
  {
    if (max_halvings > 30)
      throw InputError("Time stepping/Maximum halvings",
                       max_halvings,
                       "0 to 30",
                       "9 is usual");
    if (!(accepted_excess > 0.))
      throw InputError("Time stepping/Accepted excess",
                       accepted_excess,
                       "above 0 to 1",
                       "0.01 is usual; for none set 'Time stepping/Friction' = "
                       "exact");
  }

  StartOfRun::StartOfRun()
    : ParameterAcceptor("/Initial stress")
  {
    add_parameter(
      "Run",
      folder,
      "FEM and MPM: folder of another run with a checkpoint ('Checkpoint/Every "
      "steps'), the same mesh and the same materials in the same order (their "
      "parameters may differ). Positions, stresses and histories of the points "
      "are those of its last checkpoint, at rest, instead of 'Type'. Boundary "
      "conditions and loads are those of this file.");
  }

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

  std::string
  ImplicitSimulation::prepare_mesh(const RunOptions &options)
  {
    std::string remark;
    Seeding   *seeding    = method.is_mpm() ? &implicit_mpm.seeding() : nullptr;
    const auto check_size = [&]() {
      const RunEstimate estimate =
        estimate_run(scene, method, mesh, seeding, run_output.fields_asked());
      log.print(options.name + ": " + estimate.text());
      estimate.check(options.force);
    };
    if (!scene.geometry.is_script())
      check_size();
    mesh.take_sizes(
      [&](const MeshParameters &parameters) {
        scene.materials.refuse_undrained(
          "Mesh/Type = from the bounds",
          "bounds are those of drained strength: take another mesh");
        scene.structures.refuse("'Mesh/Type' = from the bounds",
                                "bounds do not support them: take another mesh");
        scene.dirichlet.refuse_stages(
          "'Mesh/Type' = from the bounds",
          "bounds have no stages: take another mesh");
        auto [sizes, bracket] = sizes_of_scene(parameters, scene, comm, log);
        if (scene.loading.reduces_strength())
          bracket.name = "the factor of all loads at full strength";
        if (bracket.other_than_observed.empty())
          run_output.set_bracket(bracket);
        else
          remark = "the bounds of the mesh are not reported: " +
                   bracket.other_than_observed;
        return sizes;
      },
      scene,
      method);
    mesh.prepare(scene, method);
    if (scene.geometry.is_script())
      check_size();
    return remark;
  }

  void
  ImplicitSimulation::remember_friction()
  {
    // The exact law is easy with particles unless the soil is nearly incompressible.
    if ((!method.is_mpm() || is_nearly_incompressible(scene.materials)) &&
        !newton.wants_exact_friction() &&
        scene.materials.traits().strongly_non_associated)
      scene.materials.set_friction_memory(time_of_small_motion(
        scene, mesh.bounding_box(), [&](const BoundaryCondition &condition) {
          return mesh.faces_of(condition);
        }));
  }

  std::vector<std::string>
  ImplicitSimulation::prepare_method(const RunOptions &options)
  {
    scene.materials.check_closed_form(method.name());
    if (scene.loading.reduces_strength())
      scene.materials.reduce_strength(1.);
    for (const auto &stage : scene.loading.list)
      stage->check_implicit();
    newton.prepare();
    step_control.prepare();
    exact_solution.prepare();
    if constexpr (dim == 2)
      {
        refuse_suction(scene);
        let_water_flow(scene, comm, log, options.dry_run);
      }
    const std::string remark_on_bounds = prepare_mesh(options);
    remember_friction();
    if (const std::string text = text_of_memory(scene); !text.empty())
      log.print(options.name + ": " + text);
    space.prepare(
      mesh, method, scene.materials.traits().strongly_non_associated);
    if (method.is_mpm())
      {
        implicit_fem.refuse_consolidation();
        stepper = &implicit_mpm;
      }
    else
      stepper = &implicit_fem;
    std::vector<std::string> warnings = {
      stepper->prepare(scene, mesh, space, newton, timer, kinematics, points)};
    if (!start_of_run.folder.empty() && stepper->consolidates())
      throw InputError("Initial stress/Run",
                       start_of_run.folder,
                       "empty with 'Time stepping/Consolidation'",
                       "compute the earlier stages in the same run");
    if (!start_of_run.folder.empty() && !options.resumes)
      checkpoint.read(
        start_of_run.folder,
        log,
        [&](const Archive &archive) {
          stepper->begin_from(archive, kinematics, points);
          return std::string();
        },
        "Initial stress/Run");
    warnings.push_back(remark_on_bounds);
    warnings.push_back(scene.warn_of_time_histories());
    const BoundingBox<dim> body(scene.geometry.shape == Geometry::Shape::file
                                  ? mesh.bounding_box()
                                  : scene.geometry.bounding_box());
    log.print(options.name + ": " + text_of_magnitudes(scene, body));
    for (const auto &more : {warn_of_magnitudes(scene, body),
                             warn_of_partial_coverage(scene, mesh, space),
                             method.is_mpm() ? std::vector<std::string>()
                                             : warn_of_cut_cells(scene, mesh),
                             warn_of_fixed_ends(scene.structures, mesh)})
      warnings.insert(warnings.end(), more.begin(), more.end());
    warnings.push_back(outside_strength(points, scene.materials, comm));
    LawTraits traits = scene.materials.traits();
    // The remedies of undrained soil are refused.
    traits.undrained = traits.undrained && !stepper->consolidates();
    for (const auto &more : {space.warnings(traits, method),
                             {scene.warn_of_effective_loads()},
                             scene.materials.warnings()})
      warnings.insert(warnings.end(), more.begin(), more.end());
    warnings.erase(std::remove(warnings.begin(), warnings.end(), ""),
                   warnings.end());
    if (method.is_mpm())
      observed_points.prepare_points(scene, points, comm);
    else
      observed_points.prepare_field(scene, mesh, space);
    freezer.check(scene);
    if (stepper->consolidates() && freezer.is_used())
      throw InputError("Output/Freeze steps",
                       "steps or failures",
                       "none with 'Time stepping/Consolidation'",
                       "leave 'Output/Freeze steps' and 'Freeze failures' out");
    return warnings;
  }

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
      }
    // Velocities jump at the onset of motion: a step of a small fraction of the memory
    // time is nearly convex, and later ones grow.
    constexpr double first_part = 1. / 16.;
    substep                     = std::min(stage.step_sizes()[0],
                       first_part * scene.materials.traits().friction_memory);
  }

  Simulation::StepOutcome
  ImplicitSimulation::advance(TimePoint &now)
  {
    const Stage       &stage = stage_of(now);
    const double       h     = step_size(now);
    const unsigned int step  = now.step + 1;
    if (!is_in_step)
      {
        is_in_step   = true;
        present      = {};
        present.step = step;
        present.time = now.time + h;
        // A substep that covered the full step grows with the steps.
        if (now.in_stage > 0 && substep >= last_size * (1. - 1e-6))
          substep = h;
        substep   = std::min(substep, largest_substep(h));
        last_size = h;
      }
    try
      {
        solve_step(step, now.time, h);
      }
    catch (const StepFailure &failure)
      {
        if (!stage.until_failure)
          {
            if (scene.loading.reduces_strength() &&
                scene.loading.strength_factor(now.time) >= 1.)
              log.warn("a body that does not carry its loads has a factor of "
                       "safety below 1: let the stages begin with a 'Strength "
                       "factor' below 1, e.g. 0.5, and rise from there");
            throw;
          }
        // The curve ends at the last converged substep.
        if (done > 0.)
          {
            present.time = reached;
            TimePoint end = now;
            ++end.in_stage;
            ++end.step;
            end.time = reached;
            record(end);
          }
        run_output.set_failure(
          {stage.name, reached, reached + 2. * substep, failure.what()});
        write_fields(reached);
        return StepOutcome::run;
      }
    done       = 0.;
    is_in_step = false;
    now.time += h;
    return StepOutcome::well;
  }

  void
  ImplicitSimulation::solve_step(const unsigned int step,
                                 const double       t,
                                 const double       h)
  {
    freezer.set_step(step);
    while (done < h)
      {
        // Ends exactly at the end of the step, without a tiny last substep.
        stop_if_asked(comm);
        const double left = h - done;
        const double size = left <= substep * (1. + 1e-6) ? left : substep;
        if (scene.loading.reduces_strength())
          scene.materials.reduce_strength(
            scene.loading.strength_factor(t + done + size));
        const bool may_halve = halved_for_excess < most_halved_for_excess &&
                               size / 8. >= smallest_substep(h);
        StepReport report =
          stepper->advance(kinematics,
                           points,
                           newton,
                           freezer,
                           timer,
                           t + done,
                           size,
                           may_halve ? step_control.accepted_excess
                                     : std::numeric_limits<double>::infinity());
        run_output.add_newton_table(step, t + done + size, size, report);
        present.iterations += report.newton.iterations;
        n_factorisations += report.newton.factorisations;
        present.regularised += report.newton.regularised;
        if (!report.converged)
          {
            ++present.failures;
            halved_for_excess += report.newton.lag_error_too_large;
            cut(step, t + done, h, size, report.newton);
            continue;
          }
        if (report.newton.excess_share <= step_control.accepted_excess)
          halved_for_excess = 0;
        done    = size == left ? h : done + size;
        reached = t + done;
        scaled +=
          size * scene.loading.stage_at(reached - size / 2.).control_velocity;
        ++present.substeps;
        if (run_output.verbosity == 1 && done < h && present.substeps % 20 == 0)
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
        const double last_lag      = report.newton.friction_lag;
        const double last_share    = report.newton.excess_share;
        report.newton.friction_lag = std::max(report.newton.friction_lag,
                                              present.last.newton.friction_lag);
        present.last               = std::move(report);
        // Lagged friction is used where smaller steps have failed; its excess over the
        // strength grows with the step.
        if (present.last.newton.iterations <= step_control.easy_iterations ||
            (last_lag > 0. && 1.5 * last_share <= step_control.accepted_excess))
          substep = std::min(largest_substep(h), 1.5 * substep);
      }
  }

  double
  ImplicitSimulation::largest_substep(const double h) const
  {
    // Substeps of equal size.
    const double most = scene.materials.traits().friction_memory / 2.;
    return h <= most ? h : h / std::ceil(h / most - 1e-6);
  }

  double
  ImplicitSimulation::smallest_substep(const double h) const
  {
    return largest_substep(h) * std::pow(0.5, step_control.max_halvings);
  }

  void
  ImplicitSimulation::cut(const unsigned int  step,
                          const double        t,
                          const double        h,
                          const double        size,
                          const SolverReport &report)
  {
    // The first step starts from rest and needs a far smaller size.
    substep = step == 1 && done == 0. ? size / 8. : size / 2.;
    if (run_output.verbosity >= 2)
      log.print("    cut: " + report.reason);
    else if (run_output.verbosity == 1)
      log.progress(format("step %u  t = %.4g s  cut to %.3g s, %u "
                          "iterations so far",
                          step,
                          t,
                          substep,
                          present.iterations));
    if (substep >= smallest_substep(h) * (1. - 1e-6))
      return;
    const std::string jump =
      step == 1 ? outside_strength(points, scene.materials, comm) : "";
    throw StepFailure(
      format("the step %u failed at t = %.6g s, also when cut to "
             "%.3g s ('Time stepping/Maximum halvings' = %u):\n  ",
             step,
             t,
             size,
             step_control.max_halvings) +
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
  }

  void
  ImplicitSimulation::state(StateRow &row)
  {
    row(substep,
        last_size,
        done,
        halved_for_excess,
        is_in_step,
        present,
        reached,
        scaled,
        kinematics.supports);
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
      }
    return json;
  }
} // namespace geocone::GEOCONE_DIM
