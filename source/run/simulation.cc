// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/laws/umat_library.h>
#include <geocone/linear/blas_kernels.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  Simulation::Simulation(const MPI_Comm comm, Log &log)
    : comm(comm)
    , log(log)
  {
    step_loop.reset();
    output_time.reset();
  }

  bool
  Simulation::run(const RunOptions &options)
  {
    checkpoint.prepare(comm);
    const std::vector<std::string> warnings = prepare(options);
    if (options.dry_run)
      {
        for (const std::string &warning : warnings)
          log.warn(warning);
        if (options.picture)
          {
            const Json description = model();
            if (description.is_null())
              throw InputError("--picture draws a scene, and a point has none\n"
                               "  remedy:  leave it out");
            output().make_folder_of_model(options);
            output().write_model(description);
          }
        return true;
      }
    n_in_stage = programme();
    for (const unsigned int n : n_in_stage)
      n_steps += n;
    prepare_output(options);
    if (options.resumes)
      resume();
    log.print(headline(options.name));
    log.print("results in " + output().folder());
    if (!options.resumes)
      {
        for (const std::string &warning : warnings)
          log.warn(warning);
        if (const Json description = model(); !description.is_null())
          output().write_model(description);
      }
    write_summary("running");
    try
      {
        if (!options.resumes)
          record_start();
        follow_programme();
        finish(now.time);
        // The result is printed from a summary, which then takes its warnings.
        write_summary("running");
        output().print_result();
        write_summary("finished");
        output().report();
      }
    catch (const std::exception &error)
      {
        const bool is_stopped = dynamic_cast<const Stopped *>(&error);
        const bool together =
          output().end_with(error, [&](const std::string &status) {
            if (is_stopped)
              try
                {
                  save_checkpoint();
                  log.print(
                    "to go on: geocone --resume " + output().folder() +
                    (options.may_run_scripts ? " --run-gmsh-script" : "") +
                    (may_load_libraries()
                       ? std::string(" ") + option_for_libraries
                       : ""));
                }
              catch (const RunError &failure)
                {
                  log.warn(std::string("no checkpoint: ") + failure.what());
                }
            write_summary(status);
            write_fields(now.time);
          });
        if (!together)
          end_all_ranks(error.what());
        throw;
      }
    return output().expectations_hold();
  }

  void
  Simulation::follow_programme()
  {
    for (; now.stage < n_in_stage.size(); ++now.stage)
      {
        if (!now.is_in)
          {
            begin(now);
            now.is_in    = true;
            now.in_stage = 0;
          }
        while (now.in_stage < n_in_stage[now.stage])
          {
            stop_if_asked(comm);
            step_loop.start();
            const StepOutcome ended = advance(now);
            step_loop.stop();
            if (ended == StepOutcome::run)
              return;
            ++now.in_stage;
            ++now.step;
            const bool is_last = ended == StepOutcome::stage ||
                                 now.in_stage == n_in_stage[now.stage];
            output_time.start();
            record(now);
            print_progress();
            write_if_due(is_last);
            output_time.stop();
            if (is_last)
              {
                end(now);
                now.in_stage = n_in_stage[now.stage];
              }
            if (checkpoint.is_due(now.step))
              save_checkpoint();
          }
        now.is_in = false;
      }
  }

  void
  Simulation::print_progress()
  {
    if (output().verbosity < 1)
      return;
    const std::string text = progress(now);
    if (!text.empty())
      log.progress(format("step %u/%u  ", now.step, n_steps) + text +
                   format("  %.0f s left",
                          total.wall_time() / (now.step - first_step) *
                            (n_steps - now.step)));
  }

  void
  Simulation::write_summary(const std::string &status)
  {
    Json json                 = topics();
    json["cost"]["blas_core"] = blas_core();
    output().write_summary(status, json);
  }

  void
  Simulation::write_if_due(const bool is_last)
  {
    if (is_last || wants_fields(now))
      {
        write_fields(now.time);
        write_summary("running");
      }
    else if (output().summary_is_old())
      write_summary("running");
  }

  void
  Simulation::save_checkpoint()
  {
    checkpoint.write(output().folder(), now.step, [&](Archive &archive) {
      StateRow row;
      row(now);
      output().state_of_run(row);
      state(row);
      archive.write_row("run", row);
      save(archive);
    });
  }

  void
  Simulation::resume()
  {
    checkpoint.read(output().folder(), log, [&](const Archive &archive) {
      StateRow row = archive.read_row("run");
      row(now);
      // Tables are written by the first rank.
      std::string why_not;
      try
        {
          output().state_of_run(row);
        }
      catch (const RunError &error)
        {
          why_not = error.what();
        }
      why_not = dealii::Utilities::MPI::broadcast(comm, why_not);
      if (why_not.empty())
        {
          state(row);
          load(archive);
        }
      return why_not;
    });
    log.open(output().folder() + "/log.txt", true);
    first_step = now.step;
    log.print(format("resumed at t = %.6g s, after step %u of %u",
                     now.time,
                     now.step,
                     n_steps));
  }
} // namespace geocone::GEOCONE_DIM
