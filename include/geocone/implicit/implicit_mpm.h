// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_implicit_mpm_h
#define geocone_implicit_implicit_mpm_h

#include <geocone/base/choice.h>
#include <geocone/conditions/moving_conditions.h>
#include <geocone/contact/particle_contact.h>
#include <geocone/implicit/following_grid.h>
#include <geocone/implicit/implicit_stepper.h>
#include <geocone/points/particles.h>
#include <geocone/points/point_functions.h>
#include <geocone/points/rank_balance.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Implicit material point method. In a step the particles transfer mass and
   * momentum to the nodes of the background mesh,
   *   m_i = sum_p m_p N_i,   vL_i = sum_p m_p v_p N_i / m_i,
   * the incremental problem is solved for the velocities v of the nodes, and
   * the particles are updated by
   *   v_p += sum_i N_i (v_i - vL_i)   (FLIP),   x_p += h sum_i N_i v_i,
   *   V_p *= det(I + h grad v),
   * and the particle stresses are rotated by the spin h curl(v)/2. Then the
   * particles are sorted into cells again, and the mesh is reset.
   *
   * Options: PIC and APIC instead of FLIP, advection with the particle
   * velocity, a mass matrix (1 - c) M_lumped + c M_consistent, and the
   * schemes of TimeIntegration.
   */
  class ImplicitMPM : public ImplicitStepper, public dealii::ParameterAcceptor
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

    void
    save(Archive &archive, const MaterialPoints &points) override;
    void
    load(const Archive &archive, MaterialPoints &points) override;

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

    /** Returns the object that seeds the particles. */
    Seeding &
    seeding()
    {
      return particles.seeds();
    }

  private:
    void
    take_points(const Archive &archive, MaterialPoints &points) override;

    /** Choice of the initial guess for the nodal velocities in Newton's
     *  method. */
    enum class Start
    {
      automatic, ///< both, tried in turn
      nodes,     ///< nodal velocities after the last step
      particles  ///< vL; elastic tangent in iteration 1
    };

    /** Choice of the velocity field that advects the particles. */
    enum class Advection
    {
      grid_velocity,
      particle_velocity,
      none
    };

    /** Trial state of a particle at the end of the step. */
    struct Moved
    {
      dealii::Point<dim>             position;
      dealii::Tensor<1, dim>         displacement; ///< in the step (m)
      dealii::Tensor<1, dim>         velocity;
      dealii::Tensor<2, dim>         affine;
      double                         volume;
      dealii::Tensor<1, n_rotations> spin; ///< angles of rotation (rad)
    };

    /** Allocates the data structures that depend on the distribution of cells
     *  over MPI ranks. Collective. */
    void
    set_up(const NonsmoothNewton &newton);

    /** Returns true if the parallel load imbalance, in particles per rank,
     *  exceeds the tolerance. Collective. */
    bool
    is_unbalanced(const MaterialPoints &points) const;

    /** Redistributes the mesh cells over the MPI ranks. Must be followed by
     *  set_up(). Collective. */
    void
    redistribute(MaterialPoints &points);

    /** Redistributes the mesh cells and all state variables over the MPI ranks
     *  during a run. Collective. */
    void
    hand_over_state(const NonsmoothNewton &newton,
                    dealii::TimerOutput   &timer,
                    Kinematics            &kinematics,
                    MaterialPoints        &points);

    /** @name State of nodes, boundary segments and obstacles as part of a
     *  checkpoint. Collective. */
    /** @{ */
    void
    save_grid(Archive &archive) const;
    void
    load_grid(const Archive &archive);
    /** @} */

    void
    check_consolidation(
      const LinearSolverParameters &linear_solver) const override;

    /** Adds the excess pore pressures of consolidating soil to the incremental
     *  problem. Drained are free surfaces of the body, and sides of the mesh
     *  that are named or whose velocity is not prescribed. Collective. */
    void
    add_flow_between(const MaterialPoints &points);

    void
    begin_stage(const Stage &stage) override;

    void
    begin(MaterialPoints &points, dealii::TimerOutput &timer) override;

    /** Computes the stencils of the ghost stiffness, which stabilises low-mass
     *  basis functions, for the current particle positions. Collective. */
    std::vector<GhostStencil>
    ghost_stencils(const MaterialPoints &points);

    /** Warns of tractions where particles move and the stresses that balance them
     *  are not exact. @param k particles per direction of a cell
     *  @throws InputError for undrained soil without B-bar */
    std::string
    check_tractions(const unsigned int k) const;

    /** Nodes with mass in the present step. */
    NodesWithMass
    nodes_with_mass() const
    {
      return [this](const unsigned int node) {
        return constraints->has_mass(dim * node);
      };
    }

    /** Starts to move the grid lines together with a boundary segment.
     *  @throws InputError if the grid cannot follow a segment */
    void
    begin_to_follow();

    /** Moves the grid lines together with a moving boundary segment.
     *  Collective. */
    void
    follow_side();

    /** Rejects options that are not available beside structures.
     *  @throws InputError */
    void
    check_structures() const;

    /** Rejects contact options that are not available for particles.
     *  @throws InputError */
    void
    check_contact(const MaterialPoints &points) const;

    /** Rejects options that are incompatible with contact between bodies of
     *  particles. @throws InputError */
    void
    check_bodies() const;

    /** Reason for rejecting a solved step in which low-mass basis functions
     *  dominate a constraint; empty if the step is accepted. */
    std::string
    rejection(const Multipliers::LowMassShare &share) const;

    bool
    has_force() const override
    {
      return true;
    }

    void
    evaluate_force(Vector               &dst,
                   const MaterialPoints &points,
                   const double          t,
                   const Stage          *stage,
                   const bool            scaled) override;

    /** Adds the nodal forces of hydrostatic water pressure on the soil to the
     *  vector dst. Collective. */
    void
    add_water(const MaterialPoints &points, const double t, Vector &dst) const;

    /** Adds the nodal forces of the suction stress at point p to the vector dst.
     *  @param part of the full gravity
     *  @param parts of the flows at this time */
    void
    add_suction(const MaterialPoints      &points,
                const unsigned int         p,
                const PointFunctions      &at,
                const double               part,
                const std::vector<double> &parts,
                Vector                    &dst) const;

    void
    begin_motion(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points,
                 const Vector         &prescribed) override;

    ContactStep
    find_contact(const TimeStep       &step,
                 const Kinematics     &kinematics,
                 const MaterialPoints &points) override;

    std::string
    try_move(const TimeStep       &step,
             const MaterialPoints &points,
             const Vector         &v_end,
             const Vector         &v) override;

    void
    accept_move(const TimeStep       &step,
                const MaterialPoints &points,
                const Vector         &v) override;

    bool
    moves_obstacles() const override
    {
      return has_moving_points();
    }

    dealii::Tensor<1, dim>
    gravity_of_potential(const double t) const override
    {
      return scene->gravity.at(t);
    }

    /** Work done by external forces in a step (J/m). The potential energy of
     *  fixed particles does not change with the motion of the nodes: as in FEM,
     *  the weight is an external force. A change of gravity does work on points
     *  at rest. */
    double
    external_work(const WorksOnNodes   &works,
                  const TimeStep       &step,
                  const MaterialPoints &points) const override;

    double
    update_points(const TimeStep &step, MaterialPoints &points) override;

    double
    update_nodes(const TimeStep &step,
                 const Vector   &v_end,
                 const Vector   &v,
                 Kinematics     &kinematics) override;

    void
    finish(const TimeStep        &step,
           const NonsmoothNewton &newton,
           dealii::TimerOutput   &timer,
           Kinematics            &kinematics,
           MaterialPoints        &points,
           StepReport            &report) override;

    void
    remove(const Stage              &stage,
           MaterialPoints           &points,
           std::vector<std::string> &remarks) override;
    void
    add(const Stage    &stage,
        MaterialPoints &points,
        BodyChange     &change) override;

    void
    change_nodes(const std::vector<bool> &had_mass,
                 Kinematics              &kinematics,
                 Vector                  &difference) const override;

    /** Solves M vL = (nodal momentum) for the initial nodal velocity vL, with
     *  the mass matrix M = (1 - c) M_lumped + c M_consistent. */
    void
    solve_mass(Vector &velocity) const;

    /** Reason for rejecting the computed motion of a particle; empty if the
     *  motion is accepted. @param ratio volume ratio of the step
     *  @param extent size of the cell (m) */
    std::string
    rejection_of_move(const MaterialPoints          &points,
                      const unsigned int             p,
                      const double                   ratio,
                      const dealii::Tensor<1, dim>  &move,
                      const std::array<double, dim> &extent) const;

    /**
     * Computes the trial states of the particles at the end of the step
     * (positions, velocities) from nodal velocities. These are vL at t_n, v at
     * t_n + h, and v_mean for advection.
     * @return reason for rejection, or empty
     */
    std::string
    transfer(const MaterialPoints &points,
             const Vector         &v,
             const Vector         &v_mean,
             const double          h);

    /** Solves the incremental problem from one initial guess after another
     *  until convergence. */
    SolverReport
    solve(const TimeStep   &step,
          const Kinematics &kinematics,
          const Solving    &with,
          Vector           &v,
          Vector           &residual) override;

    /** Potential energy change due to a change of gravity in a step, for
     *  particles at fixed positions (J/m). */
    double
    work_of_changing_gravity(const TimeStep       &step,
                             const MaterialPoints &points) const;

    /** Work done in a step by the weight of the fixed quadrature points, in a
     *  run that also has particles (J/m). As in FEM, the potential energy does
     *  not include this weight. */
    double
    work_on_fixed_points(const TimeStep       &step,
                         const MaterialPoints &points) const;

    /** Moves particles that have penetrated a prescribed boundary segment back
     *  to the segment. See MovingConditions::return_to_boundary(). */
    void
    put_points_back(const MaterialPoints &points);

    /** Largest coordinate of all particles along each axis (m). */
    dealii::Point<dim>
    largest_coordinates(const MaterialPoints &points) const;

    /** Boundary condition imposed on an individual particle; null if there is
     *  none. */
    const BoundaryCondition *
    condition_of_particle(const MaterialPoints &points,
                          const unsigned int    p) const;

    void
    check_scene(const LinearSolverParameters &linear_solver);

    ParticleTransfer rule;

    Choice<Advection> advection = {
      {{"grid velocity", Advection::grid_velocity},
       {"particle velocity", Advection::particle_velocity},
       {"none", Advection::none}}};
    Choice<Start> start_asked = {{{"automatic", Start::automatic},
                                  {"grid velocity", Start::nodes},
                                  {"particle velocity", Start::particles}}};

    /** Selection of the low-mass basis functions that are stabilised by ghost
     *  stiffness. */
    enum class Ghosts
    {
      loaded, ///< at loaded or prescribed segments
      all
    };
    Choice<Ghosts> ghosts = {
      {{"loaded sides", Ghosts::loaded}, {"all", Ghosts::all}}};

    double consistent_mass        = 0.;
    bool   consistent_integration = true;
    double ghost_part             = 1e-5; ///< gamma of GhostStiffness
    double largest_move           = 3.;

    std::string                  grid_follows; ///< followed condition, or empty
    std::optional<FollowingGrid> following;
    bool        nodes_moved = false; ///< since constraints were set up
    std::string present_stage;       ///< active stage

    Particles   particles;
    RankBalance balance;

    unsigned int n_light = 0; ///< low-mass basis functions

    Vector pore_pressure; ///< excess, at vertices, of consolidating soil

    std::vector<Start> starts; ///< initial guesses in order
    dealii::Point<dim> datum;  ///< datum of the potential energy

    std::unique_ptr<MovingConditions> moving;
    std::optional<ParticleBodies>     bodies;       ///< if in contact
    std::optional<GhostPlaces>        ghost_places; ///< null if not used
    std::vector<bool>                 had_mass;     ///< nodes, in last step
    std::vector<unsigned int>         added;        ///< materials added so far

    /** Trial particle states and statistics of the current attempt at a
     *  step. */
    struct Trial
    {
      std::vector<Moved>      moved;
      Multipliers::LowMassShare share;
      unsigned int              n_returned  = 0; ///< returned points, all ranks
      double                    returned_by = 0.; ///< largest distance (m)
    };
    Trial trial;
  };
} // namespace geocone::GEOCONE_DIM

#endif
