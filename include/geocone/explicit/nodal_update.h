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
   * What has come into and gone out of the body since the start: sums over all
   * explicit steps, of all ranks once ExplicitMPM::exchange() has gathered them.
   */
  struct Exchange
  {
    double stress_work  = 0.; ///< sum of s : de V (J/m)
    double gravity_work = 0.; ///< sum of m g dx (J/m)
    double damping_work = 0.; ///< taken by local damping (J/m)
    /** Of prescribed velocities, tractions and absorbing sides (J/m). */
    double support_work = 0.;

    /** Of gravity, damping, and the same (N s/m). */
    dealii::Tensor<1, dim> impulse;

    /** What was taken away (Stage::removes()), or left the grid. */
    double                 removed_mass = 0.;      ///< (kg/m)
    dealii::Tensor<1, dim> removed_momentum;       ///< (N s/m)
    double                 removed_energy    = 0.; ///< kinetic (J/m)
    double                 removed_potential = 0.; ///< from the lower corner

    /** Of kinetic damping: kinetic energy set to zero (J/m). */
    double stopped_energy = 0.;

    unsigned long small_masses = 0; ///< nodes passed over as massless

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
   * What an explicit step does at the nodes: from momentum, force and mass, which
   * the points have written, to velocity and its change, which they read; with
   * gravity, local damping and prescribed velocities. Clears what it has used.
   */
  class NodalUpdate
  {
  public:
    /**
     * @param flip_part of the points' velocity, for the momentum that
     * conditions give by way of PIC
     * @param least_mass nodes with this mass or less are passed over (kg/m)
     * @param boundary what acts on sides, or null
     * @param sum to which impulses and works of this rank are added
     */
    NodalUpdate(GridTransfer             &transfer,
                const BoundaryConditions &conditions,
                const double              flip_part,
                const double              least_mass,
                const BoundaryForces     *boundary,
                Exchange                 &sum);

    /** The step as nodes see it. */
    struct Step
    {
      double                 t, dt; ///< (s)
      dealii::Tensor<1, dim> gravity;
      double                 damping;
      bool                   measures_force; ///< for unbalanced_force()
    };

    /** To be called after GridTransfer::sort(). */
    void
    mark_held();

    /** Velocity before the step, v = p/m with conditions at t; keeps the masses. */
    void
    velocity_before(const double t);

    /** Velocity from the points' new momentum, with conditions at the end of the
     *  step, by which the points will move. */
    void
    velocity_after(const Step &step);

    /**
     * Velocity at the end of the step and its change, by the forces.
     * @param velocity_is_read whether `read` holds the velocity before it, and
     * not `write` the momentum
     * @param moves whether the points will move by it
     */
    void
    accelerate(const Step &step, const bool velocity_is_read, const bool moves);

    /** Largest force on a free component of a node of this rank, before damping,
     *  when it was last measured (N/m). */
    double
    unbalanced_force() const
    {
      return unbalanced;
    }

    /** Impulses of this rank per condition since the last call (N s/m), and
     *  their moments about GridTransfer::centres (N m s/m). */
    std::vector<Reaction>
    take_support_impulses();

    /** What this rank has summed up since, for a checkpoint. */
    void
    state(StateRow &row)
    {
      for (Reaction &impulse : support_impulse)
        row(impulse);
      row(unbalanced);
    }

  private:
    /** A force that the points have written (N/m). */
    double &
    force_at(const unsigned int node, const unsigned int component)
    {
      return transfer.write[node_size * node + change_of_node + component];
    }

    /** read = write/mass, and no change. */
    void
    divide_momentum();

    double
    prescribed_velocity(const PrescribedNode &node, const double t) const;

    /** Finds the velocities that conditions give; the reaction is what the points get
     *  of momentum beyond the forces. */
    void
    hold_prescribed(const Step &step);

    /** Books an impulse to the condition of a node. */
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

    /** Nothing in write, and in mass unless it is kept. */
    void
    clear(const bool keep_mass);

    GridTransfer             &transfer;
    const BoundaryConditions &conditions;
    const double              flip_part, least_mass;
    const BoundaryForces     *boundary;
    Exchange                 &sum;

    /** A component of a node whose velocity is given in this step. */
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
