// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_simulation_h
#define geocone_simulation_h

#include <geocone/output/exact_solution.h>
#include <geocone/output/run_output.h>
#include <geocone/run_options.h>
#include <geocone/time_stepping/implicit_fem.h>
#include <geocone/time_stepping/implicit_mpm.h>

namespace geocone
{
  /**
   * How failed steps are cut and grow again. A step of the loading programme is
   * reached in substeps: a failed one is halved, an easy one lets the next grow
   * by half, up to the whole step.
   */
  class StepControl : public dealii::ParameterAcceptor
  {
  public:
    StepControl();

    void
    prepare();

    unsigned int max_halvings    = 9;
    unsigned int easy_iterations = 12;
  };

  /**
   * A run: owns everything, in the order in which data flows. Points, velocities,
   * time and step number are locals of run().
   */
  class Simulation
  {
  public:
    Simulation(const MPI_Comm comm, const ParameterFile &file, Log &log);

    /**
     * @return whether all expectations of the parameter file hold
     * @throws InputError before anything is computed, RunError afterwards
     */
    bool
    run(const RunOptions &options);

    const RunOutput &
    output() const
    {
      return run_output;
    }

  private:
    /** Cheap or not, all that can be refused is refused here.
     *  @return whether there is something to run */
    bool
    prepare(const RunOptions &options,
            Kinematics       &kinematics,
            MaterialPoints   &points);

    /** One step of the programme, from t to t + h. @throws RunError */
    StepRecord
    advance(Kinematics        &kinematics,
            MaterialPoints    &points,
            const unsigned int step,
            const double       t,
            const double       h,
            double            &substep);

    /** The results, when all stages are done or one has ended by failure.
     *  @return as run() */
    bool
    end_run(const Kinematics     &kinematics,
            const MaterialPoints &points,
            const double          t);

    Json
    size(const MaterialPoints &points) const;
    Json
    cost() const;

    const MPI_Comm comm;
    Log           &log;

    Scene           scene;
    Method          method;
    BackgroundMesh  mesh;
    Space           space;
    NonsmoothNewton newton;
    ImplicitFEM     implicit_fem;
    ImplicitMPM     implicit_mpm;
    TimeStepper    *stepper = nullptr; ///< the one of the method
    StepControl     step_control;
    Freezer         freezer;
    ExactSolution   exact_solution;
    RunOutput       run_output;

    double reached = 0.; ///< time of the last substep that was solved (s)

    dealii::TimerOutput timer;
    dealii::Timer       total, step_loop;
    unsigned int        n_factorisations = 0;
  };
} // namespace geocone

#endif
