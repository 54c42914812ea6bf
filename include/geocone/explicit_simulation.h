// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_simulation_h
#define geocone_explicit_simulation_h

#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/discretisation/method.h>
#include <geocone/output/explicit_output.h>
#include <geocone/run_options.h>
#include <geocone/scene/scene.h>
#include <geocone/time_stepping/explicit_mpm.h>

#include <deal.II/base/timer.h>

#include <string>

namespace geocone
{
  /**
   * A run of the explicit material point method: the scene, the stepper and the
   * output, in the order in which data flows; run() is the story of the run. A
   * step of the loading programme is what statistics.csv has a line of; the
   * explicit steps within it are the stepper's own.
   */
  class ExplicitSimulation
  {
  public:
    ExplicitSimulation(const MPI_Comm       comm,
                       const ParameterFile &file,
                       Log                 &log);

    /**
     * @return whether all expectations hold
     * @throws InputError before anything is written, RunError afterwards
     */
    bool
    run(const RunOptions &options);

    const OutputBase &
    output() const
    {
      return explicit_output;
    }

  private:
    Json
    size() const;
    Json
    cost() const;

    /** Adds the record of a step and shows where the run is. */
    void
    record(const unsigned int    step,
           const unsigned int    n_steps,
           const double          t,
           const ExplicitReport &report);

    const MPI_Comm comm;
    Log           &log;

    Scene          scene;
    Method         method;
    ExplicitMPM    stepper;
    ExplicitOutput explicit_output;

    ExplicitState state; ///< at the last record

    dealii::Timer total, step_loop, output_time;
  };
} // namespace geocone

#endif
