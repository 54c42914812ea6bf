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
   * What acts in explicit steps on sides: tractions T on those of the body, which move
   * with it, and dashpots on those of the mesh through which waves leave
   * (AbsorbingBoundary). A dashpot takes the mean velocity of the step,
   *   m (v' - v)/dt = f + T + 2 C v_in - C (v + v')/2,
   * which is stable for steps of any size. The nodes are those of MeshTransfer.
   */
  class BoundaryForces
  {
  public:
    /** @throws InputError for sides that the body or the mesh has not, or that are
     *  oblique and absorb */
    BoundaryForces(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const Space          &space);

    /** After BackgroundMesh::repartition(), and Space::follow_ranks(). Collective. */
    void
    follow_ranks();

    /** Evaluates what acts in the middle of a step, at time t. Collective.
     *  @throws StepFailure if a loaded side has left the mesh */
    void
    begin_step(const double t);

    /** Adds the tractions to the forces that points have written. */
    void
    add_tractions(GridTransfer &nodes) const;

    /** What tractions and dashpots have done in a step, of this rank. */
    struct Done
    {
      double                 work = 0.; ///< (J/m)
      dealii::Tensor<1, dim> impulse;   ///< (N s/m)
    };

    /**
     * Adds the dashpots to all other forces, for the velocities that are read.
     * @param least_mass nodes with this mass or less have no velocity
     * @param is_held per node and component
     */
    Done
    add_dashpots(GridTransfer                     &nodes,
                 const double                      dt,
                 const double                      least_mass,
                 const std::vector<unsigned char> &is_held) const;

    /** Moves the loaded sides with the nodes, over a step. Collective. */
    void
    move(const GridTransfer &nodes, const double dt);

    /** The places of the sides, for a checkpoint. */
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
