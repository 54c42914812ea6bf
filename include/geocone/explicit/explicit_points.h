// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_explicit_points_h
#define geocone_explicit_explicit_points_h

#include <geocone/base/archive.h>
#include <geocone/explicit/exchange.h>
#include <geocone/explicit/pore_water.h>
#include <geocone/points/history_start.h>
#include <geocone/points/outflow.h>
#include <geocone/points/particle_transfer.h>
#include <geocone/points/point_arrays.h>
#include <geocone/points/seeding.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>
#include <geocone/time_stepping/step_record.h>
#include <geocone/transfer/grid_transfer.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Global state of the material points at the end of a step of the loading
   *  programme. Reactions are copied from the ExplicitReport of the step. */
  struct ExplicitState : StepEnd
  {
    unsigned long          n_points = 0;
    double                 mass     = 0.; ///< (kg/m)
    double                 volume   = 0.; ///< (m^2)
    dealii::Tensor<1, dim> momentum;      ///< (N s/m)
    /** Angular momentum about the coordinate axes (N m s/m). */
    dealii::Tensor<1, n_rotations> angular_momentum;
    dealii::Point<dim> lower, upper; ///< bounding box of positions (m)
    /** Positions of the left and the right front (m): the coordinates x to the
     *  left of which 1 % and 99 % of the mass lie. */
    double left_front = 0., right_front = 0.;
    double largest_speed = 0.; ///< (m/s)

    /** Volume of the saturated points (m^2), and of the water that their pore
     *  pressure stores, sum of V u n/K_w (m^2). */
    double saturated_volume = 0., stored_water = 0.;

    /** Index, position and wave speed of the point with the largest elastic
     *  wave speed. This point limits the time step. */
    unsigned int       limiting_id = 0;
    dealii::Point<dim> limiting_place;
    double             limiting_wave_speed = 0.;

    void
    state(StateRow &row)
    {
      StepEnd::state(row);
      row(n_points,
          mass,
          volume,
          momentum,
          angular_momentum,
          lower,
          upper,
          left_front,
          right_front,
          largest_speed,
          saturated_volume,
          stored_water,
          limiting_id,
          limiting_place,
          limiting_wave_speed);
    }
  };

  /**
   * Material points of the explicit material point method, and the passes over them:
   * gather from the nodes, update of stresses and positions, scatter to the nodes.
   * Passes process blocks of points that fit into the cache.
   */
  class ExplicitPoints
  {
  public:
    /** @param sum totals to which the removed mass, momentum and energy of this rank
     *  are added */
    ExplicitPoints(const MPI_Comm comm, Exchange &sum);

    /** @param b_bar whether volumetric strains and mean stresses are averaged in cells
     *  @throws InputError */
    void
    prepare(const Scene &scene, const bool b_bar);

    /** Selects the transfer between points and grid.
     *  @param datum place of zero potential energy
     *  @param sides names of the sides of the grid
     *  @throws InputError for unknown drained sides */
    void
    use(std::unique_ptr<GridTransfer>   transfer,
        const dealii::Point<dim>       &datum,
        const std::vector<std::string> &sides);

    /** Creates the material points of this rank from the seeds.
     *  @param n number of points per material
     *  @param for_each calls a function for each seed of this rank
     *  @return the largest mass of a point of any rank (kg/m)
     *  @throws InputError */
    double
    seed(const std::vector<std::size_t>                   &n,
         const std::function<void(const Seeding::Take &)> &for_each,
         const Space                                      &space,
         std::vector<std::string>                         &remarks);

    /** Points of this rank, one group per material, and groups of points that are
     *  being removed. */
    const std::vector<PointArrays> &
    groups() const
    {
      return all_groups;
    }

    /** Transfer rule of velocities. */
    const ParticleTransfer &
    transfer_rule() const
    {
      return rule;
    }

    GridTransfer &
    grid()
    {
      return *transfer;
    }
    const GridTransfer &
    grid() const
    {
      return *transfer;
    }

    PoreWater &
    pore_water()
    {
      return water;
    }
    const PoreWater &
    pore_water() const
    {
      return water;
    }

    /** Number of points of this rank. */
    unsigned long
    n_of_rank() const;

    /** Total mass of the points of this rank (kg/m). */
    double
    mass_of_rank() const;

    /** Number of point updates (points times steps) on this rank. */
    double
    n_point_steps() const
    {
      return point_steps;
    }

    /** Hoop force of the last pass that scattered forces, on this rank (N/rad). */
    double
    hoop_force() const
    {
      return hoop;
    }

    /** Critical time step (s), at a Courant number of 1: h/(c + v). */
    double
    stability_limit() const;

    /** Extrema and sums of the last step; extrema are global after combine(). */
    const PassSums &
    last_sums() const
    {
      return sums;
    }

    /** @name Collective functions */
    /** @{ */
    ExplicitState
    state() const;
    LawCounts
    law_counts() const;
    double
    kinetic_energy() const;
    /** @} */

    /** Memory used by the points and nodes of this rank (bytes). */
    std::size_t
    memory() const;

    /** @name Stages of the loading programme */
    /** @{ */
    /** Resets displacements and accumulated quantities. */
    void
    reset_displacements();

    void
    reset_velocity();

    /** Starts the history of all points from their stress. Collective.
     *  @throws StepFailure if a law refuses a stress */
    void
    reset_history(std::vector<std::string> &remarks);

    /** Sets the velocity of all points to zero and adds their kinetic energy to
     *  Exchange::stopped_energy. */
    void
    stop();

    /** Number of points that a stage removes, and of all. Collective. */
    std::array<unsigned long, 2>
    n_removed_by(const Stage &stage) const;

    /** Removes the points that a stage excavates, or selects them for the reduction
     *  of their mass. Collective.
     *  @return remark
     *  @throws StepFailure if the stage removes no point, or all points */
    std::string
    remove(const Stage &stage);

    /** Removes the points whose mass was reduced, with remainders by rounding. */
    void
    end_removal();
    /** @} */

    /** @name An explicit step */
    /** @{ */
    /** Data scattered from the points to the nodes in one pass over the points. */
    enum class ScatteredData
    {
      nothing,
      momentum,
      force,
      momentum_and_mass,
      all
    };

    /** Removes points without mass, sorts all points by cell and distributes them
     *  among the ranks. Collective.
     *  @return whether the grid was divided anew among the ranks
     *  @throws StepFailure if no points are left, or a point has left the mesh */
    bool
    sort();

    /** @param mass_ratio mass that remains of the points that are being removed, after
     *  the step divided by before */
    void
    begin_step(const double mass_ratio);

    /** Performs one pass over all points: gathers from the nodes, updates the
     *  points and scatters to the nodes. */
    void
    pass(const Update update, const ScatteredData scattered, const double dt);

    /** Decisions of all ranks after a step. */
    struct Decisions
    {
      bool must_sort   = false;
      int  stop_signal = 0; ///< or 0
    };

    /** Combines the results of a step on all ranks. Collective.
     *  @param must_sort whether this rank asks for it for another reason
     *  @throws StepFailure if a point has an error */
    Decisions
    combine(const bool must_sort);
    /** @} */

    /** @name State in a checkpoint */
    /** @{ */
    void
    state_of_ranks(StateRow &row)
    {
      row(point_steps, counts);
    }
    void
    state_of_all(StateRow &row)
    {
      row(sums);
    }

    /** Saves the points. Collective. */
    void
    save(Archive &archive);

    /** Replaces the points by those of a checkpoint. Collective.
     *  @throws RunError if the checkpoint does not match the scene */
    void
    load(const Archive &archive);
    /** @} */

  private:
    /** Creates an empty group of points with a given material. */
    PointArrays
    make_group(const unsigned int material) const;

    /** Sets position, velocity, stress, volume and mass of a new point. */
    void
    set_point(PointArrays &group, const unsigned int p, const Seed &seed) const;

    /** Sets the history of a new point, and adds its speeds to the extrema.
     *  @param start refuses states that are not finite or that a law refuses */
    void
    start_history(PointArrays       &group,
                  const unsigned int p,
                  const Seed        &seed,
                  const double       band_width,
                  HistoryStart      &start);

    TransferBlock
    block(const unsigned int group, const unsigned int first);

    /** Gathers velocities and strain increments from the nodes for a block of
     *  points. Stresses and positions are then updated. */
    void
    gather(const Update update, const double dt, const TransferBlock &points);
    void
    update_stresses(const Update         update,
                    const double         dt,
                    const TransferBlock &points);

    /** Updates the bounding box of the point positions. Points outside the
     *  region of stored nodes are treated by correct_positions(). */
    void
    bound_positions(const TransferBlock &points);

    /** Scatters the data of a block of points to the nodes. */
    void
    scatter(const ScatteredData scattered, const TransferBlock &points);

    void
    for_each_block(const std::function<void(const TransferBlock &)> &action);

    /** @name B-bar */
    /** @{ */
    /** Computes the volume-weighted average of point values in each cell.
     *  Collective. */
    void
    average_in_cells(
      const std::function<const double *(const TransferBlock &)> &values_at);

    /** Computes the mean stress at the points for B-bar integration
     *  (BlockScratch::mean_stress). */
    void
    find_mean_stress(const TransferBlock &points);
    /** @} */

    /** @name Axisymmetry: hoop strain increment (the points may have moved in
     *  the pass) and force of the hoop stress */
    /** @{ */
    /** Hoop strain rate v_r/r at a point of a block, computed from the gathered
     *  velocity (1/s). */
    double
    hoop_rate(const unsigned int k, const double r) const;

    void
    strain_around_axis(const Update         update,
                       const double         dt,
                       const TransferBlock &points);
    void
    force_around_axis(const TransferBlock &points);
    /** @} */

    /** Reduces the mass and volume of points that are being removed gradually,
     *  within one block of points. */
    void
    fade_points(const TransferBlock &points);

    /** Error message for a point that has left the mesh. */
    std::string
    lost_point_message(const PointArrays &group, const unsigned int p) const;

    /** Corrects the positions of points outside the region of stored nodes, or
     *  records an error message. */
    void
    correct_positions(const TransferBlock &points);

    /** Coordinate x (m) to the left of which a given mass lies. The search
     *  interval is [left, right]. */
    double
    mass_quantile(const double wanted, double left, double right) const;

    /** Adds a part of the mass, momentum and energy of a point to the removed
     *  totals. */
    void
    count_removal(const PointArrays &group,
                  const unsigned int p,
                  const double       part);

    /** Removes a point: sets its mass to zero and adds its mass, momentum and
     *  energy to the removed totals. */
    void
    remove_point(PointArrays &group, const unsigned int p);

    /** Deletes points without mass from the arrays. */
    void
    remove_massless();

    double
    kinetic_energy(const PointArrays &group, const unsigned int p) const;

    /** Momentum of a point with its pore water (N s/m). */
    dealii::Tensor<1, dim>
    momentum(const PointArrays &group, const unsigned int p) const;

    /** Converts a unit for plane strain to the unit for the current problem,
     *  i.e. without "per metre of thickness" in axisymmetric and
     *  three-dimensional problems. */
    std::string
    unit(const std::string &in_plane_strain) const
    {
      return scene->geometry.unit(in_plane_strain);
    }

    /** Reads the values of the points on this rank from a checkpoint. Collective. */
    std::vector<double>
    points_of_rank(const Archive     &archive,
                   const std::string &name,
                   const std::size_t  size) const;

    const MPI_Comm   comm;
    Exchange        &sum;
    Outflow          outflow;
    ParticleTransfer rule;
    PoreWater        water;

    const Scene                  *scene        = nullptr;
    bool                          b_bar        = false;
    bool                          axisymmetric = false;
    const TransferKernels        *kernels      = nullptr;
    std::unique_ptr<GridTransfer> transfer;
    dealii::Point<dim>            datum;
    double                        least_radius = 0.;

    std::vector<PointArrays> all_groups;
    BlockScratch             scratch = {};
    std::vector<double *>    history;       ///< arrays passed to the law
    std::vector<double>      point_history; ///< history of one point

    double      mass_ratio  = 1.; ///< of the last step
    double      hoop        = 0.;
    double      point_steps = 0.;
    bool        some_left   = false; ///< points without mass exist
    std::string error_message;       ///< of this rank
    PassSums    sums;
    LawCounts   counts;
  };
} // namespace geocone::GEOCONE_DIM

#endif
