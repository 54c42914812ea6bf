// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/explicit_simulation.h>
#include <geocone/output/run_status.h>

#include <deal.II/base/mpi.h>

namespace geocone
{
  using namespace dealii;

  ExplicitSimulation::ExplicitSimulation(const MPI_Comm       comm,
                                         const ParameterFile &file,
                                         Log                 &log)
    : comm(comm)
    , log(log)
    , scene(file)
    , stepper(comm, file)
    , explicit_output(comm, log)
  {
    step_loop.reset();
    output_time.reset();
  }

  void
  ExplicitSimulation::record(const unsigned int    step,
                             const unsigned int    n_steps,
                             const double          t,
                             const ExplicitReport &report)
  {
    state = stepper.state();
    explicit_output.add_record(
      {step, t, step_loop.last_cpu_time(), report, state, stepper.balance()});
    if (explicit_output.verbosity >= 1)
      log.progress(
        format("step %u/%u  t = %.4g s  %lu explicit steps  kinetic energy = "
               "%.3g J/m  plastic strain <= %.3g  %.0f s left",
               step,
               n_steps,
               t,
               stepper.n_steps,
               state.kinetic,
               state.largest_plastic_strain,
               total.wall_time() / step * (n_steps - step)));
  }

  bool
  ExplicitSimulation::run(const RunOptions &options)
  {
    scene.prepare();
    method.prepare();
    const std::vector<std::string> remarks = stepper.prepare(scene, method);
    if (options.dry_run)
      return true;
    explicit_output.prepare(options.name, options.folder, scene);

    state = stepper.state();
    explicit_output.set_initial(state);
    log.print(format("%s: explicit MPM (%s), %s, %lu nodes, %lu points, %s, %u "
                     "rank%s",
                     options.name.c_str(),
                     stepper.order().c_str(),
                     stepper.element().c_str(),
                     stepper.grid().n_all_nodes(),
                     state.n_points,
                     stepper.grid().description().c_str(),
                     Utilities::MPI::n_mpi_processes(comm),
                     Utilities::MPI::n_mpi_processes(comm) > 1 ? "s" : ""));
    log.print("results in " + explicit_output.folder());
    for (const std::string &remark : remarks)
      log.warn(remark);

    unsigned int n_steps = 0;
    for (const auto &stage : scene.loading.stages)
      n_steps += stage->step_sizes().size();
    double       t    = 0.;
    unsigned int step = 0;
    explicit_output.write_summary(
      "running", stepper.law_counts(), size(), cost());
    try
      {
        explicit_output.write_points(t, stepper.points());
        for (const auto &stage : scene.loading.stages)
          {
            for (const std::string &remark : stepper.begin_stage(*stage, t))
              log.print("stage " + stage->name + ": " + remark);
            const std::vector<double> sizes = stage->step_sizes();
            for (std::size_t i = 0; i < sizes.size(); ++i)
              {
                stop_if_asked(comm);
                step_loop.start();
                const ExplicitReport report =
                  stepper.advance(*stage, t, sizes[i]);
                step_loop.stop();
                t += sizes[i];

                output_time.start();
                record(++step, n_steps, t, report);
                if (i + 1 == sizes.size() ||
                    (stage->output_every > 0 &&
                     (i + 1) % stage->output_every == 0))
                  {
                    explicit_output.write_points(t, stepper.points());
                    explicit_output.write_summary(
                      "running", stepper.law_counts(), size(), cost());
                  }
                else if (explicit_output.summary_is_old())
                  explicit_output.write_summary(
                    "running", stepper.law_counts(), size(), cost());
                output_time.stop();
                if (i + 1 == sizes.size())
                  stepper.check_equilibrium(*stage, state, report);
              }
          }
        explicit_output.write_summary(
          "finished", stepper.law_counts(), size(), cost());
      }
    catch (const std::exception &error)
      {
        explicit_output.end_with(error, [&](const std::string &status) {
          explicit_output.write_summary(
            status, stepper.law_counts(), size(), cost());
          explicit_output.write_points(t, stepper.points());
        });
        throw;
      }
    explicit_output.print_result();
    const Json costs = cost();
    log.print(format("%.1f s in all; %.1f ns per point and step (CPU, all "
                     "ranks), %.0f bytes per point",
                     costs["total_s"].get<double>(),
                     costs["cpu_ns_per_point_step"].get<double>(),
                     costs["bytes_per_point"].get<double>()));
    return explicit_output.expectations_hold();
  }

  Json
  ExplicitSimulation::size() const
  {
    return {{"method", method.name},
            {"element", stepper.element()},
            {"cells", stepper.grid().n_cells()},
            {"nodes", stepper.grid().n_all_nodes()},
            {"points", state.n_points},
            {"ranks", Utilities::MPI::n_mpi_processes(comm)}};
  }

  Json
  ExplicitSimulation::cost() const
  {
    const auto  &seconds = stepper.seconds();
    const double updates = Utilities::MPI::sum(stepper.n_point_steps, comm);
    const double cpu     = Utilities::MPI::sum(step_loop.cpu_time(), comm);
    const double bytes   = Utilities::MPI::sum(double(stepper.memory()), comm);
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
} // namespace geocone
