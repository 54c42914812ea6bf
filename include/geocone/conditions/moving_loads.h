// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_moving_loads_h
#define geocone_conditions_moving_loads_h

#include <geocone/base/state_row.h>
#include <geocone/scene/scene.h>
#include <geocone/surfaces/moving_surface.h>
#include <geocone/surfaces/sides_of_body.h>

#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Checks that the boundary segments of a condition are inside the mesh. Outside
   * the mesh, the condition would have no effect. Collective.
   * @param middles midpoints of the segments @param in_mesh fraction of each
   * segment found on this rank
   * @throws StepFailure if a segment is outside the mesh
   */
  void
  check_in_mesh(const BoundaryCondition               &condition,
                const std::vector<dealii::Point<dim>> &middles,
                std::vector<double>                    in_mesh,
                const MPI_Comm                         comm);

  /** Tractions on boundary segments that move with the body, as nodal forces. A
   *  traction acts as long as the soil behind its facets is there. */
  class MovingLoads
  {
  public:
    /** @throws InputError if the body has no boundary segment for a traction */
    MovingLoads(const Scene          &scene,
                const BackgroundMesh &mesh,
                const Space          &space);

    /** Removes the loads on the soil that a stage removes from time t on.
     *  @param duration of their decrease (s); 0: at once */
    void
    remove(const Stage &stage, const double t, const double duration);

    /** Adds the loads on the soil of a material added by a stage. */
    void
    add(const unsigned int material);

    /**
     * Adds the nodal forces of all tractions at time t to @p force, on facets with
     * soil and nodes with mass. Collective.
     * @param has_mass empty: on all nodes
     * @param stage,scaled as in Loads::evaluate()
     * @throws StepFailure if a boundary segment has left the mesh or the points
     */
    void
    add_forces(Vector              &force,
               const NodesWithMass &has_mass,
               const double         t,
               const Stage         *stage  = nullptr,
               const bool           scaled = false) const;

    /** Moves the boundary segments with the nodal velocities v of nodes with mass
     *  during a time step h. Collective. @param has_mass as in add_forces() */
    void
    move(const NodesWithMass &has_mass, const Vector &v, const double h);

    bool
    exist() const
    {
      return !loads.empty();
    }

    /** Calls f for each quadrature point of the facets with soil. */
    void
    for_each_loaded_point(
      const std::function<void(const BoundaryPoint &)> &f) const;

    /** Facets with soil, each once whatever the number of its tractions. */
    std::vector<SidePart>
    facets_with_soil() const;

    /** Saves the positions of the boundary segments to a checkpoint, or
     *  restores them from one. */
    void
    state(StateRow &row);

  private:
    /** A traction boundary condition and its boundary segments. */
    struct LoadedSide
    {
      unsigned int  condition;
      MovingSurface surface;
    };

    /** Returns the traction at a quadrature point of a facet times its size.
     *  @param size initial size of the facet, on which dead loads act
     *  @param area current outward normal times current size */
    dealii::Tensor<1, dim>
    traction_at(const BoundaryCondition      &load,
                const double                  size,
                const dealii::Tensor<1, dim> &area,
                const dealii::Point<dim>     &x,
                const double                  t) const;

    const Scene            &scene;
    const BackgroundMesh   &mesh;
    const Space            &space;
    std::vector<LoadedSide> loads;
  };
} // namespace geocone::GEOCONE_DIM

#endif
