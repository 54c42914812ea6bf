// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/output/run_status.h>
#include <geocone/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <iostream>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** Says if points start with a stress that their soil cannot bear: the first
     *  step then begins with a jump to another one. Collective. */
    std::string
    outside_strength(const MaterialPoints &points,
                     const Materials      &materials,
                     const MPI_Comm        comm)
    {
      unsigned int n = 0, first = materials.size();
      for (unsigned int p = 0; p < points.n_points(); ++p)
        if (const auto cone = materials[points.material[p]].flow_cone())
          if (cone->yield_function(to_cone_axes(points.stress[p])) >
              1e-6 * points.stress[p].norm())
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
             "': the first step jumps to another one; change 'Initial stress' "
             "(e.g. K0) or the strength";
    }
  } // namespace

  StepControl::StepControl()
    : ParameterAcceptor("/Time stepping")
  {
    add_parameter("Maximum halvings",
                  max_halvings,
                  "How often a step may be halved before the run gives up.");
    add_parameter(
      "Easy iterations",
      easy_iterations,
      "After a substep with at most so many iterations the next one "
      "is half as long again, up to the whole step.");
  }

  void
  StepControl::prepare()
  {
    if (max_halvings > 30)
      throw InputError("Time stepping/Maximum halvings",
                       max_halvings,
                       "0 to 30",
                       "9 is usual");
  }

  Simulation::Simulation(const MPI_Comm       comm,
                         const ParameterFile &file,
                         Log                 &log)
    : comm(comm)
    , log(log)
    , scene(file)
    , mesh(comm)
    , implicit_mpm(file)
    , run_output(comm, log)
    , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
  {}

  bool
  Simulation::prepare(const RunOptions &options,
                      Kinematics       &kinematics,
                      MaterialPoints   &points)
  {
    scene.prepare();
    method.prepare();
    scene.materials.check_closed_form(method.name);
    for (const auto &stage : scene.loading.stages)
      stage->check_implicit();
    newton.prepare();
    step_control.prepare();
    exact_solution.prepare();
    mesh.prepare(scene, method);
    space.prepare(mesh, method);
    if (method.is_mpm())
      stepper = &implicit_mpm;
    else
      stepper = &implicit_fem;
    const std::string warning =
      stepper->prepare(scene, mesh, space, newton, timer, kinematics, points);
    if (options.dry_run)
      return false;
    run_output.prepare(options.name, options.folder, scene);
    freezer.prepare(run_output.folder());
    for (const std::string &text :
         {warning, outside_strength(points, scene.materials, comm)})
      if (!text.empty())
        log.warn(text);
    return true;
  }

  StepRecord
  Simulation::advance(Kinematics        &kinematics,
                      MaterialPoints    &points,
                      const unsigned int step,
                      const double       t,
                      const double       h,
                      double            &substep)
  {
    StepRecord record;
    record.step = step;
    record.time = t + h;
    freezer.set_step(step);
    const double smallest = h * std::pow(0.5, step_control.max_halvings);
    double       done     = 0.;
    substep               = std::min(substep, h);
    while (done < h)
      {
        // Land on the end of the step exactly, without a sliver before it.
        stop_if_asked(comm);
        const double left   = h - done;
        const double size   = left <= substep * (1. + 1e-6) ? left : substep;
        StepReport   report = stepper->advance(
          kinematics, points, newton, freezer, timer, t + done, size);
        run_output.add_newton_table(step, t + done + size, size, report);
        record.iterations += report.newton.iterations;
        n_factorisations += report.newton.factorisations;
        record.regularised += report.newton.regularised;
        if (report.converged)
          {
            done    = size == left ? h : done + size;
            reached = t + done;
            ++record.substeps;
            // Works add up over the substeps, and the worst of them counts.
            report.energies.external_work += record.last.energies.external_work;
            report.energies.dissipation += record.last.energies.dissipation;
            report.identity_error =
              std::max(report.identity_error, record.last.identity_error);
            report.quality.take_worse(record.last.quality);
            report.newton.residual =
              std::max(report.newton.residual, record.last.newton.residual);
            const double last_lag      = report.newton.friction_lag;
            report.newton.friction_lag = std::max(
              report.newton.friction_lag, record.last.newton.friction_lag);
            record.last = std::move(report);
            // Friction that lags stands for what smaller steps did not solve.
            if (record.last.newton.iterations <= step_control.easy_iterations ||
                last_lag > 0.)
              substep = std::min(h, 1.5 * substep);
          }
        else
          {
            ++record.failures;
            substep = size / 2.;
            if (run_output.verbosity >= 2)
              log.print("    cut: " + report.newton.reason);
            else if (run_output.verbosity == 1)
              log.progress(format("step %u  t = %.4g s  cut to %.3g s, %u "
                                  "iterations so far",
                                  step,
                                  t + done,
                                  substep,
                                  record.iterations));
            if (substep < smallest * (1. - 1e-6))
              throw StepFailure(
                format("the step %u failed at t = %.6g s, also when cut to "
                       "%.3g s ('Time stepping/Maximum halvings' = %u):\n  ",
                       step,
                       t + done,
                       size,
                       step_control.max_halvings) +
                report.newton.reason +
                "\n  remedy:  take smaller steps, allow more halvings or "
                "iterations, or check whether the body can carry its loads");
          }
      }
    return record;
  }

  bool
  Simulation::run(const RunOptions &options)
  {
    Kinematics     kinematics;
    MaterialPoints points;
    if (!prepare(options, kinematics, points))
      return true;
    log.print(
      format("%s: %s, %s, %u unknowns, %u points, %s, %u rank%s, solver %s",
             options.name.c_str(),
             method.name.c_str(),
             space.element().c_str(),
             stepper->n_unknowns(),
             Utilities::MPI::sum(points.n_points(), comm),
             stepper->has_inertia() ? "with inertia" : "quasi-static",
             Utilities::MPI::n_mpi_processes(comm),
             Utilities::MPI::n_mpi_processes(comm) > 1 ? "s" : "",
             stepper->linear_solver_name().c_str()));
    log.print("results in " + run_output.folder());

    unsigned int n_steps = 0;
    for (const auto &stage : scene.loading.stages)
      n_steps += stage->step_sizes().size();

    const Observation &observation = scene.observation;
    const double       sign        = observation.factor < 0. ? -1. : 1.;
    double             t           = 0.;
    unsigned int       step        = 0;
    run_output.set_initial_energy(
      stepper->state_energies(kinematics, points, 0.));
    run_output.write_summary("running", size(points), cost());
    try
      {
        if (method.is_mpm())
          run_output.write_fields(0., mesh, space, points, kinematics);
        for (const auto &stage : scene.loading.stages)
          {
            if (stage->reset_displacement)
              stepper->reset(kinematics, points);
            const std::vector<double> sizes   = stage->step_sizes();
            double                    substep = sizes[0];
            for (std::size_t i = 0; i < sizes.size(); ++i)
              {
                // A substep that stood for a whole step grows with the steps.
                if (i > 0 && substep >= sizes[i - 1] * (1. - 1e-6))
                  substep = sizes[i];
                ++step;
                step_loop.start();
                StepRecord record;
                try
                  {
                    record =
                      advance(kinematics, points, step, t, sizes[i], substep);
                  }
                catch (const StepFailure &failure)
                  {
                    if (!stage->until_failure)
                      throw;
                    step_loop.stop();
                    run_output.set_failure({stage->name,
                                            reached,
                                            reached + 2. * substep,
                                            failure.what()});
                    run_output.write_fields(
                      reached, mesh, space, points, kinematics);
                    return end_run(kinematics, points, reached);
                  }
                record.resets = i == 0 && stage->reset_displacement;
                step_loop.stop();
                t += sizes[i];

                for (const unsigned int c : observation.conditions)
                  for (unsigned int d = 0; d < dim; ++d)
                    record.reactions.push_back(record.last.reactions[c][d]);
                if (!observation.conditions.empty())
                  {
                    record.displacement =
                      sign * kinematics.supports[observation.conditions[0]]
                                                [observation.component];
                    record.load = observation.factor *
                                  record.reactions[observation.component];
                  }
                run_output.add_step(record);
                if (run_output.verbosity >= 1)
                  {
                    const std::string result =
                      observation.conditions.empty()
                        ? format("kinetic energy = %.3g J/m  plastic strain <= "
                                 "%.3g",
                                 record.last.energies.kinetic,
                                 record.last.largest_plastic_strain)
                        : format("u = %.4g mm  load = %.1f N/m",
                                 1e3 * record.displacement,
                                 record.load);
                    log.progress(format(
                      "step %u/%u  t = %.4g s  %s  %u iterations%s  %.0f "
                      "s left",
                      step,
                      n_steps,
                      t,
                      result.c_str(),
                      record.iterations,
                      record.last.newton.friction_lag > 0. ? " (friction lags)"
                                                           : "",
                      total.wall_time() / step * (n_steps - step)));
                  }

                if (i + 1 == sizes.size() ||
                    (stage->output_every > 0 &&
                     (i + 1) % stage->output_every == 0))
                  {
                    TimerOutput::Scope scope(timer, "output");
                    run_output.write_fields(t, mesh, space, points, kinematics);
                    run_output.write_summary("running", size(points), cost());
                  }
                else if (run_output.summary_is_old())
                  run_output.write_summary("running", size(points), cost());
              }
          }
        return end_run(kinematics, points, t);
      }
    catch (const std::exception &error)
      {
        run_output.end_with(error, [&](const std::string &status) {
          run_output.write_summary(status, size(points), cost());
          run_output.write_fields(t, mesh, space, points, kinematics);
        });
        throw;
      }
  }

  bool
  Simulation::end_run(const Kinematics     &kinematics,
                      const MaterialPoints &points,
                      const double          t)
  {
    if (exact_solution.is_given())
      run_output.set_field_errors(
        exact_solution.errors(mesh, space, points, kinematics.displacement, t));
    run_output.write_summary("finished", size(points), cost());
    run_output.print_result();
    const Json costs = cost();
    log.print(format(
      "%.1f s in all; step loop %.2f s = %.2f x its factorisations and solves; "
      "%.0f MB at most",
      costs["total_s"].get<double>(),
      costs["step_loop_s"].get<double>(),
      costs["ratio_to_factorise_and_solve"].is_null()
        ? 0.
        : costs["ratio_to_factorise_and_solve"].get<double>(),
      costs["peak_memory_MB"].get<double>()));
    return run_output.expectations_hold();
  }

  Json
  Simulation::size(const MaterialPoints &points) const
  {
    return {{"method", method.name},
            {"element", space.element()},
            {"cells", mesh.triangulation().n_global_active_cells()},
            {"dofs", stepper->n_unknowns()},
            {"points", Utilities::MPI::sum(points.n_points(), comm)},
            {"lost_points", stepper->n_lost()},
            {"nonzeros", Utilities::MPI::sum(stepper->n_nonzeros(), comm)},
            {"ranks", Utilities::MPI::n_mpi_processes(comm)}};
  }

  Json
  Simulation::cost() const
  {
    std::map<std::string, double> seconds =
      timer.get_summary_data(TimerOutput::total_wall_time);
    const double linear = seconds["factorise"] + seconds["solve"];
    const double steps  = step_loop.wall_time();
    // Of this program: getrusage() begins with what the calling one had.
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    const double megabytes =
      Utilities::MPI::sum(memory.VmHWM / 1024., comm); // from kB
    return {{"total_s", total.wall_time()},
            {"cpu_s", Utilities::MPI::sum(cpu_time_of_rank(), comm)},
            {"step_loop_s", steps},
            {"residual_s", seconds["residual"]},
            {"assembly_s", seconds["assemble"]},
            {"analyse_s", seconds["analyse"]},
            {"factorise_s", seconds["factorise"]},
            {"solve_s", seconds["solve"]},
            {"commit_s", seconds["commit"]},
            {"transfer_s", seconds["transfer"]},
            {"output_s", seconds["output"]},
            {"linear_solver", stepper->linear_solver_name()},
            {"factorisations", n_factorisations},
            {"ratio_to_factorise_and_solve",
             linear > 0. ? Json(steps / linear) : Json()},
            {"peak_memory_MB", megabytes}};
  }
} // namespace geocone
