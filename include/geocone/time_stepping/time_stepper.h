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
  /** Velocities and displacements advanced in time, in addition to the state of
   *  the points. */
  struct Kinematics
  {
    Vector velocity;     ///< nodal velocity at t_n (m/s)
    Vector displacement; ///< nodal (FEM), since the last reset (m)

    /** Mean displacement (m) of the support of each boundary condition since
     *  the last reset. */
    std::vector<dealii::Tensor<1, dim>> supports;
  };

  /** Diagnostics of a time step that are available only for moving material
   *  points. */
  struct Motion
  {
    unsigned int light_functions = 0;  ///< see GhostPlaces::n_light()
    unsigned int points_behind   = 0;  ///< see MovingConditions::n_penetrated()
    unsigned int points_returned =
      0; ///< see MovingConditions::return_to_boundary()
    double       returned_by     = 0.; ///< largest distance (m)
    double       low_mass_share  = 0.; ///< see Multipliers::low_mass_share()

    /** Largest coordinates of all points at the end of the step (m). */
    dealii::Point<dim> front;

    void
    take_worse(const Motion &other)
    {
      light_functions = std::max(light_functions, other.light_functions);
      points_behind   = std::max(points_behind, other.points_behind);
      points_returned = std::max(points_returned, other.points_returned);
      returned_by     = std::max(returned_by, other.returned_by);
      low_mass_share  = std::max(low_mass_share, other.low_mass_share);
    }

    void
    state(StateRow &row)
    {
      row(light_functions,
          points_behind,
          points_returned,
          returned_by,
          low_mass_share,
          front);
    }
  };

  /** Result of an implicit step. Without convergence, the state is
   *  unchanged. */
  struct StepReport : StepEnd
  {
    bool         converged = false;
    SolverReport newton;
    Quality      quality;
    Energies     of_lost; ///< energies of particles that left the mesh
    Works        works;   ///< work in the step
    WaterBalance water;   ///< of consolidating soil

    unsigned int unknowns    = 0;
    unsigned int multipliers = 0; ///< independent rows of H
    unsigned int rows        = 0; ///< all rows of H

    /** Diagnostics of the material points in a step (StepReport). */
    Motion motion;

    /** Report on contact with obstacles in the step. */
    ContactReport contact;

    /** States of the bars and plates of all structures, in the order of the
     *  scene. */
    std::vector<BarState>   bars;
    std::vector<PlateState> plates;

    /** Load factor at the end of the step. Without load stepping it is 1. */
    double load_factor = 1.;

    /**
     * Relative residual of the energy balance of a step, in discrete form on
     * the grid. The identity is
     *   dE_kin + dE_el + sum V s'(-z) + |v - vL|_M^2/2 + sum V ds'S ds/2 = work
     * The residual is divided by the largest term.
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
          water,
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

  /** Result of the removal and addition of material at the beginning of a
   *  stage. */
  struct BodyChange
  {
    std::vector<std::string> remarks, warnings;
    Energies                 before, after; ///< energies of the body (J/m)
  };

  /** Returns, for each material, the index of the material that replaces it in
   *  a stage. Other materials retain their index. */
  std::vector<unsigned int>
  materials_after(const Stage &stage, const Materials &materials);

  /** Replaces the materials of points as specified by a stage of the loading
   *  programme. History variables are initialised from the stresses, masses
   *  computed from the volumes. Collective.
   *  @return remarks @throws StepFailure if a material to be replaced has no
   *  points */
  std::vector<std::string>
  change_materials(const Stage    &stage,
                   const Scene    &scene,
                   const Space    &space,
                   const MPI_Comm  comm,
                   MaterialPoints &points);

  /** Checks that the scene has only features that are available in axisymmetry.
   *  @throws InputError */
  void
  check_axisymmetric_body(const Scene &scene);

  /** Returns the elastic energy summed over the points of all ranks (J/m), for
   *  Energies::elastic. Collective. */
  double
  elastic_energy(const MaterialPoints &points,
                 const Materials      &materials,
                 const MPI_Comm        comm);

  /** @name Nodal values as part of a checkpoint. Collective. */
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

  /** Returns the maximum accumulated plastic strain over the points of all
   *  ranks. Collective. */
  double
  largest_plastic_strain(const MaterialPoints &points, const MPI_Comm comm);

  /** Returns the relative residual of the discrete energy balance
   *  (StepReport::identity_error) in the last step. Collective. */
  double
  energy_identity_error(const IncrementalProblem &problem,
                        const MaterialPoints     &points,
                        const Materials          &materials,
                        const Vector             &velocity_L,
                        const Vector             &v,
                        const double              work);

  /**
   * Returns the ratio of kinetic energy gain to plastic work in the last step.
   * The ratio is v'M(v - vL)/sum V s:de^p, including free obstacles. It almost
   * vanishes in creep towards a new equilibrium; for a failing slope it equals
   * the deficit 1 - F of the factor of safety F. Collective.
   */
  double
  accelerating_share(const IncrementalProblem &problem,
                     const MaterialPoints     &points,
                     const Materials          &materials,
                     const Vector             &velocity_L,
                     const Vector             &v);

  /**
   * Abstract interface of implicit time stepping, for FEM and MPM. Only a time
   * stepper changes the state, and only if a step is accepted.
   */
  class TimeStepper
  {
  public:
    virtual ~TimeStepper() = default;

    /** Returns true if the equations of motion include inertia. Otherwise no
     *  mass matrix is assembled. */
    virtual bool
    has_inertia() const = 0;

    /**
     * Allocates data for time steps and initialises the points and the
     * kinematics at t = 0.
     * @return a warning, or an empty string
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

    /** Returns the kinetic, elastic and potential energy of the body at time t.
     *  Collective. */
    virtual Energies
    state_energies(const Kinematics     &kinematics,
                   const MaterialPoints &points,
                   const double          t) const = 0;

    /** Attempts a step from time t to time t + h. The state is updated if the
     *  step converges.
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
     *  @throws StepFailure if no material is removed, or all material */
    virtual BodyChange
    change_body(const Stage         &stage,
                const double         t,
                dealii::TimerOutput &timer,
                Kinematics          &kinematics,
                MaterialPoints      &points) = 0;

    /** Sets displacements and accumulated plastic strains to zero. */
    void
    reset(Kinematics &kinematics, MaterialPoints &points) const;

    /** @name State except the kinematics, as part of a checkpoint.
     *  Collective. */
    /** @{ */
    virtual void
    save(Archive &archive, const MaterialPoints &points) = 0;

    /** Replaces the state initialised in prepare() with the state in a
     *  checkpoint.
     *  @throws RunError if the checkpoint does not match the scene */
    virtual void
    load(const Archive &archive, MaterialPoints &points) = 0;
    /** @} */

    /** Replaces the points initialised in prepare() with the points in a
     *  checkpoint of another run. The points are at rest, without displacements
     *  and plastic strains; moving boundaries and obstacles are not read.
     *  Collective.
     *  @throws RunError if the checkpoint does not match the scene */
    void
    begin_from(const Archive  &archive,
               Kinematics     &kinematics,
               MaterialPoints &points);

    virtual unsigned int
    n_unknowns() const = 0;

    virtual const LinearSolver &
    linear_solver() const = 0;

    /** Returns the number of nonzero (stored) entries of the Jacobian on this
     *  rank. */
    virtual std::size_t
    n_nonzeros() const = 0;

    /** Returns true if the points move relative to the mesh. */
    virtual bool
    has_moving_points() const
    {
      return false;
    }

    /** Returns true if points may leave the mesh. The function n_lost() counts
     *  these points. */
    virtual bool
    points_may_leave() const
    {
      return false;
    }

    /** Returns true if excess pore pressures are unknowns of the steps. */
    virtual bool
    consolidates() const
    {
      return false;
    }

    /** Returns the rigid-body motion of each obstacle of the scene. */
    virtual const std::vector<RigidMotion> &
    moved_obstacles() const = 0;

    /** Returns the number of points that have left the mesh since the start of
     *  the run. */
    virtual unsigned int
    n_lost() const
    {
      return 0;
    }

    /** Returns how many times the cells were redistributed over the ranks. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

  private:
    /** Replaces the points with the points in a checkpoint of any run.
     *  Collective. */
    virtual void
    take_points(const Archive &archive, MaterialPoints &points) = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
