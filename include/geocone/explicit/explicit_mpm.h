// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_explicit_mpm_h
#define geocone_explicit_explicit_mpm_h

#include <geocone/base/archive.h>
#include <geocone/explicit/explicit_parameters.h>
#include <geocone/explicit/explicit_points.h>
#include <geocone/explicit/nodal_update.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/points/rank_balance.h>
#include <geocone/points/seeding.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
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
   * The points are occasionally sorted by cell. The last pass of a step also
   * scatters the data of the next step: USL requires one pass per step, MUSL
   * and USF two.
   */
  class ExplicitMPM
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

    /** Total exchange of all ranks. Collective. */
    Exchange
    exchange() const;

    const ExplicitPoints &
    points() const
    {
      return body;
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
      return parameters.order.word();
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

    /** Number of explicit steps since the start of the run. */
    unsigned long n_steps = 0;

    /** Displacements of the obstacles since the start of the run. */
    std::vector<RigidMotion>
    moved_obstacles() const
    {
      return obstacles ? obstacles->moved() : std::vector<RigidMotion>();
    }

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
    using Order         = ExplicitParameters::Order;
    using ScatteredData = ExplicitPoints::ScatteredData;

    void
    check_parameters() const;

    /** @throws InputError for contact that explicit steps do not have */
    void
    check_contact() const;

    /** Creates the points and the transfer between points and grid. The grid is
     *  uniform if possible and if there are no boundary forces, otherwise it is a
     *  mesh.
     *  @return the largest mass of a point (kg/m) */
    double
    make_transfer(const Method &method, std::vector<std::string> &remarks);

    /** Seeds the points on a uniform grid. Each point is created on the rank that
     *  owns its position. @return the largest mass of a point (kg/m) */
    double
    seed_columns(const CartesianGrid &grid, std::vector<std::string> &remarks);

    /** Returns true if the scene has tractions or absorbing boundaries. Boundary
     *  forces require a transfer on a mesh with boundary segments. */
    bool
    acts_on_sides() const;

    /** Performs a pass over all points, see ExplicitPoints::pass(). */
    void
    pass(const Update update, const ScatteredData scattered, const double dt);

    /** Sums over all ranks the nodal values that points have scattered. */
    void
    exchange_nodes(const bool with_mass);

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

    /** Ends the gradual removal of points. */
    void
    end_removal();

    /** Kinetic damping: sets all velocities to zero after a maximum of the kinetic
     *  energy. */
    void
    stop_at_peak();

    /** Saves the data of each rank to a checkpoint, or restores them from one.
     *  The points are excluded. Data common to all ranks are handled by
     *  state_of_all(). */
    void
    state_of_ranks(StateRow &row);
    void
    state_of_all(StateRow &row);

    const MPI_Comm     comm;
    ExplicitParameters parameters;
    BackgroundMesh     mesh;
    Space              space;
    Seeding            seeding;
    RankBalance        balance;

    Exchange                        sum; ///< of this rank
    ExplicitPoints                  body;
    const Scene                    *scene = nullptr;
    std::unique_ptr<BoundaryForces> boundary; ///< boundary forces, or null
    std::unique_ptr<ExplicitObstacles> obstacles; ///< or null
    std::unique_ptr<NodalUpdate>    nodes;

    dealii::Tensor<1, dim> gravity;        ///< of the last step (m/s^2)
    double                 body_mass = 0.; ///< mass of this rank (kg/m)
    double                 fade_end  = 0.; ///< of a gradual removal (s), or 0
    double                 last_step = 0.; ///< (s)
    bool                   must_refresh  = true;
    unsigned int           since_refresh = 0;

    /** Progress within a step of the loading programme. */
    struct Progress
    {
      bool           begun = false;
      double         now   = 0.; ///< (s)
      ExplicitReport report;
    };
    Progress progress;

    /** Kinetic energy at the end of the previous step (J/m), and whether it
     *  increases. */
    struct KineticDamping
    {
      double energy = 0.;
      bool   rising = false;
    };
    KineticDamping damping;

    Exchange stage_start; ///< sum at the start of the stage, global
    Seconds  clock;
  };
} // namespace geocone::GEOCONE_DIM

#endif
