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
  /** Sequence of a run: stages, steps, fields, summaries, checkpoints and termination,
   *  the same for all methods. Derived classes define a step and its records. */
  class Simulation
  {
  public:
    virtual ~Simulation() = default;

    /**
     * @return whether all expectations of the parameter file hold
     * @throws InputError before anything is written, RunError afterwards
     */
    bool
    run(const RunOptions &options);

    virtual OutputBase &
    output() = 0;

  protected:
    Simulation(const MPI_Comm comm, Log &log);

    /** Position of the run in its programme. */
    struct Place
    {
      unsigned int stage    = 0;     ///< index of the stage
      bool         is_in    = false; ///< whether the stage has begun
      unsigned int in_stage = 0;     ///< completed steps of the stage
      unsigned int step     = 0;     ///< completed steps
      double       time     = 0.;    ///< (s)

      void
      state(StateRow &row)
      {
        row(stage, is_in, in_stage, step, time);
      }
    };

    /** Outcome of a step. */
    enum class Ended
    {
      well,
      stage, ///< well, and the stage is complete
      run    ///< the run is complete with the results so far
    };

    /** @name Implemented by a method. All collective. */
    /** @{ */

    /** Checks all input, including checks that are expensive, and sets the
     *  state at t = 0.
     *  @return warnings. @throws InputError */
    virtual std::vector<std::string>
    prepare(const RunOptions &options) = 0;

    /** Maximum number of steps of each stage. */
    virtual std::vector<unsigned int>
    programme() const = 0;

    /** Makes the folder and its tables. @throws InputError */
    virtual void
    prepare_output(const RunOptions &options) = 0;

    /** One-line description of the run. */
    virtual std::string
    headline(const std::string &name) const = 0;

    /** The model as data for a plot; null if not available. */
    virtual Json
    model()
    {
      return {};
    }

    /** Called at the start of a run that is not resumed. */
    virtual void
    record_start()
    {}

    virtual void
    begin(const Place &place) = 0;

    /**
     * Solves a step of the programme, or the remainder of one that was stopped.
     * @param[in,out] place its time advances if the step succeeds
     * @throws StepFailure, Stopped
     */
    virtual Ended
    advance(Place &place) = 0;

    /** Adds the step to the tables. @param place at its end */
    virtual void
    record(const Place &place) = 0;

    /** Text about the last step for the progress line. */
    virtual std::string
    progress(const Place &place) const = 0;

    /** Called after the last step of a stage. */
    virtual void
    end(const Place &)
    {}

    /** Whether fields are due after a step that is not the last of its stage. */
    virtual bool
    wants_fields(const Place &) const
    {
      return false;
    }

    virtual void
    write_fields(const double)
    {}

    /** Topics of the summary, in their order: results, size, cost. */
    virtual Json
    topics() = 0;

    /** Adds to the results of a completed run. @p t: final time */
    virtual void
    finish(const double)
    {}

    /** @name State for checkpoints: numbers, and arrays */
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

    const MPI_Comm comm;
    Log           &log;
    Checkpoint     checkpoint;
    dealii::Timer  total, step_loop, output_time;

  private:
    /** Performs all stages from the present position. */
    void
    follow_programme();

    void
    print_progress();

    /** @param status running | finished | failed: why */
    void
    write_summary(const std::string &status);

    /** Writes fields, summary and checkpoint if due. */
    void
    write_if_due(const bool is_last);

    void
    save_checkpoint();

    /** Returns to the latest valid checkpoint. @throws InputError if there is none */
    void
    resume();

    Place                     place;
    std::vector<unsigned int> n_in_stage;     ///< steps of each stage
    unsigned int              n_steps    = 0; ///< of all stages
    unsigned int              first_step = 0; ///< of this process
  };
} // namespace geocone::GEOCONE_DIM

#endif
