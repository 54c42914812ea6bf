// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/simulation.h>

namespace geocone
{
  Simulation::Simulation(const MPI_Comm       comm,
                         const ParameterFile &file,
                         Log                 &log)
    : comm(comm)
    , log(log)
    , scene(file)
  {
    step_loop.reset();
    output_time.reset();
  }

  bool
  Simulation::run(const RunOptions &options)
  {
    scene.prepare();
    method.prepare();
    checkpoint.prepare(comm);
    for (const auto &stage : scene.loading.stages)
      n_steps += stage->step_sizes().size();
    const std::vector<std::string> warnings = prepare(options);
    if (options.dry_run)
      return true;
    prepare_output(options);
    if (options.resumes)
      resume();
    log.print(headline(options.name));
    log.print("results in " + output().folder());
    if (!options.resumes)
      for (const std::string &warning : warnings)
        log.warn(warning);
    write_summary("running");
    try
      {
        if (!options.resumes && has_fields_at_start())
          write_fields(0.);
        follow_programme();
        finish(place.time);
      }
    catch (const std::exception &error)
      {
        const bool is_stopped = dynamic_cast<const Stopped *>(&error);
        output().end_with(error, [&](const std::string &status) {
          if (is_stopped)
            try
              {
                save_checkpoint();
                log.print("to go on: geocone --resume " + output().folder());
              }
            catch (const RunError &failure)
              {
                log.warn(std::string("no checkpoint: ") + failure.what());
              }
          write_summary(status);
          write_fields(place.time);
        });
        throw;
      }
    return output().expectations_hold();
  }

  void
  Simulation::follow_programme()
  {
    const auto &stages = scene.loading.stages;
    for (; place.stage < stages.size(); ++place.stage)
      {
        const Stage &stage = *stages[place.stage];
        if (!place.is_in)
          {
            begin_stage(stage, place.time);
            place.is_in    = true;
            place.in_stage = 0;
          }
        const std::vector<double> sizes = stage.step_sizes();
        while (place.in_stage < sizes.size())
          {
            stop_if_asked(comm);
            const double h = sizes[place.in_stage];
            step_loop.start();
            const Ended ended = advance(stage, place, h);
            step_loop.stop();
            if (ended == Ended::run)
              return;
            ++place.in_stage;
            ++place.step;
            place.time += h;
            output_time.start();
            record(stage, place);
            print_progress();
            write_if_due(stage, place.in_stage == sizes.size());
            output_time.stop();
            if (place.in_stage == sizes.size())
              end_stage(stage);
            if (checkpoint.is_due(place.step))
              save_checkpoint();
          }
        place.is_in = false;
      }
  }

  void
  Simulation::print_progress()
  {
    if (output().verbosity >= 1)
      log.progress(
        format("step %u/%u  t = %.4g s  ", place.step, n_steps, place.time) +
        progress() +
        format("  %.0f s left",
               total.wall_time() / (place.step - first_step) *
                 (n_steps - place.step)));
  }

  void
  Simulation::write_if_due(const Stage &stage, const bool is_last)
  {
    if (is_last ||
        (stage.output_every > 0 && place.in_stage % stage.output_every == 0))
      {
        write_fields(place.time);
        write_summary("running");
      }
    else if (output().summary_is_old())
      write_summary("running");
  }

  void
  Simulation::save_checkpoint()
  {
    checkpoint.write(output().folder(), place.step, [&](Archive &archive) {
      StateRow row;
      row(place);
      output().state_of_run(row);
      archive.write_row("run", row);
      save(archive);
    });
  }

  void
  Simulation::resume()
  {
    checkpoint.read(output().folder(), log, [&](const Archive &archive) {
      StateRow row = archive.read_row("run");
      row(place);
      output().state_of_run(row);
      load(archive);
    });
    first_step = place.step;
    log.print(format("resumed at t = %.6g s, after step %u of %u",
                     place.time,
                     place.step,
                     n_steps));
  }
} // namespace geocone
