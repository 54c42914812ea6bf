// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_mpm_h
#define geocone_implicit_implicit_mpm_h

#include <geocone/base/choice.h>
#include <geocone/conditions/moving_conditions.h>
#include <geocone/contact/particle_contact.h>
#include <geocone/implicit/fading_forces.h>
#include <geocone/implicit/following_grid.h>
#include <geocone/implicit/raised_loads.h>
#include <geocone/implicit/time_integration.h>
#include <geocone/points/particles.h>
#include <geocone/points/point_functions.h>
#include <geocone/points/rank_balance.h>
#include <geocone/problem/absorbing_boundary.h>
#include <geocone/time_stepping/time_stepper.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * The implicit material point method. In a step the particles give mass and
   * momentum to the nodes of the background mesh,
   *   m_i = sum_p m_p N_i,   vL_i = sum_p m_p v_p N_i / m_i,
   * the incremental problem is solved for the velocities v of the nodes, and the
   * particles take from them
   *   v_p += sum_i N_i (v_i - vL_i)   (FLIP),   x_p += h sum_i N_i v_i,
   *   V_p *= det(I + h grad v),
   * while their stress turns by the spin h curl(v)/2. Then they are
   * sorted into cells anew, and the mesh is as if it had never moved.
   *
   * Options: PIC and APIC instead of FLIP, advection with the velocity of the
   * particle, a mass that is partly consistent, and the integrations in time of
   * TimeIntegration.
   */
  class ImplicitMPM : public TimeStepper, public dealii::ParameterAcceptor
  {
  public:
    explicit ImplicitMPM(const ParameterFile &file);

    bool
    has_inertia() const override
    {
      return true;
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
      return unknowns;
    }

    bool
    has_moving_points() const override
    {
      return advection != Advection::none;
    }

    bool
    points_may_leave() const override
    {
      return particles.may_leave();
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

    unsigned int
    n_lost() const override
    {
      return particles.n_lost();
    }

    unsigned int
    n_repartitions() const override
    {
      return balance.n_repartitions();
    }

    /** Where its particles come from. */
    Seeding &
    seeding()
    {
      return particles.seeds();
    }

  private:
    void
    take_points(const Archive &archive, MaterialPoints &points) override;

    /** Where Newton's method may start. */
    enum class Start
    {
      automatic, ///< both, one after the other
      nodes,     ///< the velocities of the nodes after the last step
      particles  ///< vL, with the elastic tangent first
    };

    /** What moves the particles. */
    enum class Advection
    {
      grid_velocity,
      particle_velocity,
      none
    };

    /** A particle after the step. */
    struct Moved
    {
      dealii::Point<dim>             position;
      dealii::Tensor<1, dim>         displacement; ///< of the step
      dealii::Tensor<1, dim>         velocity;
      dealii::Tensor<2, dim>         affine;
      double                         volume;
      dealii::Tensor<1, n_rotations> spin; ///< angles of rotation (rad)
    };

    /** Makes what depends on which rank has which cells. Collective. */
    void
    set_up(const NonsmoothNewton &newton);

    /** Whether the ranks have too unequal numbers of the points. Collective. */
    bool
    is_unbalanced(const MaterialPoints &points) const;

    /** Hands over cells between the ranks: set_up() is to follow. Collective. */
    void
    hand_over(MaterialPoints &points);

    /** The same in the course of a run, with all that is state. Collective. */
    void
    hand_over_state(const NonsmoothNewton &newton,
                    dealii::TimerOutput   &timer,
                    Kinematics            &kinematics,
                    MaterialPoints        &points);

    /** @name The state of nodes, sides and obstacles. Collective. */
    /** @{ */
    void
    save_grid(Archive &archive) const;
    void
    load_grid(const Archive &archive);
    /** @} */

    /** Mass, vL, unknowns and pattern: all that depends on t_n only. */
    void
    begin(MaterialPoints &points, dealii::TimerOutput &timer);

    /** Stencils of ghost stiffness for the points as they are. Collective. */
    std::vector<GhostStencil>
    ghost_stencils(const MaterialPoints &points);

    /** @throws InputError where the grid cannot follow */
    void
    begin_to_follow();

    /** Lets the grid go where its side is. Collective. */
    void
    follow_side();

    /** Refuses what contact cannot do with particles. @throws InputError */
    void
    check_contact(const MaterialPoints &points) const;

    /** Refuses what bodies that touch cannot do. @throws InputError */
    void
    check_bodies() const;

    /** Why a step must not be taken, though it is solved; or nothing. */
    std::string
    objection(const Multipliers::LightShare &share) const;

    /** Adds what water at rest exerts on the soil. Collective. */
    void
    add_water(const MaterialPoints &points, const double t);

    /** External forces less the internal ones at time t, but for those that fade. */
    Vector
    net_force(const MaterialPoints &points, const double t);

    /** External forces at time t, but for those that fade. @param stage,raised as in
     *  Loads::evaluate() */
    void
    evaluate_force(const MaterialPoints &points,
                   const double          t,
                   const Stage          *stage  = nullptr,
                   const bool            raised = false);

    /** The velocity that the problem's step begins from: vL, or Newmark's prediction. */
    const Vector &
    start_velocity() const
    {
      return integration.is_newmark() ? predicted : velocity_L;
    }

    /** vL from momentum, where the mass is partly consistent. */
    void
    solve_mass(Vector &velocity) const;

    /**
     * Where the particles go by the node velocities v (at t_n + h) from vL,
     * advected by v_mean.
     * @return why they may not, or nothing
     */
    std::string
    transfer(const MaterialPoints &points,
             const Vector         &v,
             const Vector         &v_mean,
             const double          h,
             std::vector<Moved>   &moved) const;

    /** Solves the step from each start, until one of them leads to the end.
     *  @param[out] v velocities @param[out] residual R(v) */
    SolverReport
    solve(const TimeStep        &step,
          const Kinematics      &kinematics,
          const NonsmoothNewton &newton,
          NonsmoothNewton::Hints hints,
          Freezer               &freezer,
          dealii::TimerOutput   &timer,
          Vector                &v,
          Vector                &residual);

    /** Gives the problem the step: loads, prescribed velocities and rows, what
     *  touches. @return the loads that it raises. Collective. */
    RaisedLoads
    begin_step(const TimeStep       &step,
               const MaterialPoints &points,
               dealii::TimerOutput  &timer);

    /** Works of a step on the nodes (J/m). */
    struct WorksOnNodes
    {
      double of_weight;
      double of_others; ///< tractions and supports
    };
    WorksOnNodes
    works_on_nodes(const TimeStep &step,
                   const Vector   &v,
                   const Vector   &residual) const;

    /** Works of a solved step but for the dissipation, contact, and the defect of
     *  the energy identity, for the report; of points as they were at t_n. */
    void
    take_works(const TimeStep           &step,
               const MaterialPoints     &points,
               const std::vector<Moved> &moved,
               const Vector             &v,
               const Vector             &residual,
               StepReport               &report) const;

    /** What gravity that changes in the step does to points at rest (J/m). */
    double
    work_of_changing_gravity(const TimeStep       &step,
                             const MaterialPoints &points) const;

    /** What the weight does to points that stay while others move: their potential
     *  energy does not change, as with FEM (J/m). */
    double
    work_on_fixed_points(const TimeStep           &step,
                         const MaterialPoints     &points,
                         const std::vector<Moved> &moved) const;

    /** Puts points back to the sides that are held, MovingConditions::put_back(): how
     *  many of all ranks, and how far at most (m). Collective. */
    std::pair<unsigned int, double>
    put_points_back(const MaterialPoints &points,
                    std::vector<Moved>   &moved) const;

    /** The largest coordinates of points (m). */
    dealii::Point<dim>
    front_of(const MaterialPoints &points) const;

    /** Gives the points their state at the end of the step.
     *  @return the dissipation (J/m) */
    double
    update_points(const TimeStep           &step,
                  const std::vector<Moved> &moved,
                  MaterialPoints           &points) const;

    /** Displacements of what conditions hold, and reactions of those that are
     *  imposed on the body. */
    void
    update_supports(const TimeStep        &step,
                    const Vector          &v,
                    Kinematics            &kinematics,
                    std::vector<Reaction> &reactions) const;

    /** The condition that holds a particle by itself, or null. */
    const BoundaryCondition *
    holder_of(const MaterialPoints &points, const unsigned int p) const;

    void
    check_parameters();

    ParticleTransfer rule;

    Choice<Advection> advection = {
      {{"grid velocity", Advection::grid_velocity},
       {"particle velocity", Advection::particle_velocity},
       {"none", Advection::none}}};
    TimeIntegration integration;
    Choice<Start>   start_asked = {{{"automatic", Start::automatic},
                                    {"grid velocity", Start::nodes},
                                    {"particle velocity", Start::particles}}};

    /** Which light functions have ghost stiffness. */
    enum class Ghosts
    {
      loaded, ///< those that a side reaches that is held or loaded
      all
    };
    Choice<Ghosts> ghosts = {
      {{"loaded sides", Ghosts::loaded}, {"all", Ghosts::all}}};

    double consistent_mass        = 0.;
    bool   consistent_integration = true;
    double ghost_part             = 1e-5; ///< gamma of GhostStiffness
    double largest_move           = 3.;

    std::string                  grid_follows; ///< a condition, or nothing
    std::optional<FollowingGrid> following;
    bool nodes_moved = false; ///< since the constraints were made

    Particles   particles;
    RankBalance balance;

    unsigned int n_light = 0; ///< light functions of the present points

    const Scene       *scene = nullptr;
    BackgroundMesh    *mesh  = nullptr;
    Space             *space = nullptr;
    std::vector<Start> starts; ///< to be tried in this order
    dealii::Point<dim> datum;  ///< of the potential energy

    std::unique_ptr<MovingConditions>   moving;
    std::unique_ptr<ObstacleContact>    obstacles;
    std::optional<ParticleBodies>       bodies; ///< where there are contacts
    std::unique_ptr<AbsorbingBoundary>  absorbing;
    std::unique_ptr<Constraints>        constraints;
    std::optional<GhostPlaces>          ghost_places; ///< of splines that move
    std::unique_ptr<IncrementalProblem> problem;
    std::unique_ptr<LinearSystem>       system;
    unsigned int                        unknowns    = 0; ///< of the last step
    bool                                begun       = false;
    bool                                has_pattern = false; ///< of begin()
    Vector                              lumped_mass;
    Vector                              velocity_L;
    Vector                              predicted; ///< by Newmark, from vL
    Vector                              force;
    std::vector<bool>                   had_mass; ///< nodes, in the last step
    FadingForces                        fading;
    std::vector<unsigned int>           added; ///< materials, so far
  };
} // namespace geocone::GEOCONE_DIM

#endif
