// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_nodal_update_h
#define geocone_explicit_nodal_update_h

#include <geocone/boundary/boundary_conditions.h>
#include <geocone/explicit/boundary_forces.h>
#include <geocone/explicit/exchange.h>
#include <geocone/explicit/explicit_obstacles.h>
#include <geocone/explicit/pore_water.h>
#include <geocone/transfer/grid_transfer.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Explicit time step at the nodes: computes velocities and velocity
   * increments from momentum, force and mass. Momentum, force and mass are
   * scattered from the points, which then gather the velocities. Includes
   * gravity, local damping and prescribed velocities. Sets the input to zero.
   */
  class NodalUpdate
  {
  public:
    /**
     * Creates the nodal update for a grid transfer and boundary conditions.
     * @param flip_part FLIP fraction in the velocity update of the points,
     * which determines the momentum received from prescribed velocities
     * @param least_mass nodes with this mass or less are skipped (kg/m)
     * @param boundary boundary forces, or null
     * @param water pore water that flows, or null
     * @param obstacles in contact with the points, or null
     * @param sum totals to which the impulses and work of this rank are added
     */
    NodalUpdate(GridTransfer             &transfer,
                const BoundaryConditions &conditions,
                const double              flip_part,
                const double              least_mass,
                const BoundaryForces     *boundary,
                PoreWater                *water,
                ExplicitObstacles        *obstacles,
                Exchange                 &sum);

    /** Parameters of the nodal update in an explicit step. */
    struct Step
    {
      double                 t, dt; ///< (s)
      dealii::Tensor<1, dim> gravity;
      double                 damping;
      bool                   measures_force; ///< for unbalanced_force()
    };

    /** Lists the velocity components with prescribed values at the stored
     *  nodes. Must be called after GridTransfer::sort(). */
    void
    mark_held();

    /** Computes the nodal velocity v = p/m before the step, with prescribed
     *  velocities at time t. The nodal masses are retained. */
    void
    velocity_before(const double t);

    /** Computes the nodal velocity with which the points move, from the
     *  updated momentum of the points. Prescribed velocities are evaluated
     *  at the end of the step. */
    void
    velocity_after(const Step &step);

    /**
     * Computes the nodal velocity at the end of the step and the velocity
     * increment from the nodal forces.
     * @param velocity_is_read whether `read` contains the velocity before the
     * step; otherwise `write` contains the momentum
     * @param moves whether the points move with the computed velocity
     */
    void
    accelerate(const Step &step, const bool velocity_is_read, const bool moves);

    /** Largest unbalanced nodal force in a free direction on this rank,
     *  before damping (N/m). The value is that of the last step with
     *  Step::measures_force. */
    double
    unbalanced_force() const
    {
      return unbalanced;
    }

    /** Returns the contribution of this rank to the impulse of the support
     *  reaction at each boundary condition, accumulated since the last call
     *  (N s/m). Moments are
     *  about GridTransfer::centres (N m s/m). */
    std::vector<Reaction>
    take_support_impulses();

    /** Saves the support impulses and the unbalanced force of this rank to a
     *  checkpoint, or restores them from one. */
    void
    state(StateRow &row)
    {
      for (Reaction &impulse : support_impulse)
        row(impulse);
      row(unbalanced);
    }

  private:
    /** Component of the force that the points have scattered to a node
     *  (N/m). */
    double &
    force_at(const unsigned int node, const unsigned int component)
    {
      return transfer.write[node_size * node + change_of_node + component];
    }

    /** Computes the nodal velocities as momentum divided by mass. The
     *  velocities `read` are `write`/`mass`. The velocity increments are set
     *  to zero. */
    void
    divide_momentum();

    double
    prescribed_velocity(const PrescribedNode &node, const double t) const;

    /** Imposes the prescribed velocities on the nodes. The reaction is the
     *  momentum transferred to the points in excess of the momentum due to
     *  the nodal forces. */
    void
    impose_prescribed(const Step &step);

    /** Adds a nodal impulse to the reaction of the boundary condition at the
     *  node. */
    void
    add_impulse(const PrescribedNode &node, const double impulse);

    /** Adds the contact forces of obstacles to the nodal velocities. What they push
     *  into supports is subtracted from the reactions of the boundary conditions: both
     *  then are the forces that act on the body. */
    void
    push_by_obstacles();

    /** Adds the work done by gravity on the points during the step, from the
     *  nodal velocities (array GridTransfer::read) with which the points
     *  move. */
    void
    count_gravity_work(const Step &step);

    /** Components whose force is balanced by a reaction: prescribed ones, and those of
     *  the potential contact nodes of obstacles. */
    const std::vector<unsigned char> &
    reactions();

    void
    measure_unbalanced_force();

    /** Adds the local damping forces to the nodal forces (array
     *  GridTransfer::write). */
    void
    add_damping(const Step &step);

    /** Resets the nodal values scattered from the points (array
     *  GridTransfer::write) to zero. The nodal masses are also reset unless
     *  keep_mass. */
    void
    clear(const bool keep_mass);

    GridTransfer             &transfer;
    const BoundaryConditions &conditions;
    const double              flip_part, least_mass;
    const BoundaryForces     *boundary;
    PoreWater                *water;
    ExplicitObstacles        *obstacles;
    Exchange                 &sum;

    /** A nodal velocity component with a prescribed value in the current
     *  step. */
    struct PrescribedComponent
    {
      unsigned int node, component;
      double       velocity, change;
    };
    std::vector<PrescribedComponent> held;
    std::vector<unsigned char>       is_prescribed; ///< per nodal component
    std::vector<unsigned char>       is_reaction;   ///< see reactions()
    std::vector<Reaction> support_impulse;          ///< per boundary condition
    double                unbalanced = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
