// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_stepper_h
#define geocone_implicit_implicit_stepper_h

#include <geocone/conditions/constraints.h>
#include <geocone/contact/obstacle_contact.h>
#include <geocone/implicit/fading_forces.h>
#include <geocone/implicit/raised_loads.h>
#include <geocone/implicit/time_integration.h>
#include <geocone/problem/absorbing_boundary.h>
#include <geocone/time_stepping/time_stepper.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Implicit step with fixed quadrature points (ImplicitFEM) or material points
   * (ImplicitMPM): it sets up the IncrementalProblem, has it solved, and
   * computes the balances of an accepted step. Derived classes define points,
   * mass, loads and the motion of points.
   */
  class ImplicitStepper : public TimeStepper
  {
  public:
    StepReport
    advance(Kinematics            &kinematics,
            MaterialPoints        &points,
            const NonsmoothNewton &newton,
            Freezer               &freezer,
            dealii::TimerOutput   &timer,
            const double           t,
            const double           h,
            const double           accepted_excess) final;

    BodyChange
    change_body(const Stage         &stage,
                const double         t,
                dealii::TimerOutput &timer,
                Kinematics          &kinematics,
                MaterialPoints      &points) final;

    unsigned int
    n_unknowns() const final
    {
      return unknowns;
    }

    std::string
    linear_solver_name() const final
    {
      return system->solver_name();
    }

    std::size_t
    n_nonzeros() const final
    {
      return system->n_nonzeros();
    }

    const std::vector<RigidMotion> &
    moved_obstacles() const final
    {
      return obstacles->moved();
    }

  protected:
    /** @param section of the timer: loads, and the update after a solved
     *  step */
    explicit ImplicitStepper(const char *section)
      : section(section)
    {}

    /** Solver, timer and limits of a step. */
    struct Solving
    {
      const NonsmoothNewton &newton;
      Freezer               &freezer;
      dealii::TimerOutput   &timer;
      const double           accepted_excess; ///< see NonsmoothNewton::Hints
    };

    /** Works of a step on the nodes (J/m). */
    struct WorksOnNodes
    {
      double of_weight; ///< of points with a potential energy
      double of_others; ///< loads, supports, dashpots, contact
    };

    /** @name Steps */
    /** @{ */

    /** Lets the conditions of a stage act. Collective. */
    virtual void
    begin_stage(const Stage &stage);

    /** Sets up mass, unknowns, problem and pattern, which depend on t_n only.
     *  Collective.
     *  @throws InputError or StepFailure if there is no such problem */
    virtual void
    begin(MaterialPoints &points, dealii::TimerOutput &timer) = 0;

    /** Whether there are any external forces. */
    virtual bool
    has_force() const = 0;

    /** Evaluates external forces at time t, along x and y, except ramped ones.
     *  @param dst overwritten @param stage,raised as in Loads::evaluate() */
    virtual void
    evaluate_force(Vector               &dst,
                   const MaterialPoints &points,
                   const double          t,
                   const Stage          *stage  = nullptr,
                   const bool            raised = false) = 0;

    /** Sets vL and the rows H v = q of the step. @param prescribed
     *  velocities */
    virtual void
    begin_motion(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points,
                 const Vector         &prescribed) = 0;

    /** Candidates for contact in the step. Collective. */
    virtual ContactStep
    find_contact(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points) = 0;

    /** Solves the step. @param[out] v velocities @param[out] residual R(v) */
    virtual SolverReport
    solve(const TimeStep   &step,
          const Kinematics &kinematics,
          const Solving    &with,
          Vector           &v,
          Vector           &residual) = 0;

    /** Computes the motion of points by v, with the velocities v_end at t + h.
     *  @return reason for rejection of the solved step, or empty */
    virtual std::string
    try_move(const TimeStep & /* step */,
             const MaterialPoints & /* points */,
             const Vector & /* v_end */,
             const Vector & /* v */)
    {
      return "";
    }

    /** Moves boundaries with the points after a step is accepted. */
    virtual void
    accept_move(const TimeStep & /* step */,
                const MaterialPoints & /* points */,
                const Vector & /* v */)
    {}

    /** Whether obstacles change their position. */
    virtual bool
    moves_obstacles() const
    {
      return true;
    }

    /** Gravity (m/s^2) whose work is a change of potential energy. */
    virtual dealii::Tensor<1, dim>
    gravity_of_potential(const double /* t */) const
    {
      return {};
    }

    /** Work of external forces on the points (J/m). */
    virtual double
    external_work(const WorksOnNodes &works,
                  const TimeStep & /* step */,
                  const MaterialPoints & /* points */) const
    {
      return works.of_others;
    }

    /** Updates the state of the points to the end of the step.
     *  @return the dissipation (J/m) */
    virtual double
    update_points(const TimeStep &step, MaterialPoints &points) = 0;

    /** Updates the nodes. @return energy dissipated by
     *  ObstacleContact::settle() (J/m) */
    virtual double
    update_nodes(const TimeStep &step,
                 const Vector   &v_end,
                 const Vector   &v,
                 Kinematics     &kinematics) = 0;

    /** Completes an accepted step, after which points may have changed cells or
     *  left. */
    virtual void
    finish(const TimeStep & /* step */,
           const NonsmoothNewton & /* newton */,
           dealii::TimerOutput & /* timer */,
           Kinematics & /* kinematics */,
           MaterialPoints & /* points */,
           StepReport & /* report */)
    {}
    /** @} */

    /** @name Changes of the body, with remarks as results. Collective. */
    /** @{ */
    virtual void
    remove(const Stage              &stage,
           MaterialPoints           &points,
           std::vector<std::string> &remarks) = 0;
    virtual void
    add(const Stage              &stage,
        MaterialPoints           &points,
        std::vector<std::string> &remarks) = 0;

    /** Updates the nodes after a change of the body, and restricts the change
     *  of forces to its nodes. @param had_mass before it, by dof */
    virtual void
    change_nodes(const std::vector<bool> &had_mass,
                 Kinematics              &kinematics,
                 Vector                  &difference) const = 0;
    /** @} */

    /** Initial velocity of the problem's step: vL, or Newmark's prediction. */
    const Vector &
    start_velocity() const
    {
      return integration.is_newmark() ? predicted : velocity_L;
    }

    TimeIntegration                     integration;
    const Scene                        *scene = nullptr;
    BackgroundMesh                     *mesh  = nullptr;
    Space                              *space = nullptr;
    std::unique_ptr<Constraints>        constraints;
    std::unique_ptr<ObstacleContact>    obstacles;
    std::unique_ptr<AbsorbingBoundary>  absorbing;
    std::unique_ptr<Bars>               bars; ///< null without structures
    std::unique_ptr<IncrementalProblem> problem;
    std::unique_ptr<LinearSystem>       system;
    unsigned int                        unknowns = 0;     ///< of the last step
    bool                                begun    = false; ///< for the next step
    bool                                has_pattern = false; ///< of begin()
    FadingForces                        fading;              ///< along x and y
    Vector                              lumped_mass;
    Vector                              velocity_L; ///< along rotated dofs
    Vector                              force;      ///< along rotated dofs

  private:
    /** External less internal forces at time t, along x and y, except ramped
     *  ones. */
    Vector
    net_force(const MaterialPoints &points, const double t);

    /** Sets up the step of the problem: loads, prescribed velocities, potential
     *  contacts.
     *  @return the loads controlled by a load factor. Collective. */
    RaisedLoads
    begin_step(const TimeStep       &step,
               const Kinematics     &kinematics,
               const MaterialPoints &points,
               dealii::TimerOutput  &timer);

    WorksOnNodes
    works_on_nodes(const TimeStep &step,
                   const Vector   &v,
                   const Vector   &residual) const;

    /** Adds the works of a solved step to the report, except dissipation and
     *  contact, and the defect of the energy identity, with points at t_n. */
    void
    take_works(const TimeStep       &step,
               const MaterialPoints &points,
               const Vector         &v,
               const Vector         &residual,
               StepReport           &report) const;

    /** Updates displacements of supports, and reactions of conditions imposed
     *  on the body. */
    void
    update_supports(const TimeStep        &step,
                    const Vector          &v,
                    Kinematics            &kinematics,
                    std::vector<Reaction> &reactions) const;

    const char *const section;
    Vector            predicted; ///< by Newmark, from vL
  };
} // namespace geocone::GEOCONE_DIM

#endif
