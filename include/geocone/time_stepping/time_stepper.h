// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_time_stepper_h
#define geocone_time_stepping_time_stepper_h

#include <geocone/base/archive.h>
#include <geocone/contact/obstacle_contact.h>
#include <geocone/newton/nonsmooth_newton.h>
#include <geocone/problem/freezer.h>
#include <geocone/time_stepping/step_record.h>

#include <deal.II/base/timer.h>

namespace geocone::GEOCONE_DIM
{
  /** Everything that a run advances in time, besides the points' state. */
  struct Kinematics
  {
    Vector velocity;     ///< of the nodes at t_n (m/s)
    Vector displacement; ///< of nodes that stay (FEM), since the last reset (m)

    /** Mean displacement of what each condition holds, since the reset (m). */
    std::vector<dealii::Tensor<1, dim>> supports;
  };

  /** Whether particles that move are sound; nothing for points that stay. */
  struct Motion
  {
    unsigned int light_functions = 0;  ///< see GhostPlaces::n_light()
    unsigned int points_behind   = 0;  ///< see MovingConditions::n_behind()
    unsigned int points_put_back = 0;  ///< see MovingConditions::put_back()
    double       put_back        = 0.; ///< how far at most (m)
    double       light_share     = 0.; ///< see Multipliers::light_share()

    /** The largest coordinates of points at the end (m). */
    dealii::Point<dim> front;

    void
    take_worse(const Motion &other)
    {
      light_functions = std::max(light_functions, other.light_functions);
      points_behind   = std::max(points_behind, other.points_behind);
      points_put_back = std::max(points_put_back, other.points_put_back);
      put_back        = std::max(put_back, other.put_back);
      light_share     = std::max(light_share, other.light_share);
    }

    void
    state(StateRow &row)
    {
      row(light_functions,
          points_behind,
          points_put_back,
          put_back,
          light_share,
          front);
    }
  };

  /** What a step came to. Nothing has changed if it did not converge. */
  struct StepReport : StepEnd
  {
    bool         converged = false;
    SolverReport newton;
    Quality      quality;
    Energies     of_lost; ///< of particles that have left the mesh
    Works        works;   ///< of the step

    unsigned int unknowns    = 0;
    unsigned int multipliers = 0; ///< independent rows of H
    unsigned int rows        = 0; ///< rows of H that were given

    /** What shows whether particles that move are sound. */
    Motion motion;

    /** What touches obstacles. */
    ContactReport contact;

    /** By which raised loads are multiplied at its end; 1: none are. */
    double load_factor = 1.;

    /**
     * Defect of the discrete energy identity of the step on the grid,
     *   dE_kin + dE_el + sum V s'(-z) + |v - vL|_M^2/2 + sum V ds'S ds/2 = work,
     * relative to its largest term.
     */
    double identity_error = 0.;

    void
    state(StateRow &row)
    {
      StepEnd::state(row);
      row(converged,
          newton,
          quality,
          of_lost,
          works,
          unknowns,
          multipliers,
          rows,
          motion,
          contact,
          load_factor,
          identity_error);
    }
  };

  /** What became of the body at the beginning of a stage. */
  struct BodyChange
  {
    std::vector<std::string> remarks;
    Energies                 before, after; ///< what is there of them
  };

  /** By number what each material becomes in a stage, itself or another one. */
  std::vector<unsigned int>
  materials_after(const Stage &stage, const Materials &materials);

  /** Points of materials that become others do: with their stresses, from which their
   *  histories begin, and by their volumes. Collective.
   *  @return remarks @throws StepFailure if there is none of a material */
  std::vector<std::string>
  change_materials(const Stage    &stage,
                   const Scene    &scene,
                   const Space    &space,
                   const MPI_Comm  comm,
                   MaterialPoints &points);

  /** @throws InputError for what a scene around an axis cannot have */
  void
  check_round_body(const Scene &scene);

  /** Energies::elastic over the points of all ranks (J/m). */
  double
  elastic_energy(const MaterialPoints &points,
                 const Materials      &materials,
                 const MPI_Comm        comm);

  /** @name Values at the nodes, as part of a checkpoint. Collective. */
  /** @{ */
  void
  save_nodes(Archive              &archive,
             const std::string    &name,
             const BackgroundMesh &mesh,
             const Space          &space,
             const Vector         &values);
  void
  load_nodes(const Archive        &archive,
             const std::string    &name,
             const BackgroundMesh &mesh,
             const Space          &space,
             Vector               &values);
  /** @} */

