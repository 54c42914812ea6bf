// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_simulation_h
#define geocone_run_simulation_h

#include <geocone/base/log.h>
#include <geocone/base/run_options.h>
#include <geocone/output/model_file.h>
#include <geocone/output/output_base.h>
#include <geocone/run/checkpoint.h>

#include <deal.II/base/timer.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Sequence of operations common to the runs of all methods: stages, steps, fields,
   *  summaries, checkpoints and termination. Derived classes define a step and the
   *  records of a step. */
  class Simulation
  {
  public:
    virtual ~Simulation() = default;

    /**
     * Executes the run.
     * @return whether the results satisfy all expectations of the parameter file
     * @throws InputError before anything is written, RunError afterwards
     */
    bool
    run(const RunOptions &options);

    virtual OutputBase &
    output() = 0;

  protected:
    Simulation(const MPI_Comm comm, Log &log);

    /** Current position of the run in the loading programme. */
    struct TimePoint
    {
      unsigned int stage    = 0;     ///< index of the stage
      bool         is_in    = false; ///< whether the stage has begun
      unsigned int in_stage = 0;     ///< completed steps of the stage
      unsigned int step     = 0;     ///< completed steps, all stages
      double       time     = 0.;    ///< (s)

      void
      state(StateRow &row)
      {
        row(stage, is_in, in_stage, step, time);
      }
    };

    /** Outcome of a step of the loading programme. */
    enum class StepOutcome
    {
      well,
      stage, ///< step and stage are complete
      run    ///< completed; the run is complete
    };

    /** @name Functions implemented by a method. All collective. */
    /** @{ */

    /** Checks the complete input and sets the initial state at t = 0. Expensive checks
     *  are included.
     *  @return warnings. @throws InputError */
    virtual std::vector<std::string>
    prepare(const RunOptions &options) = 0;

    /** Maximum number of steps of each stage. */
    virtual std::vector<unsigned int>
    programme() const = 0;

    /** Creates the folder and the tables of the run. @throws InputError */
    virtual void
    prepare_output(const RunOptions &options) = 0;

    /** One-line description of the run. */
    virtual std::string
    headline(const std::string &name) const = 0;

    /** Data for a plot of the model (geometry, materials, boundary conditions). They
     *  are null if not available. */
    virtual Json
    model()
    {
      return {};
    }

    /** Records the initial state. Called at the start of a run that is not resumed. */
    virtual void
    record_start()
    {}

    virtual void
    begin(const TimePoint &now) = 0;

    /**
     * Solves a step of the loading programme, or the remainder of an interrupted step.
     * @param[in,out] now position in the programme; its time advances if the step
     * succeeds
     * @throws StepFailure, Stopped
     */
    virtual StepOutcome
    advance(TimePoint &now) = 0;

    /** Appends a line for the completed step to the tables. @param now at the end of
     *  the step */
    virtual void
    record(const TimePoint &now) = 0;

    /** Text about the last step for the progress line. */
    virtual std::string
    progress(const TimePoint &now) const = 0;

    /** Performs the operations that complete a stage, after its last step. */
    virtual void
    end(const TimePoint &)
    {}

    /** Returns true if fields are also written after steps that do not end a stage. */
    virtual bool
    wants_fields(const TimePoint &) const
    {
      return false;
    }

    virtual void
    write_fields(const double)
    {}

    /** Sections of summary.json, in the order results, size, cost. */
    virtual Json
    topics() = 0;

    /** Appends the final results of a completed run to the output. @p t: final time */
    virtual void
    finish(const double)
    {}

    /** @name State for checkpoints: scalars (state) and arrays (save, load) */
    /** @{ */
    virtual void
    state(StateRow &)
    {}
    virtual void
    save(Archive &)
    {}
    virtual void
    load(const Archive &)
    {}
    /** @} */
    /** @} */

    /** Wall and CPU time so far, entries of the section cost (s). */
    Json
    times() const
    {
      return {{"total_s", total.wall_time()}, {"cpu_s", total.cpu_time()}};
    }

    const MPI_Comm comm;
    Log           &log;
    Checkpoint     checkpoint;
    dealii::Timer  total, step_loop, output_time;

  private:
    /** Runs all remaining stages, starting from the current position in the
     *  loading programme. */
    void
    follow_programme();

    void
    print_progress();

    /** Writes summary.json with the given status.
     *  @param status running | finished | failed: reason */
    void
    write_summary(const std::string &status);

    /** Writes fields, summary and checkpoint after a step, each if due. */
    void
    write_if_due(const bool is_last);

    void
    save_checkpoint();

    /** Resumes the run from its latest valid checkpoint. @throws InputError if no
     *  checkpoint is valid */
    void
    resume();

    TimePoint                 now;
    std::vector<unsigned int> n_in_stage;     ///< steps of each stage
    unsigned int              n_steps    = 0; ///< steps of all stages
    unsigned int              first_step = 0; ///< first step of this process
  };
} // namespace geocone::GEOCONE_DIM

#endif
