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
   * The conditions of a scene on what moves through the mesh: prescribed
   * velocities of particles and of sides of the body, which become rows H v = q
   * with multipliers, and tractions on its sides.
   */
  class MovingConditions
  {
  public:
    /** @throws InputError if the body has no such sides */
    MovingConditions(const Scene          &scene,
                     const BackgroundMesh &mesh,
                     const Space          &space);

    /** @throws InputError for a condition that holds no particle. Collective. */
    void
    check_held_particles(const MaterialPoints &points) const;

    /**
     * Adds the tractions at time t. Collective.
     * @param stage,raised as in Loads::evaluate()
     * @throws StepFailure if a side is no longer in the mesh
     */
    void
    add_tractions(Vector      &force,
                  const double t,
                  const Stage *stage  = nullptr,
                  const bool   raised = false) const;

    /** The transfer from nodes to particles in a step: it solves for
     *  v = v^L + part (v_end - v^L), and the velocity of a particle at its end is
     *  f (v_p + N (v_end - v^L)) + (1 - f) N v_end. */
    struct Transfer
    {
      const Vector &velocity_L; ///< with ghost values
      double        flip_part;  ///< f
      double        part;       ///< theta of the theta-scheme, or 1
      double        t_end;
    };

    /**
     * Makes the rows H v = q, with q at time t. Collective.
     * @throws StepFailure if a side is no longer in the mesh
     * @throws InputError for rows that no function supports or that contradict
     * each other
     */
    void
    make_rows(const MaterialPoints &points,
              const Vector         &prescribed,
              const double          t,
              const Transfer       &transfer,
              Constraints          &constraints) const;

    /**
     * Moves the sides over a step h: held ones by their velocity at time t,
     * loaded ones by that of the nodes. Collective.
     */
    void
    move(const Vector &v, const double h, const double t);

    /** The sides normal to an axis that hold the body across it, on which its soil
     *  ends. */
    std::vector<SoilLimit>
    soil_limits() const;

    /** The corners of the box around the sides that a condition holds.
     *  @pre it holds sides */
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    box_of(const BoundaryCondition &condition) const;

    /** Whether the function of each local node is not zero somewhere on a side that
     *  is held or loaded; empty without such sides. Collective. */
    std::vector<bool>
    loaded_nodes() const;

    /**
     * Where a point is put that passed a side which holds the body across it, as means
     * over a side let single points: on the side, or at its end if it came from beside
     * it. Nothing for points that passed none in the last move().
     * @param before,after where the point was and came to
     */
    std::optional<dealii::Point<dim>>
    put_back(const dealii::Point<dim> &before,
             const dealii::Point<dim> &after) const;

    /** Points of all ranks that are more than a tenth of their own size beyond a
     *  side that holds the body across it, where they cannot be. Collective. */
    unsigned int
    n_behind(const MaterialPoints &points) const;

    /** The places of the sides, for a checkpoint. */
    void
    state(StateRow &row);

  private:
    /** A support on a side of the body, and the side. */
    struct HeldSide
    {
      unsigned int          condition;
      std::vector<SidePart> panels;
      std::vector<SidePart> before = {}; ///< the last move()
    };

    /** A load on sides of the body, and the sides. */
    struct LoadedSide
    {
      unsigned int  condition;
      MovingSurface surface;
    };

    /** The number of held particles of each condition, around an axis the sum of their
     *  circumferences (m); of all ranks. Collective. */
    std::vector<double>
    sum_held(const MaterialPoints &points) const;

    /** Makes the parts shorter that a condition holds, as 'Segment shortening' asks. */
    void
    shorten(const BoundaryCondition &condition,
            std::vector<SidePart>   &panels) const;

    /** @name The rows of supports, as they are at time t */
    /** @{ */
    void
    add_rows_of_sides(const double t, Multipliers &rows) const;
    void
    add_rows_of_particles(const MaterialPoints &points,
                          const double          t,
                          const Transfer       &transfer,
                          Multipliers          &rows) const;

    /** Adds a place x, with the functions that are not zero there, to a row of
     *  a condition for each component that it prescribes. */
    void
    add_to_row(const unsigned int                                  condition,
               const Imposition::Share                            &share,
               const dealii::Point<dim>                           &x,
               const double                                        t,
               const std::vector<dealii::types::global_dof_index> &nodes,
               const double                                       *values,
               Multipliers                                        &rows) const;

    /** Adds to the row of a held particle the offsets by which N v has to differ from the
     *  prescribed velocity, so that FLIP gives it to the particle. */
    void
    add_flip_offsets(const MaterialPoints                               &points,
                     const unsigned int                                  p,
                     const Imposition::Share                            &share,
                     const std::vector<dealii::types::global_dof_index> &nodes,
                     const Transfer &transfer,
                     Multipliers    &rows) const;
    /** @} */

    /** Adds the part of a load that acts at a point of a facet.
     *  @param size of it at the start, on which dead loads act
     *  @param area its outward normal, as it is, times its size */
    void
    add_traction(const BoundaryCondition      &load,
                 const double                  size,
                 const dealii::Tensor<1, dim> &area,
                 const BoundaryPoint          &point,
                 const double                  t,
                 Vector                       &force) const;

    /**
     * Refuses a condition of whose parts one lies outside the mesh, where it would
     * vanish silently. Collective.
     * @param middles of them @param in_mesh the part of each, as found on this rank
     * @throws StepFailure
     */
    void
    check_in_mesh(const BoundaryCondition               &condition,
                  const std::vector<dealii::Point<dim>> &middles,
                  std::vector<double>                    in_mesh) const;

    const Scene            &scene;
    const BackgroundMesh   &mesh;
    const Space            &space;
    std::vector<HeldSide>   supports;
    std::vector<LoadedSide> loads;
  };
} // namespace geocone::GEOCONE_DIM

#endif
