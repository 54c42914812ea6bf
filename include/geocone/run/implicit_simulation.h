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

#include <functional>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  /**
   * Control of the substep size in implicit runs. A step of the loading programme is
   * subdivided into substeps: a failed substep is halved; after a substep with few
   * iterations, the size increases by half, up to the full step.
   */
  class StepControl : public dealii::ParameterAcceptor
  {
  public:
    StepControl();

    void
    prepare();

    unsigned int max_halvings    = 9;
    unsigned int easy_iterations = 12;
    double       accepted_excess = 0.01; ///< see NonsmoothNewton::Hints
  };

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

    /** Largest permitted substep size (s) in a step of size h. Friction with
     *  memory limits the substep to tau/2, for which the tangent is nearly
     *  elliptic (doc/theory/friction_memory.md). */
    double
    largest_substep(const double h) const;

    /** Smallest permitted substep size (s) in a step of size h. If a smaller
     *  substep is necessary, the step fails. */
    double
    smallest_substep(const double h) const;

    /** Solves a step of the loading programme from t to t + h in substeps. @throws
     *  StepFailure */
    void
    solve_step(const unsigned int step, const double t, const double h);

    /** Halves the substep size after a substep of the given size has failed.
     *  @throws StepFailure if the substep has been halved too often */
    void
    cut(const unsigned int  step,
        const double        t,
        const double        h,
        const double        size,
        const SolverReport &report);

    Json
    cost() const;

    /** Maximum of halved_for_excess. If the exact law has no solution near the iterate,
     *  smaller substeps do not help. */
    static constexpr unsigned int most_halved_for_excess = 3;

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
    double         substep    = 0.; ///< size of the next substep (s)
    double         last_size  = 0.; ///< size of the current or last step (s)
    double         done       = 0.; ///< completed part of the current step (s)
    bool           is_in_step = false; ///< whether a step has begun
    /** Number of consecutive times that the substep was halved because the
     *  solution with lagged friction differed too much from the exact law
     *  (SolverReport::lag_error_too_large). */
    unsigned int   halved_for_excess = 0;
    ImplicitRecord present;      ///< record of the current or last step
    double         reached = 0.; ///< time of the last converged substep (s)
    double         scaled  = 0.; ///< displacement path under load control (m)
    /** @} */

    dealii::TimerOutput timer;
    unsigned int        n_factorisations = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
