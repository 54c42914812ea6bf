// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_stepper_h
#define geocone_implicit_implicit_stepper_h

#include <geocone/conditions/constraints.h>
#include <geocone/contact/obstacle_contact.h>
#include <geocone/implicit/ramped_forces.h>
#include <geocone/implicit/scaled_loads.h>
#include <geocone/implicit/time_integration.h>
#include <geocone/problem/pressure_functions.h>
#include <geocone/scene/drainage.h>
#include <geocone/terms/absorbing_boundary.h>
#include <geocone/terms/pore_pressures.h>
#include <geocone/time_stepping/time_stepper.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Base class of implicit time steppers with fixed quadrature points
   * (ImplicitFEM) or material points (ImplicitMPM). A step sets up the
   * IncrementalProblem, calls the solver, and computes the momentum and energy
   * balances after acceptance. Derived classes define points, mass, loads and
   * the motion of points.
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

    const LinearSolver &
    linear_solver() const final
    {
      return system->linear_solver();
    }

    std::size_t
    n_nonzeros() const final
    {
      return system->n_nonzeros();
    }

    bool
    consolidates() const final
    {
      return flow != nullptr;
    }

    const std::vector<RigidMotion> &
    moved_obstacles() const final
    {
      return obstacles->moved();
    }

  protected:
    /** Constructor. @param section timer section for loads and for the update
     *  after a step */
    explicit ImplicitStepper(const char *section)
      : section(section)
    {}

    /** Objects and tolerance used to solve the incremental problem of a
     *  step. */
    struct Solving
    {
      const NonsmoothNewton &newton;
      Freezer               &freezer;
      dealii::TimerOutput   &timer;
      const double           accepted_excess; ///< see NonsmoothNewton::Hints
    };

    /** Work done by nodal forces in a step, split by contribution (J/m). */
    struct WorksOnNodes
    {
      double of_weight; ///< weight with a potential energy
      double of_others; ///< loads, supports, dashpots, contact
    };

    /** @name Steps */
    /** @{ */

    /** Activates the boundary conditions of a loading stage. Collective. */
    virtual void
    begin_stage(const Stage &stage);

    /** Sets up the data of a step that depend only on the state at t_n: mass,
     *  unknowns, incremental problem and sparsity pattern. Collective.
     *  @throws InputError or StepFailure if the problem cannot be set up */
    virtual void
    begin(MaterialPoints &points, dealii::TimerOutput &timer) = 0;

    /** Returns true if external forces act on the body. */
    virtual bool
    has_force() const = 0;

    /** Evaluates the external nodal forces at time t along the coordinate axes.
     *  Ramped forces are not included.
     *  @param dst overwritten @param stage,scaled as in Loads::evaluate() */
    virtual void
    evaluate_force(Vector               &dst,
                   const MaterialPoints &points,
                   const double          t,
                   const Stage          *stage  = nullptr,
                   const bool            scaled = false) = 0;

    /** Computes the initial nodal velocity vL and assembles the constraints H v
     *  = q of the step.
     *  @param prescribed velocities */
    virtual void
    begin_motion(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points,
                 const Vector         &prescribed) = 0;

    /** Finds the potential contacts with obstacles in a step. Collective. */
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

    /** Computes a trial motion of the material points from the solution v. The
     *  nodal velocities at t + h are v_end.
     *  @return reason for rejection of the solved step, or empty */
    virtual std::string
    try_move(const TimeStep & /* step */,
             const MaterialPoints & /* points */,
             const Vector & /* v_end */,
             const Vector & /* v */)
    {
      return "";
    }

    /** Moves the boundary segments together with the material points after a
     *  step is accepted. */
    virtual void
    accept_move(const TimeStep & /* step */,
                const MaterialPoints & /* points */,
                const Vector & /* v */)
    {}

    /** Returns true if the positions of obstacles are updated after each
     *  step. */
    virtual bool
    moves_obstacles() const
    {
      return true;
    }

    /** Gravity that contributes to the potential energy instead of the external
     *  work (m/s^2). */
    virtual dealii::Tensor<1, dim>
    gravity_of_potential(const double /* t */) const
    {
      return {};
    }

    /** Work done by external forces in a step (J/m). */
    virtual double
    external_work(const WorksOnNodes &works,
                  const TimeStep & /* step */,
                  const MaterialPoints & /* points */) const
    {
      return works.of_others;
    }

    /** Advances the state variables at all points to the end of the step.
     *  @return the dissipation (J/m) */
    virtual double
    update_points(const TimeStep &step, MaterialPoints &points) = 0;

    /** Advances the nodal variables to the end of the step. @return energy
     *  dissipated by ObstacleContact::settle() (J/m) */
    virtual double
    update_nodes(const TimeStep &step,
                 const Vector   &v_end,
                 const Vector   &v,
                 Kinematics     &kinematics) = 0;

    /** Completes an accepted time step. Material points may change cells or
     *  leave the mesh. */
    virtual void
    finish(const TimeStep & /* step */,
           const NonsmoothNewton & /* newton */,
           dealii::TimerOutput & /* timer */,
           Kinematics & /* kinematics */,
           MaterialPoints & /* points */,
           StepReport & /* report */)
    {}
    /** @} */

    /** @name Consolidation */
    /** @{ */

    /** Rejects scenes without consolidation. @throws InputError */
    virtual void
    check_consolidation(const LinearSolverParameters &linear_solver) const;

    /** Adds excess pore pressures to the incremental problem. Collective. */
    void
    add_flow(const MaterialPoints &points,
             PressureFunctions     functions,
             Vector               *at_vertices = nullptr);
    /** @} */

    /** @name Removal and addition of material, with remarks for the log.
     *  Collective. */
    /** @{ */
    virtual void
    remove(const Stage              &stage,
           MaterialPoints           &points,
           std::vector<std::string> &remarks) = 0;
    virtual void
    add(const Stage &stage, MaterialPoints &points, BodyChange &change) = 0;

    /** Updates the nodal variables after material is added or removed. Force
     *  differences at nodes outside the body are set to zero. @param had_mass
     *  whether a dof had mass before the change */
    virtual void
    change_nodes(const std::vector<bool> &had_mass,
                 Kinematics              &kinematics,
                 Vector                  &difference) const = 0;
    /** @} */

    /** Initial velocity of the incremental problem: vL at the beginning of the
     *  step, or Newmark's predictor. */
    const Vector &
    start_velocity() const
    {
      return integration.is_newmark() ? predicted : velocity_L;
    }

    Drainage                            drainage;
    TimeIntegration                     integration;
    const Scene                        *scene = nullptr;
    BackgroundMesh                     *mesh  = nullptr;
    Space                              *space = nullptr;
    std::unique_ptr<Constraints>        constraints;
    std::unique_ptr<ObstacleContact>    obstacles;
    std::unique_ptr<AbsorbingBoundary>  absorbing;
    std::unique_ptr<Bars>               bars; ///< null without structures
    std::unique_ptr<PorePressures>      flow; ///< null without consolidation
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
    /** External minus internal nodal forces at time t along the coordinate
     *  axes. Ramped forces are not included. */
    Vector
    net_force(const MaterialPoints &points, const double t);

    /** Sets the loads, prescribed velocities and potential contacts of a step
     *  in the incremental problem.
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

    /** Adds the work contributions of a solved step and the relative residual
     *  of its energy balance to the step report. The work of contact forces is
     *  included, the plastic dissipation is not; the points are still at
     *  t_n. */
    void
    add_works(const TimeStep       &step,
              const MaterialPoints &points,
              const Vector         &v,
              const Vector         &residual,
              StepReport           &report) const;

    /** Forces of the supports on the body, without those that obstacles exert at
     *  supported nodes. Collective. @param residual in all rows */
    std::vector<Reaction>
    support_reactions(const TimeStep       &step,
                      const MaterialPoints &points,
                      const Vector         &residual) const;

    /** Updates the support displacements and the reactions of the boundary
     *  conditions. */
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
