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
    double       accepted_excess = 0.01; ///< see NonsmoothNewton::Hints
  };

  /** The points of another run as a start, beside InitialStress. */
  class StartOfRun : public dealii::ParameterAcceptor
  {
  public:
    StartOfRun();

    std::string folder; ///< of the other run, or empty
  };

  /**
   * A run of the finite element method or the implicit material point method. A
   * step of the loading programme is reached in substeps (StepControl).
   */
  class ImplicitSimulation : public SceneSimulation
  {
  public:
    /** Finds the sizes of a mesh "from the bounds" of a scene, and those bounds, which
     *  the first rank has; limit analysis, which is no part of this. Collective. */
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
    /** Makes the mesh, and refuses a run that is too large. */
    void
    prepare_mesh(const RunOptions &options);

    /** Gives friction a memory where the exact law would not be solved. */
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
    begin(const Place &place) override;
    Ended
    advance(Place &place) override;
    void
    record(const Place &place) override;
    std::string
    progress(const Place &place) const override;
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override; ///< but for fields
    void
    save(Archive &archive) override;
    void
    load(const Archive &archive) override;

    /** The longest substep of a step h, which friction with memory limits to
     *  tau/2: its tangent is then nearly elliptic
     *  (doc/theory/friction_memory.md). */
    double
    largest_substep(const double h) const;

    /** Below it a step h has failed. */
    double
    smallest_substep(const double h) const;

    /** From t to t + h, in substeps. @throws StepFailure */
    void
    solve_step(const unsigned int step, const double t, const double h);

    /** Halves the substep after a failed one of this size.
     *  @throws StepFailure if it has been halved too often */
    void
    cut(const unsigned int  step,
        const double        t,
        const double        h,
        const double        size,
        const SolverReport &report);

    Json
    cost() const;

    /** How many of them are: where the exact law has no solution nearby, smaller steps
     *  find none either. */
    static constexpr unsigned int most_halved_for_excess = 3;

    const SizesOfScene sizes_of_scene;

    BackgroundMesh  mesh;
    Space           space;
    NonsmoothNewton newton{stress_methods()};
    ImplicitFEM     implicit_fem;
    ImplicitMPM     implicit_mpm;
    TimeStepper    *stepper = nullptr; ///< the one of the method
    StepControl     step_control;
    StartOfRun      start_of_run;
    Freezer         freezer;
    ExactSolution   exact_solution;
    RunOutput       run_output;

    /** @name State */
    /** @{ */
    Kinematics     kinematics;
    MaterialPoints points;
    double         substep    = 0.;    ///< to be tried next (s)
    double         last_size  = 0.;    ///< of the present or last step (s)
    double         done       = 0.;    ///< of the present step (s)
    bool           is_in_step = false; ///< whether the step has begun
    /** Substeps that were halved in a row for SolverReport::exceeds. */
    unsigned int   halved_for_excess = 0;
    ImplicitRecord present;      ///< of the present step, or the last one
    double         reached = 0.; ///< time of the last substep solved (s)
    double         raised  = 0.; ///< way of raised loads since a reset (m)
    /** @} */

    dealii::TimerOutput timer;
    unsigned int        n_factorisations = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
