// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_boundary_forces_h
#define geocone_explicit_boundary_forces_h

#include <geocone/conditions/moving_conditions.h>
#include <geocone/problem/absorbing_boundary.h>
#include <geocone/transfer/grid_transfer.h>

#include <memory>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary forces in explicit steps: tractions T on boundary segments that
   * move with the body, and dashpots on absorbing boundaries of the mesh
   * (AbsorbingBoundary). A dashpot uses the mean velocity of the step,
   *   m (v' - v)/dt = f + T + 2 C v_in - C (v + v')/2,
   * which is unconditionally stable. The nodes of MeshTransfer are used.
   */
  class BoundaryForces
  {
  public:
    /** @throws InputError for sides that do not exist in the body or the mesh,
     *  and for oblique absorbing sides */
    BoundaryForces(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const Space          &space);

    /** Redistributes the data over the ranks after
     *  BackgroundMesh::repartition() and Space::follow_ranks(). Collective. */
    void
    follow_ranks();

    /** Evaluates the boundary forces at time t, the midpoint of a step.
     *  Collective.
     *  @throws StepFailure if a loaded segment has left the mesh */
    void
    begin_step(const double t);

    /** Adds the tractions to the nodal forces written by the points. */
    void
    add_tractions(GridTransfer &nodes) const;

    /** Work and impulse of tractions and dashpots on this rank in a step. */
    struct Done
    {
      double                 work = 0.; ///< (J/m)
      dealii::Tensor<1, dim> impulse;   ///< (N s/m)
    };

    /**
     * Adds the dashpot forces to the complete nodal forces and computes the
     * work from the velocities to be read by the points.
     * @param least_mass nodes with this mass or less are skipped (kg/m)
     * @param is_held whether the velocity is prescribed, per node and component
     */
    Done
    add_dashpots(GridTransfer                     &nodes,
                 const double                      dt,
                 const double                      least_mass,
                 const std::vector<unsigned char> &is_held) const;

    /** Moves the loaded segments with the velocities of the nodes over a step
     *  dt. Collective. */
    void
    move(const GridTransfer &nodes, const double dt);

    /** Reads or writes the positions of the segments of a checkpoint. */
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
    std::unique_ptr<MovingConditions>  moving;
    std::unique_ptr<AbsorbingBoundary> absorbing;
    Vector                             tractions, coefficient, incoming;
  };
} // namespace geocone::GEOCONE_DIM

#endif
