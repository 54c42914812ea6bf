// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_nodal_update_h
#define geocone_explicit_nodal_update_h

#include <geocone/explicit/boundary_forces.h>
#include <geocone/scene/boundary_conditions.h>
#include <geocone/transfer/grid_transfer.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Momentum, energy and mass exchanged by the body since the start: sums over
   * all explicit steps, over all ranks after ExplicitMPM::exchange().
   */
  struct Exchange
  {
    double stress_work  = 0.; ///< sum of s : de V (J/m)
    double gravity_work = 0.; ///< sum of m g dx (J/m)
    double damping_work = 0.; ///< taken by local damping (J/m)
    /** Work of prescribed velocities, tractions and absorbing boundaries
     *  (J/m). */
    double support_work = 0.;

    /** Impulse of gravity, damping and the supports (N s/m). */
    dealii::Tensor<1, dim> impulse;

    /** Removed points (Stage::removes()), or points that left the grid. */
    double                 removed_mass = 0.;      ///< (kg/m)
    dealii::Tensor<1, dim> removed_momentum;       ///< (N s/m)
    double                 removed_energy    = 0.; ///< kinetic (J/m)
    double                 removed_potential = 0.; ///< from the lower corner

    /** Kinetic energy set to zero by kinetic damping (J/m). */
    double stopped_energy = 0.;

    unsigned long small_masses = 0; ///< nodes skipped as massless

    void
    state(StateRow &row)
    {
      row(stress_work,
          gravity_work,
          damping_work,
          support_work,
          impulse,
          removed_mass,
          removed_momentum,
          removed_energy,
          removed_potential,
          stopped_energy,
          small_masses);
    }
  };

  /**
   * Explicit step at the nodes: computes velocities and their changes, which
   * the points read, from momentum, force and mass, which they write; with
   * gravity, local damping and prescribed velocities. Clears its input.
   */
  class NodalUpdate
  {
  public:
    /**
     * @param flip_part FLIP part of the points' velocity, which determines the
     * momentum that they receive from conditions
     * @param least_mass nodes with this mass or less are skipped (kg/m)
     * @param boundary forces on sides, or null
     * @param sum to which impulses and works of this rank are added
     */
    NodalUpdate(GridTransfer             &transfer,
                const BoundaryConditions &conditions,
                const double              flip_part,
                const double              least_mass,
                const BoundaryForces     *boundary,
                Exchange                 &sum);

    /** Data of a step at the nodes. */
    struct Step
    {
      double                 t, dt; ///< (s)
      dealii::Tensor<1, dim> gravity;
      double                 damping;
      bool                   measures_force; ///< for unbalanced_force()
    };

    /** Marks prescribed components; must be called after
     *  GridTransfer::sort(). */
    void
    mark_held();

    /** Computes the velocity before the step, v = p/m, with conditions at t;
     *  keeps the masses. */
    void
    velocity_before(const double t);

    /** Computes the velocity from the points' new momentum, with conditions at
     *  the end of the step, for the motion of the points. */
    void
    velocity_after(const Step &step);

    /**
     * Computes the velocity at the end of the step and its change from the
     * forces.
     * @param velocity_is_read whether `read` holds the velocity before it,
     * rather than `write` the momentum
     * @param moves whether the points are moved with it
     */
    void
    accelerate(const Step &step, const bool velocity_is_read, const bool moves);

    /** Largest force on a free component of a node of this rank, before
     *  damping, at its last evaluation (N/m). */
    double
    unbalanced_force() const
    {
      return unbalanced;
    }

    /** Impulses of this rank per condition since the last call (N s/m), and
     *  their moments about GridTransfer::centres (N m s/m). */
    std::vector<Reaction>
    take_support_impulses();

    /** Sums of this rank since then, for a checkpoint. */
    void
    state(StateRow &row)
    {
      for (Reaction &impulse : support_impulse)
        row(impulse);
      row(unbalanced);
    }

  private:
    /** Nodal force written by the points (N/m). */
    double &
    force_at(const unsigned int node, const unsigned int component)
    {
      return transfer.write[node_size * node + change_of_node + component];
    }

    /** Sets read = write/mass, and no change. */
    void
    divide_momentum();

    double
    prescribed_velocity(const PrescribedNode &node, const double t) const;

    /** Sets the prescribed velocities; the reaction is the momentum transferred
     *  to the points beyond the forces. */
    void
    hold_prescribed(const Step &step);

    /** Adds an impulse to the condition of a node. */
    void
    add_impulse(const PrescribedNode &node, const double impulse);

    /** Adds the work of gravity on points that move by `read`. */
    void
    count_gravity_work(const Step &step);

    void
    measure_unbalanced_force();

    /** Adds local damping to the forces in write. */
    void
    damp(const Step &step);

    /** Clears write, and mass unless it is kept. */
    void
    clear(const bool keep_mass);

    GridTransfer             &transfer;
    const BoundaryConditions &conditions;
    const double              flip_part, least_mass;
    const BoundaryForces     *boundary;
    Exchange                 &sum;

    /** A nodal component with prescribed velocity in this step. */
    struct Held
    {
      unsigned int node, component;
      double       velocity, change;
    };
    std::vector<Held>          held;
    std::vector<unsigned char> is_held;         ///< per node and component
    std::vector<Reaction>      support_impulse; ///< per condition
    double                     unbalanced = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
