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
   * Boundary forces in explicit steps: tractions T on segments of the body,
   * which move with it, and dashpots on absorbing boundaries of the mesh
   * (AbsorbingBoundary). A dashpot uses the mean velocity of the step,
   *   m (v' - v)/dt = f + T + 2 C v_in - C (v + v')/2,
   * which is stable for steps of any size. The nodes are those of MeshTransfer.
   */
  class BoundaryForces
  {
  public:
    /** @throws InputError for sides that the body or the mesh does not have, or
     *  that are oblique and absorbing */
    BoundaryForces(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const Space          &space);

    /** Updates the data after BackgroundMesh::repartition() and
     *  Space::follow_ranks(). Collective. */
    void
    follow_ranks();

    /** Evaluates the boundary forces in the middle of a step, at time t.
     *  Collective.
     *  @throws StepFailure if a loaded segment has left the mesh */
    void
    begin_step(const double t);

    /** Adds the tractions to the forces written by the points. */
    void
    add_tractions(GridTransfer &nodes) const;

    /** Work and impulse of tractions and dashpots in a step, of this rank. */
    struct Done
    {
      double                 work = 0.; ///< (J/m)
      dealii::Tensor<1, dim> impulse;   ///< (N s/m)
    };

    /**
     * Adds the dashpot forces to all other forces, by the velocities that
     * points will read.
     * @param least_mass nodes with this mass or less have no velocity
     * @param is_held per node and component
     */
    Done
    add_dashpots(GridTransfer                     &nodes,
                 const double                      dt,
                 const double                      least_mass,
                 const std::vector<unsigned char> &is_held) const;

    /** Moves the loaded segments with the nodes over a step. Collective. */
    void
    move(const GridTransfer &nodes, const double dt);

    /** Positions of the segments, for a checkpoint. */
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
