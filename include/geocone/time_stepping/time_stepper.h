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
  /** State advanced in time, besides the points' state. */
  struct Kinematics
  {
    Vector velocity;     ///< of the nodes at t_n (m/s)
    Vector displacement; ///< of fixed nodes (FEM), since the last reset (m)

    /** Mean displacement of the support of each condition, since the reset
     *  (m). */
    std::vector<dealii::Tensor<1, dim>> supports;
  };

  /** Diagnostics of material points; unused with fixed quadrature points. */
  struct Motion
  {
    unsigned int light_functions = 0;  ///< see GhostPlaces::n_light()
    unsigned int points_behind   = 0;  ///< see MovingConditions::n_behind()
    unsigned int points_put_back = 0;  ///< see MovingConditions::put_back()
    double       put_back        = 0.; ///< largest distance (m)
    double       light_share     = 0.; ///< see Multipliers::light_share()

    /** Largest coordinates of points at the end (m). */
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

  /** Result of a step. Without convergence, no state has changed. */
  struct StepReport : StepEnd
  {
    bool         converged = false;
    SolverReport newton;
    Quality      quality;
    Energies     of_lost; ///< of particles that have left the mesh
    Works        works;   ///< of the step

    unsigned int unknowns    = 0;
    unsigned int multipliers = 0; ///< independent rows of H
    unsigned int rows        = 0; ///< all rows of H

    /** Diagnostics of material points. */
    Motion motion;

    /** Contact with obstacles. */
    ContactReport contact;

    /** Bars of all structures, and all plates, in their order. */
    std::vector<BarState>   bars;
    std::vector<PlateState> plates;

    /** Load factor at its end; 1 without load stepping. */
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
          bars,
          plates,
          load_factor,
          identity_error);
    }
  };

  /** Result of a change of the body at the beginning of a stage. */
  struct BodyChange
  {
    std::vector<std::string> remarks;
    Energies                 before, after; ///< of the body before and after
  };

  /** Material number of each material after a stage: another one or itself. */
  std::vector<unsigned int>
  materials_after(const Stage &stage, const Materials &materials);

  /** Changes the material of points. Histories are initialised from their
   *  stresses, masses from their volumes. Collective.
   *  @return remarks @throws StepFailure if a material has no points */
  std::vector<std::string>
  change_materials(const Stage    &stage,
                   const Scene    &scene,
                   const Space    &space,
                   const MPI_Comm  comm,
                   MaterialPoints &points);

  /** @throws InputError for features not available in axisymmetric scenes */
  void
  check_round_body(const Scene &scene);

  /** Energies::elastic over the points of all ranks (J/m). */
  double
  elastic_energy(const MaterialPoints &points,
                 const Materials      &materials,
                 const MPI_Comm        comm);

  /** @name Nodal values, as part of a checkpoint. Collective. */
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

  /** Defect of the energy identity in the last step solved with a problem.
   *  Collective. */
  double
  energy_identity_error(const IncrementalProblem &problem,
                        const MaterialPoints     &points,
                        const Materials          &materials,
                        const Vector             &velocity_L,
                        const Vector             &v,
                        const double              work);

  /**
   * Fraction of the plastic work that becomes kinetic energy in the last step
   * solved with a problem, v'M(v - vL)/sum V s:de^p, including free obstacles.
   * It almost vanishes in creep towards a new equilibrium; for a flowing slope
   * it is the deficit 1 - F of its factor of safety. Collective.
   */
  double
  accelerating_share(const IncrementalProblem &problem,
                     const MaterialPoints     &points,
                     const Materials          &materials,
                     const Vector             &velocity_L,
                     const Vector             &v);

  /**
   * Interface for advancing a scene in time by one of the methods. State
   * changes only here, and only when a step is accepted.
   */
  class TimeStepper
  {
  public:
    virtual ~TimeStepper() = default;

    /** Whether there is inertia; otherwise no mass is assembled. */
    virtual bool
    has_inertia() const = 0;

    /**
     * Allocates the data of steps and sets up the points and the motion at t =
     * 0.
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

    /** Attempts the step from t to t + h and commits it if it converges.
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

    /** Removes and adds material at the beginning of a stage at time t.
     *  @throws StepFailure if no material is removed, or all of it */
    virtual BodyChange
    change_body(const Stage         &stage,
                const double         t,
                dealii::TimerOutput &timer,
                Kinematics          &kinematics,
                MaterialPoints      &points) = 0;

    /** Resets displacements and plastic strains to zero. */
    void
    reset(Kinematics &kinematics, MaterialPoints &points) const;

    /** @name State except the motion (Kinematics), as part of a checkpoint.
     *  Collective. */
    /** @{ */
    virtual void
    save(Archive &archive, const MaterialPoints &points) = 0;

    /** Replaces the state set up by prepare().
     *  @throws RunError if it does not fit */
    virtual void
    load(const Archive &archive, MaterialPoints &points) = 0;
    /** @} */

    /** Replaces the points set up by prepare() by those of another run's
     *  checkpoint, at rest, without moving boundaries, obstacles, displacements
     *  and plastic strains. Collective. @throws RunError if it does not fit */
    void
    begin_from(const Archive  &archive,
               Kinematics     &kinematics,
               MaterialPoints &points);

    virtual unsigned int
    n_unknowns() const = 0;

    virtual std::string
    linear_solver_name() const = 0;

    /** Number of entries of the Jacobian on this rank. */
    virtual std::size_t
    n_nonzeros() const = 0;

    /** Whether points move through the mesh. */
    virtual bool
    has_moving_points() const
    {
      return false;
    }

    /** Whether points may leave the mesh; such points are counted. */
    virtual bool
    points_may_leave() const
    {
      return false;
    }

    /** Displacements of the obstacles of the scene, one by one. */
    virtual const std::vector<RigidMotion> &
    moved_obstacles() const = 0;

    /** Number of points that left the mesh. */
    virtual unsigned int
    n_lost() const
    {
      return 0;
    }

    /** Number of redistributions of cells between ranks. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

  private:
    /** Adopts the points of a checkpoint of any run. Collective. */
    virtual void
    take_points(const Archive &archive, MaterialPoints &points) = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
