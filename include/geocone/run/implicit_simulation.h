// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_implicit_simulation_h
#define geocone_run_implicit_simulation_h

#include <geocone/implicit/implicit_fem.h>
#include <geocone/implicit/implicit_mpm.h>
#include <geocone/output/exact_solution.h>
#include <geocone/output/run_output.h>
#include <geocone/reduced/stress_methods.h>
#include <geocone/run/scene_simulation.h>
#include <geocone/run/step_control.h>

#include <functional>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  /** Initial state of the material points from the results of another run. It is an
   *  alternative to InitialStress. */
  class StartOfRun : public dealii::ParameterAcceptor
  {
  public:
    StartOfRun();

    std::string folder; ///< results of the other run, or empty
  };

  /** Run that simulates a scene by the finite element method or the implicit
   *  material point method. A step of the loading programme is subdivided into
   *  substeps (StepControl). */
  class ImplicitSimulation : public SceneSimulation
  {
  public:
    /** Function that returns the cell sizes of an adapted mesh and the bounds
     *  on the load from limit analysis. The cell sizes are those "from the
     *  bounds"; both results are valid on the first rank. Collective. */
    using SizesOfScene = std::function<std::pair<CellSizes, LoadBracket>(
      const MeshParameters &, const Scene &, const MPI_Comm, Log &)>;

    ImplicitSimulation(const MPI_Comm       comm,
                       const ParameterFile &file,
                       Log                 &log,
                       const SizesOfScene  &sizes_of_scene);

    OutputBase &
    output() override
    {
      return run_output;
    }

  private:
    /** Creates the mesh and rejects a run that would exceed the available memory.
     *  @return a warning, or an empty string */
    std::string
    prepare_mesh(const RunOptions &options);

    /** Enables friction with memory (regularised friction with a time delay,
     *  doc/theory/friction_memory.md) in scenes for which Newton's method is
     *  unlikely to converge with the exact law. */
    void
    remember_friction();

    /** Returns warnings of the scene on the mesh and of its materials. Collective. */
    std::vector<std::string>
    warn_of_scene() const;

    std::vector<std::string>
    prepare_method(const RunOptions &options) override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
    Json
    model() override;
    void
    begin(const TimePoint &now) override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &now) override;
    std::string
    progress(const TimePoint &now) const override;
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override; ///< scalars of the state
    void
    save(Archive &archive) override;
    void
    load(const Archive &archive) override;

    /** Solves the step of the loading programme that begins at t, in substeps. @throws
     *  StepFailure */
    void
    solve_step(const unsigned int step, const double t);

    /** Halves the substep size after a substep of the given size has failed.
     *  @throws StepFailure if the substep has been halved too often */
    void
    cut(const unsigned int  step,
        const double        t,
        const double        size,
        const SolverReport &report);

    Json
    cost() const;

    const SizesOfScene sizes_of_scene;

    BackgroundMesh  mesh;
    Space           space;
    NonsmoothNewton newton{stress_methods()};
    ImplicitFEM     implicit_fem;
    ImplicitMPM     implicit_mpm;
    TimeStepper    *stepper = nullptr; ///< time stepper of the method
    StepControl     step_control;
    StartOfRun      start_of_run;
    Freezer         freezer;
    ExactSolution   exact_solution;
    RunOutput       run_output;

    /** @name State */
    /** @{ */
    Kinematics     kinematics;
    MaterialPoints points;
    ImplicitRecord present;      ///< record of the current or last step
    double         reached = 0.; ///< time of the last converged substep (s)
    double         scaled  = 0.; ///< displacement path under load control (m)
    /** @} */

    dealii::TimerOutput timer;
    unsigned int        n_factorisations = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
