// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_explicit_mpm_h
#define geocone_explicit_explicit_mpm_h

#include <geocone/base/archive.h>
#include <geocone/base/choice.h>
#include <geocone/explicit/nodal_update.h>
#include <geocone/explicit/pore_water.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/points/outflow.h>
#include <geocone/points/particle_transfer.h>
#include <geocone/points/point_arrays.h>
#include <geocone/points/rank_balance.h>
#include <geocone/points/seeding.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>
#include <geocone/time_stepping/step_record.h>
#include <geocone/transfer/grid_transfer.h>

#include <functional>
#include <memory>
#include <optional>
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

  /** Statistics (number, sizes, unbalanced force) of the explicit steps within
   *  one step of the loading programme. */
  struct ExplicitReport
  {
    unsigned int n_steps       = 0;
    double       smallest_step = 0., largest_step = 0.; ///< (s)

    /** Largest unbalanced force at a free node in the last explicit step
     *  (N/m). */
    double unbalanced_force = 0.;

    /** Mean force and moment that each boundary condition exerts on the
     *  body. */
    std::vector<Reaction> reactions;

    /** Saves the statistics of an interrupted step to a checkpoint, or restores
     *  them from one. The reactions are excluded. */
    void
    state(StateRow &row)
    {
      row(n_steps, smallest_step, largest_step, unbalanced_force);
    }
  };

  /**
   * Explicit material point method with three orders of operations: stress
   * update last (USL), modified last (MUSL) or first (USF). The method follows
   * section 2 of Pereira et al. (2016). The elastic wave speed limits the time
   * step (Courant condition),
   *   dt = C h/(c + v),  c^2 = max M V/m,  v = max |v_p|.
   * With basis functions N at the start of the step and boundary conditions on
   * the sides of the grid, the three orders of operations are
   *   MUSL: a = F/m; v_p += dt sum N a; v = sum m_p v_p N/m; stress; x_p += dt
   *         sum N v   (the report's eleven steps);
   *   USL:  a = F/m; v = sum m_p v_p N/m + dt a; v_p += dt sum N a; stress; x_p;
   *   USF:  v = sum m_p v_p N/m; stress; a = F/m; v_p += dt sum N a; x_p.
   * Division by a nodal mass occurs only in bounded quotients, or if the
   * quotient is multiplied by N again. Nodes with less than 1e-14 of the
   * largest point mass are skipped and counted.
   *
   * Passes over the points process blocks of points that fit into the cache;
   * the points are occasionally sorted by cell. The last pass of a step also
   * scatters the data of the next step: USL requires one pass per step, MUSL
   * and USF two.
   */
  class ExplicitMPM : public dealii::ParameterAcceptor
  {
  public:
    ExplicitMPM(const MPI_Comm comm, const ParameterFile &file);

    /**
     * Seeds the material points of the body.
     * @return remarks on the scene and on changed parameters
     * @throws InputError
     */
    std::vector<std::string>
    prepare(const Scene &scene, const Method &method);

    /**
     * Begins a stage of the loading programme. Displacements and other accumulated
     * quantities are reset, and the points to be removed are selected.
     * @return remarks
     * @throws StepFailure if the stage removes no point, or all points
     */
    std::vector<std::string>
    begin_stage(const Stage &stage, const double t);

    /**
     * Advances the solution from t to t + h. An interrupted step is continued from
     * the time of the interruption.
     * @throws Stopped, at the end of an explicit step
     * @throws StepFailure if points leave the grid, volumes vanish, values are
     * not finite, or a prescribed step is unstable
     */
    ExplicitReport
    advance(const Stage &stage, const double t, const double h);

    /** Checks that a stage required to end in equilibrium has reached equilibrium.
     *  @throws StepFailure otherwise */
    void
    check_equilibrium(const Stage          &stage,
                      const ExplicitState  &state,
                      const ExplicitReport &report) const;

    /** @name Collective functions */
    /** @{ */
    ExplicitState
    state() const;
    Exchange
    exchange() const;
    LawCounts
    law_counts() const;
    /** @} */

    /** Points of this rank, one group per material. */
    const std::vector<PointArrays> &
    points() const
    {
      return groups;
    }

    const GridTransfer &
    grid() const
    {
      return *transfer;
    }

    const PoreWater &
    pore_water() const
    {
      return water;
    }

    /** Number of points of this rank. */
    unsigned long
    n_points_of_rank() const
    {
      unsigned long n = 0;
      for (const PointArrays &group : groups)
        n += group.n_points();
      return n;
    }

    std::string
    element() const
    {
      return space.element();
    }

    /** Name of the order of operations: MUSL, USL or USF. */
    std::string
    order_name() const
    {
      return order.word();
    }

    /** @name State of the method as part of a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive &archive);

    /** Replaces the points seeded in prepare() with the points of a checkpoint.
     *  @throws RunError if the checkpoint does not match the scene */
    void
    load(const Archive &archive);
    /** @} */

    /** Memory used by the points and nodes of this rank (bytes). */
    std::size_t
    memory() const;

    /** Wall time spent in each phase of the explicit steps (s). */
    struct Seconds
    {
      double passes = 0., grid = 0., exchange = 0., refresh = 0.;
    };
    const Seconds &
    seconds() const
    {
      return clock;
    }

    /** Number of explicit steps since the start of the run, and number of point
     *  updates (points times steps) on this rank. */
    unsigned long n_steps       = 0;
    double        n_point_steps = 0.;

    /** Access to the background mesh and to the seeding of the points. */
    BackgroundMesh &
    background_mesh()
    {
      return mesh;
    }
    Seeding &
    seeds()
    {
      return seeding;
    }

  private:
    enum class Order
    {
      musl,
      usl,
      usf
    };

    /** Data scattered from the points to the nodes in one pass over the points. */
    enum class ScatteredData
    {
      nothing,
      momentum,
      force,
      momentum_and_mass,
      all
    };

    void
    check_parameters() const;

    /** Creates the points and the transfer between points and grid. The grid is
     *  uniform if possible and if there are no boundary forces, otherwise it is a
     *  mesh. */
    void
    make_transfer(const Method &method, std::vector<std::string> &remarks);

    /** Seeds the points on a uniform grid. Each point is created on the rank that
     *  owns its position. */
    void
    seed_columns(const CartesianGrid &grid, std::vector<std::string> &remarks);

    /** Creates an empty group of points with a given material. */
    PointArrays
    make_group(const unsigned int material) const;

    /** Creates the material points of this rank from the seeds. @param n number of
     *  points per material
     *  @param for_each calls a function for each seed of this rank */
    void
    seed_points(const std::vector<std::size_t>                   &n,
                const std::function<void(const Seeding::Take &)> &for_each,
                std::vector<std::string>                         &remarks);

    /** Removes the points that a stage excavates, or starts to ramp down their
     *  mass. */
    std::string
    remove_points(const Stage &stage, const double t);

    void
    end_removal();

    TransferBlock
    block(const unsigned int group, const unsigned int first);

    /** Performs one pass over all points: gathers from the nodes, updates the
     *  points and scatters to the nodes. */
    void
    pass(const Update update, const ScatteredData scattered, const double dt);

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

    /** Returns true if the scene has tractions or absorbing boundaries. Boundary
     *  forces require a transfer on a mesh with boundary segments. */
    bool
    acts_on_sides() const;

    /** Scatters the data of the points to the nodes at the start of a step. */
    void
    start_nodes();

    /** Performs one explicit step of size dt. @param measures_force whether to
     *  compute the unbalanced force */
    void
    step(const Stage &stage,
         const double t,
         const double dt,
         const bool   measures_force);

    /** Sorts the points by cell and recomputes the nodal values at the start of
     *  a step. */
    void
    refresh();

    /** Total mass of the points of this rank (kg/m). */
    double
    current_mass() const;

    /** Coordinate x (m) to the left of which a given mass lies. The search
     *  interval is [left, right]. */
    double
    mass_quantile(const double wanted, double left, double right) const;

    /** Critical time step (s), at a Courant number of 1. */
    double
    stability_limit() const;

    void
    stop_at_peak();

    /** Sets the velocity of all points to zero and adds their kinetic energy to
     *  Exchange::stopped_energy. */
    void
    stop_points();

    /** Combines the results of the last pass over the points on all ranks.
     *  Decides whether the points must be sorted again (refresh). */
    void
    gather_sums();

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

    const MPI_Comm comm;
    BackgroundMesh mesh;
    Space          space;
    Seeding        seeding;
    Outflow        outflow;
    RankBalance    balance;

    ParticleTransfer rule;

    Choice<Order> order = {
      {{"MUSL", Order::musl}, {"USL", Order::usl}, {"USF", Order::usf}}};

    double       courant        = 0.3;
    double       fixed_step     = 0.;
    bool         allow_unstable = false;
    double       largest_strain = 0.;
    bool         fast_path      = true;
    unsigned int sort_every     = 50;

    const Scene                    *scene        = nullptr;
    bool                            affine       = false;
    bool                            b_bar        = false;
    bool                            axisymmetric = false;
    const TransferKernels          *kernels      = nullptr;
    std::unique_ptr<GridTransfer>   transfer;
    std::unique_ptr<BoundaryForces> boundary; ///< boundary forces, or null
    std::unique_ptr<NodalUpdate>    nodes;
    PoreWater                       water;
    std::vector<PointArrays>        groups;
    BlockScratch                    scratch = {};
    std::vector<double *>           history;       ///< arrays passed to the law
    std::vector<double>             point_history; ///< history of one point

    dealii::Point<dim>     datum;
    dealii::Tensor<1, dim> gravity; ///< of the last step (m/s^2)
    double                 least_mass   = 0.;
    double                 body_mass    = 0.; ///< mass of this rank (kg/m)
    double                 hoop_force   = 0.; ///< last force, this rank (N)
    double                 least_radius = 0.;
    double                 mass_ratio   = 1.; ///< of the last pass
    double                 fade_end     = 0.;
    double                 last_step    = 0.;
    PassSums               sums; ///< last pass; global after gather_sums()
    bool                   must_refresh  = true;
    unsigned int           since_refresh = 0;
    bool                   some_left     = false; ///< points without mass exist
    int         asked_to_stop = 0; ///< signal or 0, after gather_sums()
    std::string error_message;     ///< of this rank

    /** Progress within a step of the loading programme. */
    struct Progress
    {
      bool           begun = false;
      double         now   = 0.; ///< (s)
      ExplicitReport report;
    };
    Progress progress;

    /** Reads the values of the points on this rank from a checkpoint. Collective. */
    std::vector<double>
    points_of_rank(const Archive     &archive,
                   const std::string &name,
                   const std::size_t  size) const;

    /** Saves the data of each rank to a checkpoint, or restores them from one.
     *  The points are excluded. Data common to all ranks are handled by
     *  state_of_all(). */
    void
    state_of_ranks(StateRow &row);
    void
    state_of_all(StateRow &row);

    /** Kinetic energy at the end of the previous step (J/m), used by kinetic
     *  damping. The flag `rising` is true while the energy increases. */
    double energy_n = 0.;
    bool   rising   = false;

    Exchange  sum;
    Exchange  stage_start; ///< sum at the start, global
    LawCounts counts;
    Seconds   clock;
  };
} // namespace geocone::GEOCONE_DIM

#endif
