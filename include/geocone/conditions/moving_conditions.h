// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_moving_conditions_h
#define geocone_conditions_moving_conditions_h

#include <geocone/conditions/constraints.h>
#include <geocone/conditions/moving_loads.h>
#include <geocone/points/consistent_integration.h>

#include <optional>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary conditions on particles and on boundary segments that move with the
   * body. Prescribed velocities are imposed as constraints H v = q with Lagrange
   * multipliers, tractions as nodal forces (MovingLoads).
   */
  class MovingConditions
  {
  public:
    /** Collects all boundary conditions that act on moving boundary segments.
     *  @throws InputError if the body has no boundary segment for a condition */
    MovingConditions(const Scene          &scene,
                     const BackgroundMesh &mesh,
                     const Space          &space);

    /** Activates the boundary conditions of a stage. Boundary segments of
     *  inactive conditions move with the body. */
    void
    begin_stage(const std::string &stage)
    {
      is_active = scene.dirichlet.acting_in(stage);
    }

    /** Tractions, which are nodal forces. */
    MovingLoads &
    loads()
    {
      return tractions;
    }

    /** Returns true if a boundary condition is active in the current stage. */
    bool
    is_acting(const unsigned int condition) const
    {
      return is_active[condition];
    }

    /** Checks that each boundary condition on particles selects at least one
     *  particle. Collective.
     *  @throws InputError if a condition selects none */
    void
    check_held_particles(const MaterialPoints &points) const;

    /** Parameters of the velocity transfer from nodes to particles in a step. The
     *  step is solved for v = v^L + part (v_end - v^L); the particle velocity at
     *  the end of the step is f (v_p + N (v_end - v^L)) + (1 - f) N v_end. */
    struct Transfer
    {
      const Vector &velocity_L; ///< v^L, with ghosts (m/s)
      double        flip_part;  ///< FLIP fraction f
      double        part;       ///< theta of the theta-scheme, or 1
      double        t_end;      ///< time at the end of the step (s)
    };

    /**
     * Assembles the velocity constraints H v = q at time t. Collective.
     * @throws StepFailure if a boundary segment has left the mesh
     * @throws InputError for rows without nodes with mass, and for contradictory
     * rows
     */
    void
    make_rows(const MaterialPoints &points,
              const Vector         &prescribed,
              const double          t,
              const Transfer       &transfer,
              Constraints          &constraints) const;

    /**
     * Moves the boundary segments during a time step h. Segments with prescribed
     * velocity move with this velocity at time t, all other segments with the nodal
     * velocities v of nodes with mass. Collective.
     * @param has_mass as in MovingLoads::add_forces()
     */
    void
    move(const NodesWithMass &has_mass,
         const Vector        &v,
         const double         h,
         const double         t);

    /** Boundary segments that limit the soil domain: those normal to a
     *  coordinate axis whose normal velocity is prescribed, and loaded ones with
     *  soil, each once whatever the number of its tractions. */
    SoilBoundary
    soil_boundary() const;

    /** Lower and upper corners of the box around the boundary segments of a
     *  condition.
     *  @pre the condition has boundary segments */
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    box_of(const BoundaryCondition &condition) const;

    /** Returns, for each local node, whether its shape function is nonzero on a
     *  boundary segment with prescribed traction or velocity. Empty without
     *  such segments. Collective. */
    std::vector<bool>
    loaded_nodes() const;

    /**
     * Corrected position of a point that, in the last call to move(), crossed a
     * boundary segment with prescribed normal velocity. Points can cross the
     * segment because the condition is imposed in the mean only. The corrected
     * position is on the segment, or at its end if the point came from beside
     * it. Empty for points that crossed no segment.
     * @param before,after position of the point before and after the step
     */
    std::optional<dealii::Point<dim>>
    return_to_boundary(const dealii::Point<dim> &before,
                       const dealii::Point<dim> &after) const;

    /** Number of points that have penetrated a boundary segment with prescribed
     *  normal velocity, summed over all ranks. Penetrations below a tenth of the
     *  point size are ignored. Collective. */
    unsigned int
    n_penetrated(const MaterialPoints &points) const;

    /** Saves the positions of the boundary segments to a checkpoint, or
     *  restores them from one. */
    void
    state(StateRow &row);

  private:
    /** A boundary condition with prescribed velocity, and its boundary segments. */
    struct PrescribedSide
    {
      unsigned int          condition;
      std::vector<SidePart> panels;
      std::vector<SidePart> before = {}; ///< panels before the last move()
    };

    /** Number of prescribed particles of each boundary condition over all ranks.
     *  In axisymmetric problems, the sum of the circumferences of the particles
     *  (m). Collective. */
    std::vector<double>
    sum_prescribed(const MaterialPoints &points) const;

    /** Shortens the boundary segments of a condition by the value of the
     *  parameter 'Segment shortening'. */
    void
    shorten(const BoundaryCondition &condition,
            std::vector<SidePart>   &panels) const;

    /** @name Constraint rows of prescribed velocities at time t */
    /** @{ */
    void
    add_rows_of_sides(const double t, Multipliers &rows) const;
    void
    add_rows_of_particles(const MaterialPoints &points,
                          const double          t,
                          const Transfer       &transfer,
                          Multipliers          &rows) const;

    /** Adds the shape function values at a position x to the rows of a boundary
     *  condition in the constraint matrix. There is one row per prescribed
     *  velocity component. */
    void
    add_to_row(const unsigned int                                  condition,
               const Imposition::Share                            &share,
               const dealii::Point<dim>                           &x,
               const double                                        t,
               const std::vector<dealii::types::global_dof_index> &nodes,
               const double                                       *values,
               Multipliers                                        &rows) const;

    /** Corrects the right-hand side of the velocity constraint of a particle
     *  for the FLIP transfer. The offset is the difference between N v and the
     *  prescribed velocity for which the particle has the prescribed velocity
     *  after the transfer. */
    void
    add_flip_offsets(const MaterialPoints                               &points,
                     const unsigned int                                  p,
                     const Imposition::Share                            &share,
                     const std::vector<dealii::types::global_dof_index> &nodes,
                     const Transfer &transfer,
                     Multipliers    &rows) const;
    /** @} */

    const Scene          &scene;
    const BackgroundMesh &mesh;
    const Space          &space;
    std::vector<bool>     is_active; ///< per condition of Scene::dirichlet
    std::vector<PrescribedSide> supports;
    MovingLoads                 tractions;
  };
} // namespace geocone::GEOCONE_DIM

#endif
