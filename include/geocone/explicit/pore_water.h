// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_pore_water_h
#define geocone_explicit_pore_water_h

#include <geocone/points/particle_transfer.h>
#include <geocone/points/point_arrays.h>
#include <geocone/scene/drainage.h>
#include <geocone/scene/scene.h>
#include <geocone/transfer/grid_transfer.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Pore water of saturated soil in explicit steps, as a second phase of the
   * material points (one-point, two-phase formulation). With the velocities v
   * of the soil and w of the water, the porosity n, the pore pressure u, its
   * hydrostatic part u_0 below the water table, and the excess p = u - u_0,
   *   rho a + n rho_w (dw/dt - dv/dt) = div(s' - p 1) + rho g - grad u_0,
   *   n rho_w dw/dt = -n grad p + n (rho_w g - grad u_0)
   *                   - (n^2 gamma_w/k) (w - v),
   *   du/dt = -(K_w/n) ((1 - n) div v + n div w).
   * Nodes have a mass of water and a drag, and the relative velocity w - v is
   * advanced first, implicitly in the drag, so that a small permeability does
   * not limit the time step. The inertia of w - v then acts on the mixture as a
   * nodal force. Points have the variables u, w and whether they are saturated,
   * as history variables after those of the constitutive law; points above the
   * initial water table are dry and remain so. The porosity and the water in a
   * point are constant. p = 0 on free surfaces of the body.
   */
  class PoreWater
  {
  public:
    /** Applies an action to all blocks of points. */
    using Loop = std::function<void(
      const std::function<void(const TransferBlock &)> &action)>;

    /** Totals of the pore water in explicit steps of this rank. */
    struct Totals
    {
      double                 work = 0.; ///< by gravity and buoyancy (J/m)
      double                 loss = 0.; ///< dissipated by the flow (J/m)
      double                 pressure_work = 0.; ///< of the excess (J/m)
      double                 outflow       = 0.; ///< from the body (m^2)
      dealii::Tensor<1, dim> impulse;            ///< of the buoyancy (N s/m)
    };

    /** Returns true if pore water flows relative to the soil. */
    bool
    acts() const
    {
      return drainage.acts;
    }

    /** Checks the scene and computes the constants of the materials.
     *  @param b_bar whether the rates of the water volume and the excess pore
     *  pressures are averaged over the points of each cell
     *  @throws InputError */
    void
    prepare(const Scene &scene, const ParticleTransfer &rule, const bool b_bar);

    /** Selects the transfer between points and nodes. @param names of its sides
     *  @throws InputError for unknown drained sides */
    void
    use(GridTransfer &transfer, const std::vector<std::string> &names);

    /** Number of variables of the pore water at a point. */
    unsigned int
    n_variables() const
    {
      return acts() ? dim + 2 : 0;
    }

    /** Initialises the variables of a point.
     *  @param[out] variables n_variables() values */
    void
    initialise(const dealii::Point<dim>     &place,
               const dealii::Tensor<1, dim> &velocity,
               double                       *variables) const;

    /** P-wave modulus M (Pa) of the mixture, such that the fastest wave in a
     *  saturated point without drag has the speed sqrt(M/rho).
     *  @param skeleton P-wave modulus of the soil without water (Pa) */
    double
    wave_modulus(const unsigned int material, const double skeleton) const;

    /** @name Quantities of a point */
    /** @{ */
    bool
    is_saturated(const PointArrays &group, const unsigned int p) const
    {
      return group.history[first(group) + 1 + dim][p] > 0.;
    }

    double
    pressure(const PointArrays &group, const unsigned int p) const
    {
      return group.history[first(group)][p];
    }

    /** Excess pore pressure over the hydrostatic one (Pa). */
    double
    excess_pressure(const PointArrays &group, const unsigned int p) const;

    /** Velocity of the water (m/s); of the soil where it is dry. */
    dealii::Tensor<1, dim>
    velocity(const PointArrays &group, const unsigned int p) const;

    /** Volume of the water that the pore pressure of a saturated point stores,
     *  V u n/K_w (m^2). */
    double
    stored_water(const PointArrays &group, const unsigned int p) const
    {
      return group.volume[p] * pressure(group, p) /
             soils[group.of_material].modulus;
    }

    /** Momentum (N s/m) and kinetic energy (J/m) of a point in excess of those
     *  of the mixture that moves with the velocity of the soil. */
    dealii::Tensor<1, dim>
    relative_momentum(const PointArrays &group, const unsigned int p) const;
    double
    relative_energy(const PointArrays &group, const unsigned int p) const;
    /** @} */

    /** Replaces the P-wave moduli at the points of a block by those of the
     *  mixture, see wave_modulus(). */
    void
    stiffen(const TransferBlock &points,
            const PointArrays   &group,
            double              *moduli) const;

    /** Sets the water velocity of all points to zero. */
    void
    stop(std::vector<PointArrays> &groups) const;

    /** @name A pass over the points */
    /** @{ */
    /** Updates pore pressures and water velocities from the nodes, at the
     *  positions before the points move. */
    void
    update_points(const Update              update,
                  const double              dt,
                  const Loop               &for_each_block,
                  std::vector<PointArrays> &groups,
                  BlockScratch             &scratch);

    /** Subtracts the excess pore pressure from the point values that scatter()
     *  of GridTransfer adds to the nodes of the mixture, so that their stress is
     *  the total one. Hoop stresses include it already. */
    void
    add_pressure(const TransferBlock &points,
                 const PointArrays   &group,
                 BlockScratch        &scratch) const;

    /** Scatters momentum, force and mass of the water to its nodes. */
    void
    scatter(const bool                momentum,
            const bool                force,
            const bool                mass,
            const Loop               &for_each_block,
            std::vector<PointArrays> &groups,
            BlockScratch             &scratch);
    /** @} */

    /** @name Nodes */
    /** @{ */
    /** Allocates the nodes that the transfer stores, with zero values. */
    void
    reset_nodes();

    /** Sums over all ranks the values that points have scattered.
     *  Collective. */
    void
    exchange(const bool with_mass);

    /** Adds the buoyancy below the water table to the nodal forces of the
     *  mixture. */
    void
    add_buoyancy(const double dt, const dealii::Tensor<1, dim> &gravity);

    /**
     * Advances the relative velocity w - v at all nodes whose velocity is not
     * prescribed, and adds its inertia to the nodal forces of the mixture. All
     * other forces must be included already.
     * @param least_mass nodes with this mass or less are skipped (kg/m)
     * @param is_prescribed whether v is prescribed, per node and component
     */
    void
    advance_relative(const double                      dt,
                     const dealii::Tensor<1, dim>     &gravity,
                     const double                      least_mass,
                     const std::vector<unsigned char> &is_prescribed);

    /** Advances a component of w - v at a node whose velocity v is prescribed.
     *  It is zero on an impervious side. @param change of v in the step (m/s) */
    void
    advance_relative_at(const PrescribedNode         &node,
                        const double                  dt,
                        const dealii::Tensor<1, dim> &gravity,
                        const double                  change);

    /** Computes the velocity of the water from that of the soil at the end of
     *  the step and the advanced relative velocity. Adds the energy dissipated
     *  by the drag to the totals. */
    void
    add_velocity_of_soil(const double dt);

    /** Computes the velocity of the water from the momentum of the points, for
     *  MUSL. @param least_mass see advance_relative() */
    void
    divide_momentum(const double least_mass);

    /** Adds the work of gravity on the water relative to the soil, and of the
     *  buoyancy, during a step. */
    void
    count_work(const double dt, const dealii::Tensor<1, dim> &gravity);

    /** Resets the values scattered from the points to zero. */
    void
    clear(const bool keep_mass);
    /** @} */

    /** Returns the totals since the last call. */
    Totals
    take_totals();

    /** Memory used by the nodes of this rank (bytes). */
    std::size_t
    memory() const;

  private:
    /** Constants of a saturated material. The masses are shares of the mass of
     *  the mixture. */
    struct Soil
    {
      double modulus   = 0.; ///< K_w/n (Pa)
      double porosity  = 0.;
      double density   = 0.; ///< of the mixture (kg/m^3)
      double water     = 0.; ///< n rho_w/rho
      double drag      = 0.; ///< n^2 gamma_w/(k rho) (1/s)
      double displaced = 0.; ///< rho_w/rho below the water table, else 0
    };

    /** Nodal arrays in the layout of GridTransfer. */
    struct Nodes
    {
      dealii::AlignedVector<double> read, write, mass;
    };

    /** Lets a transfer use other nodal arrays during its lifetime. */
    class Exchanged;

    void
    check(const Scene &scene, const ParticleTransfer &rule) const;

    static Soil
    soil(const Scene &scene, const unsigned int material);

    /** Index of the first variable of the pore water among the history
     *  variables. */
    unsigned int
    first(const PointArrays &group) const
    {
      return group.n_history() - n_variables();
    }

    /** Rate of the water volume per volume, (1 - n) div v + n div w, at the
     *  points of a block (BlockScratch::divergence). Adds n div(w - v) to the
     *  outflow. */
    void
    find_rates(const double         dt,
               const TransferBlock &points,
               const PointArrays   &group,
               BlockScratch        &scratch);

    /** Replaces the excess pore pressure of each saturated point by the mean over
     *  those of its cell, to which its rates are equal. */
    void
    average_pressures(const Loop               &for_each_block,
                      std::vector<PointArrays> &groups);

    void
    update_pressures(const double         dt,
                     const TransferBlock &points,
                     PointArrays         &group,
                     const double        *rates);

    /** Divergence of the gathered velocity of a block (1/s), with v_r/r in
     *  axisymmetry. */
    void
    find_divergence(const TransferBlock &points, BlockScratch &scratch) const;

    /** Relative velocity w - v at a node before the step (m/s). */
    double
    relative_velocity(const unsigned int node,
                      const unsigned int component) const;

    /** Sets the relative velocity at a node after the step, and adds its
     *  inertia to the nodal force of the mixture. */
    void
    advance(const unsigned int node,
            const unsigned int component,
            const double       dt,
            const double       after);

    Drainage               drainage;
    const Scene           *scene     = nullptr;
    GridTransfer          *transfer  = nullptr;
    const TransferKernels *kernels   = nullptr;
    double                 flip_part = 1., least_radius = 0.;
    bool                   b_bar = false, axisymmetric = false;
    std::vector<Soil>      soils;      ///< per material
    std::vector<bool>      is_drained; ///< per boundary condition

    /** Nodes of the water: velocity and its change to read, momentum and force
     *  to write, and mass. */
    Nodes water;

    /** Nodes whose written values are the drag (kg/s/m), the mass of water
     *  displaced by the mixture and by its water below the water table
     *  (kg/m). */
    Nodes shares;

    Totals totals;
  };
} // namespace geocone::GEOCONE_DIM

#endif
