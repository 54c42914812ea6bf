// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_boundary_forces_h
#define geocone_explicit_boundary_forces_h

#include <geocone/conditions/moving_loads.h>
#include <geocone/terms/absorbing_boundary.h>
#include <geocone/transfer/grid_transfer.h>

#include <memory>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary forces in explicit steps: surface tractions and the dashpots of
   * absorbing boundaries. Tractions T act on boundary segments that move with
   * the body, dashpots on absorbing boundaries of the mesh (AbsorbingBoundary).
   * A dashpot uses the mean velocity of the step,
   *   m (v' - v)/dt = f + T + 2 C v_in - C (v + v')/2,
   * which is unconditionally stable. The nodes of MeshTransfer are used.
   */
  class BoundaryForces
  {
  public:
    /** Collects the tractions and absorbing boundaries of the scene.
     *  @throws InputError for sides that do not exist in the body or the mesh,
     *  and for oblique absorbing sides */
    BoundaryForces(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const Space          &space);

    /** Redistributes the data over the ranks after the cells and nodes have
     *  been redistributed (BackgroundMesh::repartition(),
     *  Space::follow_ranks()). Collective. */
    void
    follow_ranks();

    /** Removes the tractions on the soil that a stage removes, at time t or
     *  gradually from then on. */
    void
    remove(const Stage &stage, const double t)
    {
      moving->remove(stage, t, stage.removal_duration);
    }

    /** Evaluates the boundary forces at time t, the midpoint of a step.
     *  Collective.
     *  @throws StepFailure if a loaded segment has left the mesh */
    void
    begin_step(const double t);

    /** Adds the surface tractions to the nodal forces scattered from the
     *  points. */
    void
    add_tractions(GridTransfer &nodes) const;

    /** Work and impulse of tractions and dashpots during a step, on this
     *  rank. */
    struct Done
    {
      double                 work = 0.; ///< (J/m)
      dealii::Tensor<1, dim> impulse;   ///< (N s/m)
    };

    /**
     * Adds the dashpot forces of absorbing boundaries to the nodal forces. All
     * other nodal forces must be included already. The work is computed from
     * the nodal velocities gathered by the points.
     * @param least_mass nodes with this mass or less are skipped (kg/m)
     * @param is_prescribed whether the velocity is prescribed, per node and component
     */
    Done
    add_dashpots(GridTransfer                     &nodes,
                 const double                      dt,
                 const double                      least_mass,
                 const std::vector<unsigned char> &is_prescribed) const;

    /** Moves the loaded boundary segments with the nodal velocities during a
     *  time step dt. Collective. */
    void
    move(const GridTransfer &nodes, const double dt);

    /** Saves the positions of the loaded boundary segments to a checkpoint, or
     *  restores them from one. */
    void
    state(StateRow &row)
    {
      moving->state(row);
    }

  private:
    const Scene                       &scene;
    const BackgroundMesh              &mesh;
    const Space                       &space;
    const bool                         has_tractions;
    std::unique_ptr<MovingLoads>       moving;
    std::unique_ptr<AbsorbingBoundary> absorbing;
    Vector                             tractions, coefficient, incoming;
  };
} // namespace geocone::GEOCONE_DIM

#endif
