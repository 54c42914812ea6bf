// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_stepper_h
#define geocone_implicit_implicit_stepper_h

#include <geocone/conditions/constraints.h>
#include <geocone/contact/obstacle_contact.h>
#include <geocone/implicit/ramped_forces.h>
#include <geocone/implicit/scaled_loads.h>
#include <geocone/implicit/time_integration.h>
#include <geocone/problem/absorbing_boundary.h>
#include <geocone/time_stepping/time_stepper.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Implicit step with fixed quadrature points (ImplicitFEM) or material points
   * (ImplicitMPM): sets up the IncrementalProblem, calls the solver, and
   * computes the momentum and energy balances of an accepted step. Derived
   * classes define points, mass, loads and the motion of points.
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
    /** @param section timer section for loads and for the update after a
     *  step */
    explicit ImplicitStepper(const char *section)
      : section(section)
    {}

    /** Solver, timer and accepted error for solving a step. */
    struct Solving
    {
      const NonsmoothNewton &newton;
      Freezer               &freezer;
      dealii::TimerOutput   &timer;
      const double           accepted_excess; ///< see NonsmoothNewton::Hints
    };

    /** Work on the nodes in a step, by contribution (J/m). */
    struct WorksOnNodes
    {
      double of_weight; ///< weight with a potential energy
      double of_others; ///< loads, supports, dashpots, contact
    };

    /** @name Steps */
    /** @{ */

    /** Activates the boundary conditions of a stage. Collective. */
    virtual void
    begin_stage(const Stage &stage);

    /** Sets up the mass, the unknowns, the incremental problem and the sparsity
     *  pattern; all depend on the state at t_n only. Collective.
     *  @throws InputError or StepFailure if the problem cannot be set up */
    virtual void
    begin(MaterialPoints &points, dealii::TimerOutput &timer) = 0;

    /** Whether external forces act. */
    virtual bool
    has_force() const = 0;

    /** Evaluates the external nodal forces at time t along x and y, without
     *  ramped forces.
     *  @param dst overwritten @param stage,scaled as in Loads::evaluate() */
    virtual void
    evaluate_force(Vector               &dst,
                   const MaterialPoints &points,
                   const double          t,
                   const Stage          *stage  = nullptr,
                   const bool            scaled = false) = 0;

    /** Sets the initial velocity vL and the constraints H v = q of the step.
     *  @param prescribed velocities */
    virtual void
    begin_motion(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points,
                 const Vector         &prescribed) = 0;

    /** Finds the potential contacts of the step. Collective. */
    virtual ContactStep
    find_contact(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points) = 0;

    /** Solves the incremental problem of the step. @param[out] v velocities
     *  @param[out] residual R(v) */
    virtual SolverReport
    solve(const TimeStep   &step,
          const Kinematics &kinematics,
          const Solving    &with,
          Vector           &v,
          Vector           &residual) = 0;

    /** Computes a trial motion of the points with v, and with the velocities
     *  v_end at t + h.
     *  @return reason for rejection of the solved step, or empty */
    virtual std::string
    try_move(const TimeStep & /* step */,
             const MaterialPoints & /* points */,
             const Vector & /* v_end */,
             const Vector & /* v */)
    {
      return "";
    }

    /** Moves boundary segments with the points after a step is accepted. */
    virtual void
    accept_move(const TimeStep & /* step */,
                const MaterialPoints & /* points */,
                const Vector & /* v */)
    {}

    /** Whether obstacles move with the steps. */
    virtual bool
    moves_obstacles() const
    {
      return true;
    }

    /** Gravity (m/s^2) included in the potential energy, not in the external
     *  work. */
    virtual dealii::Tensor<1, dim>
    gravity_of_potential(const double /* t */) const
    {
      return {};
    }

    /** Work done by external forces on the points in a step (J/m). */
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

    /** Updates the nodal quantities to the end of the step. @return energy
     *  dissipated by ObstacleContact::settle() (J/m) */
    virtual double
    update_nodes(const TimeStep &step,
                 const Vector   &v_end,
                 const Vector   &v,
                 Kinematics     &kinematics) = 0;

    /** Completes an accepted step; points may change cells or leave the
     *  mesh. */
    virtual void
    finish(const TimeStep & /* step */,
           const NonsmoothNewton & /* newton */,
           dealii::TimerOutput & /* timer */,
           Kinematics & /* kinematics */,
           MaterialPoints & /* points */,
           StepReport & /* report */)
    {}
    /** @} */

    /** @name Removal and addition of material, with remarks for the log.
     *  Collective. */
    /** @{ */
    virtual void
    remove(const Stage              &stage,
           MaterialPoints           &points,
           std::vector<std::string> &remarks) = 0;
    virtual void
    add(const Stage              &stage,
        MaterialPoints           &points,
        std::vector<std::string> &remarks) = 0;

    /** Updates the nodal quantities after a change of the body, and restricts
     *  the force difference to nodes of the body. @param had_mass by dof,
     *  before the change */
    virtual void
    change_nodes(const std::vector<bool> &had_mass,
                 Kinematics              &kinematics,
                 Vector                  &difference) const = 0;
    /** @} */

    /** Initial velocity of the incremental problem: vL, or Newmark's
     *  predictor. */
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
    bool                                has_pattern = false; ///< set by begin()
    RampedForces                        ramped;              ///< in x and y
    Vector                              lumped_mass;
    Vector                              velocity_L; ///< vL, in rotated dofs
    Vector                              force;      ///< in rotated dofs

  private:
    /** External minus internal nodal forces at time t along x and y, without
     *  ramped forces. */
    Vector
    net_force(const MaterialPoints &points, const double t);

    /** Sets up the loads, prescribed velocities and potential contacts of a
     *  step in the incremental problem.
     *  @return loads controlled by a load factor. Collective. */
    ScaledLoads
    begin_step(const TimeStep       &step,
               const Kinematics     &kinematics,
               const MaterialPoints &points,
               dealii::TimerOutput  &timer);

    WorksOnNodes
    works_on_nodes(const TimeStep &step,
                   const Vector   &v,
                   const Vector   &residual) const;

    /** Adds the work of a solved step by contribution (without dissipation and
     *  contact) and the defect of the energy identity to the report; the points
     *  are still at t_n. */
    void
    take_works(const TimeStep       &step,
               const MaterialPoints &points,
               const Vector         &v,
               const Vector         &residual,
               StepReport           &report) const;

    /** Updates the displacements of supports and the reactions of boundary
     *  conditions on the body. */
    void
    update_supports(const TimeStep        &step,
                    const Vector          &v,
                    Kinematics            &kinematics,
                    std::vector<Reaction> &reactions) const;

    const char *const section;
    Vector            predicted; ///< Newmark's predictor from vL
  };
} // namespace geocone::GEOCONE_DIM

#endif