  /** Largest cumulative plastic strain of the points of all ranks. */
  double
  largest_plastic_strain(const MaterialPoints &points, const MPI_Comm comm);

  /** Identity defect of the last step that a problem solved. Collective. */
  double
  energy_identity_error(const IncrementalProblem &problem,
                        const MaterialPoints     &points,
                        const Materials          &materials,
                        const Vector             &velocity_L,
                        const Vector             &v,
                        const double              work);

  /**
   * The part of the plastic work of the last step that a problem solved which becomes
   * kinetic energy, v'M(v - vL)/sum V s:de^p, also of free obstacles. In creep towards a new equilibrium it is next to nothing; of a slope
   * that flows it is what its factor of safety lacks, 1 - F. Collective.
   */
  double
  accelerating_share(const IncrementalProblem &problem,
                     const MaterialPoints     &points,
                     const Materials          &materials,
                     const Vector             &velocity_L,
                     const Vector             &v);

  /**
   * Advances a scene in time, for one of the methods. The only place where state
   * changes, and only when a step is accepted.
   */
  class TimeStepper
  {
  public:
    virtual ~TimeStepper() = default;

    /** Whether there is inertia; without it no mass is assembled. */
    virtual bool
    has_inertia() const = 0;

    /**
     * Allocates what steps need, and makes the points and the motion at t = 0.
     * @return a warning or nothing
     * @throws InputError
     */
    virtual std::string
    prepare(const Scene           &scene,
            BackgroundMesh        &mesh,
            Space                 &space,
            const NonsmoothNewton &newton,
            dealii::TimerOutput   &timer,
            Kinematics            &kinematics,
            MaterialPoints        &points) = 0;

    /** Kinetic, elastic and potential energy at time t. Collective. */
    virtual Energies
    state_energies(const Kinematics     &kinematics,
                   const MaterialPoints &points,
                   const double          t) const = 0;

    /** Tries the step from t to t + h; commits it if it converges.
     *  @param accepted_excess see NonsmoothNewton::Hints */
    virtual StepReport
    advance(Kinematics            &kinematics,
            MaterialPoints        &points,
            const NonsmoothNewton &newton,
            Freezer               &freezer,
            dealii::TimerOutput   &timer,
            const double           t,
            const double           h,
            const double           accepted_excess) = 0;

    /** Takes away and adds what a stage says, at its beginning at time t.
     *  @throws StepFailure if that is nothing, or all */
    virtual BodyChange
    change_body(const Stage         &stage,
                const double         t,
                dealii::TimerOutput &timer,
                Kinematics          &kinematics,
                MaterialPoints      &points) = 0;

    /** Lets displacements and plastic strains count from now. */
    void
    reset(Kinematics &kinematics, MaterialPoints &points) const;

    /** @name The state but for the motion (Kinematics), as part of a checkpoint.
     *  Collective. */
    /** @{ */
    virtual void
    save(Archive &archive, const MaterialPoints &points) = 0;

    /** In place of what prepare() has made.
     *  @throws RunError if it does not fit */
    virtual void
    load(const Archive &archive, MaterialPoints &points) = 0;
    /** @} */

    /** Takes the points of another run's checkpoint, at rest, in place of what prepare()
     *  has made; not what moved them, nor their displacements and plastic strains.
     *  Collective. @throws RunError if it does not fit */
    void
    begin_from(const Archive  &archive,
               Kinematics     &kinematics,
               MaterialPoints &points);

    virtual unsigned int
    n_unknowns() const = 0;

    virtual std::string
    linear_solver_name() const = 0;

    /** Entries of the Jacobian on this rank. */
    virtual std::size_t
    n_nonzeros() const = 0;

    /** Whether points move through the mesh. */
    virtual bool
    has_moving_points() const
    {
      return false;
    }

    /** Whether points may leave the mesh, which are then counted. */
    virtual bool
    points_may_leave() const
    {
      return false;
    }

    /** What the obstacles of the scene have moved, one by one. */
    virtual const std::vector<RigidMotion> &
    moved_obstacles() const = 0;

    /** Points that left the mesh. */
    virtual unsigned int
    n_lost() const
    {
      return 0;
    }

    /** How often cells were handed over between ranks. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

  private:
    /** Takes the points of a checkpoint of any run. Collective. */
    virtual void
    take_points(const Archive &archive, MaterialPoints &points) = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
