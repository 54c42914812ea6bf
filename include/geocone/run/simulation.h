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
  /**
   * A run: the story - stages, steps, fields, summaries, checkpoints, and how it
   * ends - which is the same for all methods. What a step is, and what is recorded
   * of it, they say themselves.
   */
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

    /** Where the run is in its programme. */
    struct Place
    {
      unsigned int stage    = 0;     ///< index of the stage
      bool         is_in    = false; ///< whether the stage has begun
      unsigned int in_stage = 0;     ///< steps of the stage that are done
      unsigned int step     = 0;     ///< steps that are done
      double       time     = 0.;    ///< (s)

      void
      state(StateRow &row)
      {
        row(stage, is_in, in_stage, step, time);
      }
    };

    /** How a step ended. */
    enum class Ended
    {
      well,
      stage, ///< well, and the stage is over
      run    ///< the run is over, as it was to be: results are those until then
    };

    /** @name What a method does. All collective. */
    /** @{ */

    /** Cheap or not, all that can be refused is refused here, and the state at
     *  t = 0 is made. @return warnings. @throws InputError */
    virtual std::vector<std::string>
    prepare(const RunOptions &options) = 0;

    /** Numbers of steps of the stages, at most. */
    virtual std::vector<unsigned int>
    programme() const = 0;

    /** Makes the folder and its tables. @throws InputError */
    virtual void
    prepare_output(const RunOptions &options) = 0;

    /** One line that says what is run. */
    virtual std::string
    headline(const std::string &name) const = 0;

    /** The model as data of a picture; null where there is none to show. */
    virtual Json
    model()
    {
      return {};
    }

    /** At the start of a run that is not resumed. */
    virtual void
    record_start()
    {}

    virtual void
    begin(const Place &place) = 0;

    /**
     * A step of the programme, or what is left of it where it was stopped.
     * @param[in,out] place its time moves on where the step ends well
     * @throws StepFailure, Stopped
     */
    virtual Ended
    advance(Place &place) = 0;

    /** Enters the step in the tables. @param place at its end */
    virtual void
    record(const Place &place) = 0;

    /** What the line of progress says of the last step. */
    virtual std::string
    progress(const Place &place) const = 0;

    /** After the last step of a stage. */
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

    /** The topics of the summary, in their order: results, size, cost. */
    virtual Json
    topics() = 0;

    /** Adds to the results of a run that has come to its end. @p t: the end */
    virtual void
    finish(const double)
    {}

    /** @name The state, for checkpoints: numbers, and what has rows of its own */
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
    /** All stages, from where the run is. */
    void
    follow_programme();

    void
    print_progress();

    /** @param status running | finished | failed: why */
    void
    write_summary(const std::string &status);

    /** Writes what is due after a step, or not. */
    void
    write_if_due(const bool is_last);

    void
    save_checkpoint();

    /** Goes back to the last good checkpoint. @throws InputError if none is */
    void
    resume();

    Place                     place;
    std::vector<unsigned int> n_in_stage;     ///< steps of each stage
    unsigned int              n_steps    = 0; ///< of all stages
    unsigned int              first_step = 0; ///< done by an earlier process
  };
} // namespace geocone::GEOCONE_DIM

#endif
