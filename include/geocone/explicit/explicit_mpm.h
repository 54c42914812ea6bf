// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_explicit_mpm_h
#define geocone_explicit_explicit_mpm_h

#include <geocone/base/archive.h>
#include <geocone/base/choice.h>
#include <geocone/explicit/nodal_update.h>
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
  /** State of the points at one time, over all ranks. Its reactions are those
   *  of the ExplicitReport of the step. */
  struct ExplicitState : StepEnd
  {
    unsigned long          n_points = 0;
    double                 mass     = 0.; ///< (kg/m)
    double                 volume   = 0.; ///< (m^2)
    dealii::Tensor<1, dim> momentum;      ///< (N s/m)
    /** About the axes of n_rotations through the origin. */
    dealii::Tensor<1, n_rotations> angular_momentum;
    dealii::Point<dim> lower, upper; ///< bounds of the positions (m)
    /** Positions x to the left of which lie 1 and 99 % of the mass (m). */
    double left_front = 0., right_front = 0.;
    double largest_speed = 0.; ///< (m/s)

    /** Point with the fastest elastic wave, which limits the step: its number,
     *  position and wave speed. */
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
          limiting_id,
          limiting_place,
          limiting_wave_speed);
    }
  };

  /** Statistics of the explicit steps between two records. */
  struct ExplicitReport
  {
    unsigned int n_steps       = 0;
    double       smallest_step = 0., largest_step = 0.; ///< (s)

    /** Largest unbalanced force of a free node in the last step (N/m). */
    double unbalanced_force = 0.;

    /** Mean force on the body per condition, and mean moment. */
    std::vector<Reaction> reactions;

    /** Checkpoint data of an incomplete step: without reactions. */
    void
    state(StateRow &row)
    {
      row(n_steps, smallest_step, largest_step, unbalanced_force);
    }
  };

  /**
   * The explicit material point method of the STSM report (section 2): many
   * small steps, each as long as the elastic wave allows,
   *   dt = C h/(c + v),  c^2 = max M V/m,  v = max |v_p|.
   * With N at the start of the step, and conditions on the sides of the grid,
   * the three orders of operations are
   *   MUSL: a = F/m; v_p += dt sum N a; v = sum m_p v_p N/m; stress; x_p += dt
   *         sum N v   (the report's eleven steps);
   *   USL:  a = F/m; v = sum m_p v_p N/m + dt a; v_p += dt sum N a; stress; x_p;
   *   USF:  v = sum m_p v_p N/m; stress; a = F/m; v_p += dt sum N a; x_p.
   * The mass of a node is a divisor only in bounded quotients or if the
   * quotient is multiplied by N again. Nodes with less than 1e-14 of the
   * largest point's mass are skipped and counted.
   *
   * Passes over the points process blocks that stay in cache, with the points
   * occasionally sorted by cell. Each step writes the data for the next in its
   * last pass: USL makes one pass per step, the others two.
   */
  class ExplicitMPM : public dealii::ParameterAcceptor
  {
  public:
    ExplicitMPM(const MPI_Comm comm, const ParameterFile &file);

    /**
     * Seeds the body.
     * @return remarks on findings and changes
     * @throws InputError
     */
    std::vector<std::string>
    prepare(const Scene &scene, const Method &method);

    /**
     * Begins a stage: resets quantities and selects points to be removed.
     * @return remarks
     * @throws StepFailure if it removes no point, or all of them
     */
    std::vector<std::string>
    begin_stage(const Stage &stage, const double t);

    /**
     * Advances from t, or from where it was stopped, to t + h.
     * @throws Stopped, at the end of an explicit step
     * @throws StepFailure if points leave the grid, volumes vanish, values are
     * not finite, or a prescribed step is unstable
     */
    ExplicitReport
    advance(const Stage &stage, const double t, const double h);

    /** @throws StepFailure if a stage that must end in equilibrium does not */
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

    /** Points of this rank, a group per material. */
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

    /** Name of the order of operations. */
    std::string
    order_name() const
    {
      return order.word();
    }

    /** @name State, as part of a checkpoint. Collective. */
    /** @{ */
    void
    save(Archive &archive);

    /** Replaces the points seeded by prepare().
     *  @throws RunError if it does not fit */
    void
    load(const Archive &archive);
    /** @} */

    /** Memory of points and nodes of this rank in bytes. */
    std::size_t
    memory() const;

    /** Wall time of the parts of the steps in seconds. */
    struct Seconds
    {
      double passes = 0., grid = 0., exchange = 0., refresh = 0.;
    };
    const Seconds &
    seconds() const
    {
      return clock;
    }

    /** Number of explicit steps, and of points times steps, since the start on
     *  this rank. */
    unsigned long n_steps       = 0;
    double        n_point_steps = 0.;

    /** Background mesh, and seeding of the points. */
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

    /** Data transferred to the nodes in a pass. */
    enum class Gives
    {
      nothing,
      momentum,
      force,
      momentum_and_mass,
      all
    };

    void
    check_parameters() const;

    /** Creates the transfer (on a uniform grid if possible and if no forces act
     *  on sides, otherwise on a mesh) and its points. */
    void
    make_transfer(const Method &method, std::vector<std::string> &remarks);

    /** Seeds the points of a uniform grid on the ranks that own their
     *  positions. */
    void
    seed_columns(const CartesianGrid &grid, std::vector<std::string> &remarks);

    /** Allocates points of a material. */
    PointArrays
    make_group(const unsigned int material) const;

    /** Creates the points. @param n their numbers on this rank by material
     *  @param for_each calls its argument with each seed of this rank */
    void
    seed_points(const std::vector<std::size_t>                   &n,
                const std::function<void(const Seeding::Take &)> &for_each,
                std::vector<std::string>                         &remarks);

    /** Removes points by a stage, or begins their removal. */
    std::string
    remove_points(const Stage &stage, const double t);

    void
    end_removal();

    TransferBlock
    block(const unsigned int group, const unsigned int first);

    /** A pass over all points, which gather from the nodes and scatter to
     *  them. */
    void
    pass(const Update update, const Gives gives, const double dt);

    /** Gathers velocities and strains from the nodes for a block of points, and
     *  updates stresses and positions. */
    void
    take(const Update update, const double dt, const TransferBlock &points);
    void
    follow_law(const Update         update,
               const double         dt,
               const TransferBlock &points);

    /** Updates the bounds of positions, and treats points outside the stored
     *  nodes. */
    void
    bound_positions(const TransferBlock &points);

    /** Scatters the data of a block of points to the nodes. */
    void
    give(const Gives gives, const TransferBlock &points);

    void
    for_each_block(const std::function<void(const TransferBlock &)> &action);

    /** @name B-bar */
    /** @{ */
    /** Averages values of points over the cells. Collective. */
    void
    average_in_cells(
      const std::function<const double *(const TransferBlock &)> &values_at);

    /** Computes BlockScratch::mean_stress at the points. */
    void
    find_mean_stress(const TransferBlock &points);
    /** @} */

    /** @name Axisymmetric: hoop strain, in a pass after points may have moved,
     *  and the force of the hoop stress */
    /** @{ */
    /** Hoop strain rate v_r/r at a point of a block, from the gathered velocity
     *  (1/s). */
    double
    hoop_rate(const unsigned int k, const double r) const;

    void
    strain_around_axis(const Update         update,
                       const double         dt,
                       const TransferBlock &points);
    void
    force_around_axis(const TransferBlock &points);
    /** @} */

    /** Reduces mass and volume of a block of points that are being removed. */
    void
    fade_points(const TransferBlock &points);

    /** Message that a point has left the mesh. */
    std::string
    has_left(const PointArrays &group, const unsigned int p) const;

    /** Treats points that have left the stored nodes. */
    void
    mend_positions(const TransferBlock &points);

    /** Whether the scene has tractions or absorbing boundaries: then points are
     *  located in the cells of a mesh with sides. */
    bool
    acts_on_sides() const;

    /** Transfers the points to the nodes at the start of a step. */
    void
    start_nodes();

    /** Performs an explicit step. @param measures_force whether to compute the
     *  unbalanced force */
    void
    step(const Stage &stage,
         const double t,
         const double dt,
         const bool   measures_force);

    /** Refreshes the transfer and the nodal values at the start of a step. */
    void
    refresh();

    /** Mass of the points of this rank (kg/m). */
    double
    current_mass() const;

    /** Position with the given mass on its left (m), within a range. */
    double
    mass_quantile(const double wanted, double left, double right) const;

    /** Largest stable step, for Courant number 1 (s). */
    double
    stability_limit() const;

    void
    stop_at_peak();

    /** Sets the velocity of all points to zero, and adds the kinetic energy to
     *  that removed by kinetic damping. */
    void
    stop_points();

    /** Sums the results of the last pass over all ranks; decides whether to
     *  refresh. */
    void
    gather_sums();

    /** Counts a point as removed and sets its mass to zero. */
    void
    take_away(PointArrays &group, const unsigned int p);

    /** Removes the points without mass. */
    void
    remove_massless();

    double
    kinetic_energy(const PointArrays &group, const unsigned int p) const;

    /** As Geometry::unit(). */
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
    std::unique_ptr<BoundaryForces> boundary; ///< or null
    std::unique_ptr<NodalUpdate>    nodes;
    std::vector<PointArrays>        groups;
    BlockScratch                    scratch = {};
    std::vector<double *>           history;       ///< pointers for the law
    std::vector<double>             point_history; ///< of one point

    dealii::Point<dim>     datum;
    dealii::Tensor<1, dim> gravity; ///< in the last step
    double                 least_mass   = 0.;
    double                 body_mass    = 0.; ///< of this rank's points (kg/m)
    double                 hoop_force   = 0.; ///< last one, of this rank (N)
    double                 least_radius = 0.;
    double                 fade         = 1.; ///< of the last pass of this step
    double                 fade_end     = 0.;
    double                 last_step    = 0.;
    PassSums     sums; ///< of the last pass; after gather_sums() of all
    bool         must_refresh  = true;
    unsigned int since_refresh = 0;
    bool         some_left     = false; ///< some points have no mass
    int          asked_to_stop = 0;     ///< signal, after gather_sums()
    std::string  obstacle;              ///< error of this rank

    /** Progress within a step of the loading programme. */
    struct Progress
    {
      bool           begun = false;
      double         now   = 0.; ///< (s)
      ExplicitReport report;
    };
    Progress progress;

    /** Points of a checkpoint for this rank. Collective. */
    std::vector<double>
    points_of_rank(const Archive     &archive,
                   const std::string &name,
                   const std::size_t  size) const;

    /** All numbers of the state except the points. */
    void
    state_of_ranks(StateRow &row);
    void
    state_of_all(StateRow &row);

    /** Kinetic damping: kinetic energy of the previous steps. */
    double energy_n = 0.;
    bool   rising   = false;

    Exchange  sum;
    Exchange  stage_start; ///< over all ranks
    LawCounts counts;
    Seconds   clock;
  };
} // namespace geocone::GEOCONE_DIM

#endif
