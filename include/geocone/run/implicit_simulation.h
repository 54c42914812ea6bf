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
   * Substep sizes. A step of the loading programme is reached in substeps: a failed
   * substep is halved; after an easy one the next grows by half, up to the full step.
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

  /** Initial points taken from another run, besides InitialStress. */
  class StartOfRun : public dealii::ParameterAcceptor
  {
  public:
    StartOfRun();

    std::string folder; ///< of the other run, or empty
  };

  /** Run of the finite element method or the implicit material point method. A step of
   *  the loading programme is reached in substeps (StepControl). */
  class ImplicitSimulation : public SceneSimulation
  {
  public:
    /** Returns the sizes of a mesh "from the bounds" of a scene, and the bounds, known
     *  to the first rank. Implemented by limit analysis. Collective. */
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
    /** Creates the mesh, and rejects a run that is too large. */
    void
    prepare_mesh(const RunOptions &options);

    /** Enables friction with memory where the exact law is unlikely to converge. */
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
    state(StateRow &row) override; ///< except fields
    void
    save(Archive &archive) override;
    void
    load(const Archive &archive) override;

    /** Largest substep of a step h. Friction with memory limits it to tau/2, where its
     *  tangent is nearly elliptic (doc/theory/friction_memory.md). */
    double
    largest_substep(const double h) const;

    /** Substep size of a step h below which the step has failed. */
    double
    smallest_substep(const double h) const;

    /** Solves from t to t + h in substeps. @throws StepFailure */
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

    /** Maximum number of them: where the exact law has no solution nearby, smaller
     *  steps do not help. */
    static constexpr unsigned int most_halved_for_excess = 3;

    const SizesOfScene sizes_of_scene;

    BackgroundMesh  mesh;
    Space           space;
    NonsmoothNewton newton{stress_methods()};
    ImplicitFEM     implicit_fem;
    ImplicitMPM     implicit_mpm;
    TimeStepper    *stepper = nullptr; ///< of the method
    StepControl     step_control;
    StartOfRun      start_of_run;
    Freezer         freezer;
    ExactSolution   exact_solution;
    RunOutput       run_output;

    /** @name State */
    /** @{ */
    Kinematics     kinematics;
    MaterialPoints points;
    double         substep    = 0.;    ///< size of the next attempt (s)
    double         last_size  = 0.;    ///< of the present or last step (s)
    double         done       = 0.;    ///< part of the present step (s)
    bool           is_in_step = false; ///< whether the step has begun
    /** Substeps halved in a row because of SolverReport::exceeds. */
    unsigned int   halved_for_excess = 0;
    ImplicitRecord present;      ///< the present or last step
    double         reached = 0.; ///< time of the last converged substep (s)
    double         raised  = 0.; ///< path under load control since a reset (m)
    /** @} */

    dealii::TimerOutput timer;
    unsigned int        n_factorisations = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
