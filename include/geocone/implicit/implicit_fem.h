// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_fem_h
#define geocone_implicit_implicit_fem_h

#include <geocone/conditions/constraints.h>
#include <geocone/conditions/loads.h>
#include <geocone/contact/obstacle_contact.h>
#include <geocone/implicit/fading_forces.h>
#include <geocone/implicit/raised_loads.h>
#include <geocone/implicit/time_integration.h>
#include <geocone/problem/absorbing_boundary.h>
#include <geocone/time_stepping/time_stepper.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Steps of the finite element method with points that do not move (small strains).
   */
  class ImplicitFEM : public TimeStepper, public dealii::ParameterAcceptor
  {
  public:
    ImplicitFEM();

    bool
    has_inertia() const override
    {
      return inertia;
    }

    std::string
    prepare(const Scene           &scene,
            BackgroundMesh        &mesh,
            Space                 &space,
            const NonsmoothNewton &newton,
            dealii::TimerOutput   &timer,
            Kinematics            &kinematics,
            MaterialPoints        &points) override;

    Energies
    state_energies(const Kinematics     &kinematics,
                   const MaterialPoints &points,
                   const double          t) const override;

    StepReport
    advance(Kinematics            &kinematics,
            MaterialPoints        &points,
            const NonsmoothNewton &newton,
            Freezer               &freezer,
            dealii::TimerOutput   &timer,
            const double           t,
            const double           h,
            const double           accepted_excess) override;

    BodyChange
    change_body(const Stage         &stage,
                const double         t,
                dealii::TimerOutput &timer,
                Kinematics          &kinematics,
                MaterialPoints      &points) override;

    void
    save(Archive &archive, const MaterialPoints &points) override;
    void
    load(const Archive &archive, MaterialPoints &points) override;

    unsigned int
    n_unknowns() const override
    {
      return constraints->n_rows;
    }

    std::string
    linear_solver_name() const override
    {
      return system->solver_name();
    }

    std::size_t
    n_nonzeros() const override
    {
      return system->n_nonzeros();
    }

    const std::vector<RigidMotion> &
    moved_obstacles() const override
    {
      return obstacles->moved();
    }

  private:
    void
    take_points(const Archive &archive, MaterialPoints &points) override;

    /** Refuses a scene in which no stress can arise. Collective. */
    void
    check_resistance(const MaterialPoints &points, const MPI_Comm comm) const;

    /** Unknowns, loads, problem and pattern: all that depends on which cells there
     *  are. @throws InputError if nothing holds them */
    void
    begin(const MaterialPoints &points, dealii::TimerOutput &timer);

    /** Gives the problem the step: loads, prescribed velocities, what touches.
     *  @return the loads that it raises. Collective. */
    RaisedLoads
    begin_step(const TimeStep      &step,
               const Kinematics    &kinematics,
               dealii::TimerOutput &timer);

    /** What loads, supports and absorbing sides have done in the step (J/m). */
    double
    work_of_forces(const TimeStep &step,
                   const Vector   &v,
                   const Vector   &residual) const;

    /** Gives the points their state at the end of the step.
     *  @return the dissipation (J/m) */
    double
    update_points(const TimeStep &step, MaterialPoints &points) const;

    /** Gives nodes and supports their displacements, by the velocity v that was solved
     *  for, and nodes in contact theirs at the end of the step.
     *  @return what contact takes when it settles (J/m) */
    double
    update_kinematics(const TimeStep &step,
                      const Vector   &v,
                      Kinematics     &kinematics);

    bool
    has_force() const
    {
      return loads->exist() || scene->loading.changes_body();
    }

    /** External forces less the internal ones at time t, along x and y. */
    Vector
    net_force(const double t) const;

    bool            inertia = false;
    TimeIntegration integration;

    const Scene                        *scene = nullptr;
    const BackgroundMesh               *mesh  = nullptr;
    const Space                        *space = nullptr;
    std::unique_ptr<Constraints>        constraints;
    std::unique_ptr<ObstacleContact>    obstacles;
    std::unique_ptr<Loads>              loads;
    std::unique_ptr<AbsorbingBoundary>  absorbing;
    std::unique_ptr<IncrementalProblem> problem;
    std::unique_ptr<LinearSystem>       system;
    bool                                begun = false;
    FadingForces                        fading; ///< along x and y
    Vector                              lumped_mass;
    Vector                              weight_per_g;
    Vector                              force;
    Vector velocity_L; ///< along turned dofs: v^n, or Newmark's prediction
  };
} // namespace geocone::GEOCONE_DIM

#endif
