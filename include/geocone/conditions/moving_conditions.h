// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_moving_conditions_h
#define geocone_conditions_moving_conditions_h

#include <geocone/base/state_row.h>
#include <geocone/conditions/constraints.h>
#include <geocone/points/consistent_integration.h>
#include <geocone/surfaces/moving_surface.h>
#include <geocone/surfaces/sides_of_body.h>

#include <optional>

namespace geocone::GEOCONE_DIM
{
  /**
   * Conditions on moving particles and moving boundary segments: prescribed
   * velocities, imposed as rows H v = q with multipliers, and tractions.
   */
  class MovingConditions
  {
  public:
    /** @throws InputError if the body has no such boundary segments */
    MovingConditions(const Scene          &scene,
                     const BackgroundMesh &mesh,
                     const Space          &space);

    /** Lets the conditions of a stage act. Segments of the others move with
     *  the body. */
    void
    begin_stage(const std::string &stage)
    {
      acts = scene.dirichlet.acting_in(stage);
    }

    /** Whether a condition acts. */
    bool
    is_acting(const unsigned int condition) const
    {
      return acts[condition];
    }

    /** @throws InputError if a condition selects no particle. Collective. */
    void
    check_held_particles(const MaterialPoints &points) const;

    /**
     * Adds the tractions at time t. Collective.
     * @param stage,raised as in Loads::evaluate()
     * @throws StepFailure if a boundary segment has left the mesh
     */
    void
    add_tractions(Vector      &force,
                  const double t,
                  const Stage *stage  = nullptr,
                  const bool   raised = false) const;

    /** Transfer from nodes to particles in a step. It solves for v = v^L + part
     *  (v_end - v^L); the particle velocity at the end of the step is f (v_p +
     *  N (v_end - v^L)) + (1 - f) N v_end. */
    struct Transfer
    {
      const Vector &velocity_L; ///< with ghost values
      double        flip_part;  ///< f
      double        part;       ///< theta of the theta-scheme, or 1
      double        t_end;
    };

    /**
     * Assembles the rows H v = q, with q at time t. Collective.
     * @throws StepFailure if a boundary segment has left the mesh
     * @throws InputError for rows that have no support in the grid or
     * contradict each other
     */
    void
    make_rows(const MaterialPoints &points,
              const Vector         &prescribed,
              const double          t,
              const Transfer       &transfer,
              Constraints          &constraints) const;

    /**
     * Moves the boundary segments over a step h: those with prescribed velocity
     * by the velocity at time t, others by that of the nodes. Collective.
     */
    void
    move(const Vector &v, const double h, const double t);

    /** Segments normal to an axis with prescribed normal velocity, at which the
     *  soil ends. */
    std::vector<SoilLimit>
    soil_limits() const;

    /** Corners of the bounding box of the boundary segments of a condition.
     *  @pre it has boundary segments */
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    box_of(const BoundaryCondition &condition) const;

    /** Whether the shape function of each local node is nonzero on a loaded or
     *  prescribed boundary segment; empty without such segments. Collective. */
    std::vector<bool>
    loaded_nodes() const;

    /**
     * Returns a point to the boundary if it has crossed a segment with
     * prescribed normal velocity; possible because the condition is imposed in
     * the mean only. The new position is on the segment, or at its end if the
     * point came from beside it. Empty for points that crossed none in the last
     * move().
     * @param before,after position of the point before and after the step
     */
    std::optional<dealii::Point<dim>>
    put_back(const dealii::Point<dim> &before,
             const dealii::Point<dim> &after) const;

    /** Number of points, of all ranks, that lie more than a tenth of their size
     *  beyond a segment with prescribed normal velocity. Collective. */
    unsigned int
    n_behind(const MaterialPoints &points) const;

    /** Positions of the segments, for a checkpoint. */
    void
    state(StateRow &row);

  private:
    /** A support and its boundary segment. */
    struct HeldSide
    {
      unsigned int          condition;
      std::vector<SidePart> panels;
      std::vector<SidePart> before = {}; ///< before the last move()
    };

    /** A load and its boundary segments. */
    struct LoadedSide
    {
      unsigned int  condition;
      MovingSurface surface;
    };

    /** Number of prescribed particles per condition; in axisymmetric problems
     *  the sum of their circumferences (m). All ranks. Collective. */
    std::vector<double>
    sum_held(const MaterialPoints &points) const;

    /** Shortens the segments of a condition by 'Segment shortening'. */
    void
    shorten(const BoundaryCondition &condition,
            std::vector<SidePart>   &panels) const;

    /** @name Rows of supports at time t */
    /** @{ */
    void
    add_rows_of_sides(const double t, Multipliers &rows) const;
    void
    add_rows_of_particles(const MaterialPoints &points,
                          const double          t,
                          const Transfer       &transfer,
                          Multipliers          &rows) const;

    /** Adds a position x, with the shape functions that are nonzero there, to a
     *  row for each prescribed component of a condition. */
    void
    add_to_row(const unsigned int                                  condition,
               const Imposition::Share                            &share,
               const dealii::Point<dim>                           &x,
               const double                                        t,
               const std::vector<dealii::types::global_dof_index> &nodes,
               const double                                       *values,
               Multipliers                                        &rows) const;

    /** Adds to the row of a particle the difference between N v and the
     *  prescribed velocity that gives the particle this velocity by FLIP. */
    void
    add_flip_offsets(const MaterialPoints                               &points,
                     const unsigned int                                  p,
                     const Imposition::Share                            &share,
                     const std::vector<dealii::types::global_dof_index> &nodes,
                     const Transfer &transfer,
                     Multipliers    &rows) const;
    /** @} */

    /** Adds the contribution of a point of a facet to a load.
     *  @param size initial size, on which dead loads act
     *  @param area current outward normal times size */
    void
    add_traction(const BoundaryCondition      &load,
                 const double                  size,
                 const dealii::Tensor<1, dim> &area,
                 const BoundaryPoint          &point,
                 const double                  t,
                 Vector                       &force) const;

    /**
     * Rejects a condition that has segments outside the mesh, where it would
     * have no effect. Collective.
     * @param middles midpoints of the segments @param in_mesh fraction of each
     * segment found on this rank
     * @throws StepFailure
     */
    void
    check_in_mesh(const BoundaryCondition               &condition,
                  const std::vector<dealii::Point<dim>> &middles,
                  std::vector<double>                    in_mesh) const;

    const Scene            &scene;
    const BackgroundMesh   &mesh;
    const Space            &space;
    std::vector<bool>       acts; ///< per condition of Scene::dirichlet
    std::vector<HeldSide>   supports;
    std::vector<LoadedSide> loads;
  };
} // namespace geocone::GEOCONE_DIM

#endif
