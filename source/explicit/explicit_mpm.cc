// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/stopwatch.h>
#include <geocone/explicit/explicit_mpm.h>
#include <geocone/time_stepping/check_removal.h>
#include <geocone/time_stepping/time_stepper.h>
#include <geocone/transfer/cartesian_transfer.h>
#include <geocone/transfer/mesh_transfer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** @name Updates of the points in a pass */
    /** @{ */
    //                                        strain velocity position
    constexpr Update nothing               = {false, false, false};
    constexpr Update strain                = {true, false, false};
    constexpr Update velocity              = {false, true, false};
    constexpr Update strain_and_position   = {true, false, true};
    constexpr Update velocity_and_position = {false, true, true};
    constexpr Update everything            = {true, true, true};
    /** @} */
  } // namespace

  ExplicitMPM::ExplicitMPM(const MPI_Comm comm, const ParameterFile &file)
    : comm(comm)
    , mesh(comm)
    , seeding(file)
    , body(comm, sum)
  {}

  void
  ExplicitMPM::check_parameters() const
  {
    parameters.check();
    scene->structures.refuse("explicit MPM", "set Discretisation/Method = FEM");
    if (!body.pore_water().acts())
      {
        const std::string what =
          std::string("explicit MPM without ") + Drainage::parameter;
        scene->water.refuse(what,
                            "set Discretisation/Method = FEM or MPM, or give "
                            "buoyant densities");
        scene->materials.refuse_undrained(
          what,
          "set it to true, or Discretisation/Method = FEM or MPM, or take "
          "Tresca with the undrained strength");
      }
    else if (parameters.order == Order::usf)
      throw InputError("Explicit/Order",
                       parameters.order.word(),
                       std::string("MUSL | USL with ") + Drainage::parameter,
                       "take MUSL");
    scene->regions.refuse_fixed("explicit MPM");
    check_contact();
    for (const auto &condition : scene->dirichlet.list)
      {
        condition->refuse_normal("free with explicit MPM",
                                 "give Velocity x and y, or set "
                                 "Discretisation/Method = FEM");
        if (condition->moves_with_body())
          throw InputError(condition->parameter("Imposed on"),
                           condition->imposition.word(),
                           "nodes with explicit MPM",
                           "prescribe velocities on sides of the background "
                           "mesh, or set Discretisation/Method = MPM");
      }
  }

  void
  ExplicitMPM::check_contact() const
  {
    scene->contacts.refuse("explicit MPM",
                           "set Discretisation/Method = FEM or MPM, or leave "
                           "it out: points of all materials share the grid");
    if (scene->obstacles.list.empty())
      return;
    if (parameters.order == Order::usf)
      throw InputError("Explicit/Order",
                       parameters.order.word(),
                       "MUSL | USL with obstacles",
                       "take MUSL");
    if (body.pore_water().acts())
      throw InputError("Obstacles/Names",
                       scene->obstacles.list.front()->name,
                       std::string("nothing with explicit MPM and ") +
                         Drainage::parameter,
                       "hold the body by 'Boundary conditions'");
  }

  bool
  ExplicitMPM::acts_on_sides() const
  {
    return !scene->tractions.list.empty() || !scene->absorbing.list.empty();
  }

  double
  ExplicitMPM::make_transfer(const Method             &method,
                             std::vector<std::string> &remarks)
  {
    const auto               lines = mesh.uniform_lines(*scene, method);
    Point<dim>               datum;
    std::vector<std::string> sides;
    if (parameters.fast_path && !lines[0].empty() && !acts_on_sides())
      {
        space.choose_element(false, true, method);
        const CartesianGrid grid(space.degree(), lines);
        for (unsigned int d = 0; d < dim; ++d)
          {
            datum[d] = lines[d].front();
            sides.insert(sides.end(), side_of_box[d], side_of_box[d] + 2);
          }
        body.use(
          std::make_unique<CartesianTransfer>(
            comm, grid, scene->dirichlet, scene->loading.list.front()->name),
          datum,
          sides);
        return seed_columns(grid, remarks);
      }
    mesh.prepare(*scene, method);
    space.prepare(mesh, method);
    for (const auto &side : mesh.named_sides())
      sides.push_back(side.first);
    body.use(std::make_unique<MeshTransfer>(*scene, mesh, space, balance),
             mesh.lower_corner(),
             sides);
    return body.seed(
      seeding.count(*scene, mesh),
      [&](const Seeding::Take &take) { seeding.for_each(*scene, mesh, take); },
      space,
      remarks);
  }

  double
  ExplicitMPM::seed_columns(const CartesianGrid      &grid,
                            std::vector<std::string> &remarks)
  {
    const auto               in_column = seeding.count(*scene, grid, comm);
    std::vector<std::size_t> points_in;
    for (const auto &of_material : in_column)
      points_in.push_back(std::accumulate(
        of_material.begin(), of_material.end(), std::size_t(0)));
    const auto slabs =
      grid.slabs(points_in, Utilities::MPI::n_mpi_processes(comm));
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    const std::array<unsigned int, 2> own = {
      {static_cast<unsigned int>(slabs[rank]),
       static_cast<unsigned int>(slabs[rank + 1])}};
    std::vector<std::size_t> n(scene->materials.size(), 0);
    for (unsigned int column = own[0]; column < own[1]; ++column)
      for (unsigned int m = 0; m < n.size(); ++m)
        n[m] += in_column[column][m];
    return body.seed(
      n,
      [&](const Seeding::Take &take) {
        seeding.for_each(*scene, grid, own, take);
      },
      space,
      remarks);
  }

  std::vector<std::string>
  ExplicitMPM::prepare(const Scene &scene_, const Method &method)
  {
    scene = &scene_;
    check_parameters();
    check_axisymmetric_body(*scene);
    body.prepare(*scene, space.has_b_bar());
    seeding.prepare(*scene);
    balance.prepare();

    std::vector<std::string> remarks;
    const double             largest_mass = make_transfer(method, remarks);

    if (space.has_b_bar() && space.is_spline() &&
        scene->materials.traits().dilates)
      remarks.push_back(
        "in explicit steps B-bar makes soil that dilates too strong with "
        "splines: each point should grow as it is sheared, but the points of a "
        "cell grow alike; set Discretisation/B-bar = false, or the dilatancy "
        "to 0, or take implicit steps");
    if (!scene->tractions.list.empty())
      remarks.push_back(
        "tractions in explicit steps: where particles cross cells near the "
        "loaded side, stresses scatter by a fifth of the traction with "
        "splines, "
        "and by more with Q1, whose side settles too far; take "
        "Discretisation/Method = MPM with splines, or press by an obstacle");
    const ParticleTransfer &rule = body.transfer_rule();
    if (rule.is_affine() && space.degree() == 1)
      throw InputError(ParticleTransfer::parameter,
                       rule.name(),
                       "FLIP | PIC where the element is Q1",
                       "take splines for " + rule.name() +
                         ": with Q1 the noise of nodes with "
                         "little mass grows from step to step");

    GridTransfer &transfer = body.grid();
    if (const auto given = scene->observation.moment_centre())
      std::fill(transfer.centres.begin(), transfer.centres.end(), *given);
    if (acts_on_sides())
      boundary = std::make_unique<BoundaryForces>(*scene, mesh, space);
    if (!scene->obstacles.list.empty())
      {
        obstacles = std::make_unique<ExplicitObstacles>(*scene, transfer, comm);
        obstacles->check(body.groups());
      }
    PoreWater &water = body.pore_water();
    nodes            = std::make_unique<NodalUpdate>(transfer,
                                          scene->dirichlet,
                                          rule.flip_part(),
                                          1e-14 * largest_mass,
                                          boundary.get(),
                                          water.acts() ? &water : nullptr,
                                          obstacles.get(),
                                          sum);
    refresh();
    if (const Stage &first = *scene->loading.list.front(); first.removes())
      {
        const auto [n_removed, n] = body.n_removed_by(first);
        check_removal(first, n_removed, n, "points");
      }
    parameters.check_steps(scene->loading, body.stability_limit());
    return remarks;
  }

  void
  ExplicitMPM::pass(const Update        update,
                    const ScatteredData scattered,
                    const double        dt)
  {
    const Stopwatch watch(clock.passes);
    body.pass(update, scattered, dt);
  }

  void
  ExplicitMPM::exchange_nodes(const bool with_mass)
  {
    const Stopwatch watch(clock.exchange);
    body.grid().exchange(with_mass);
    if (body.pore_water().acts())
      body.pore_water().exchange(with_mass);
  }

  void
  ExplicitMPM::start_nodes()
  {
    if (body.pore_water().acts())
      body.pore_water().reset_nodes();
    pass(nothing,
         parameters.order == Order::usf ? ScatteredData::momentum_and_mass
                                        : ScatteredData::all,
         0.);
    exchange_nodes(true);
  }

  void
  ExplicitMPM::refresh()
  {
    {
      const Stopwatch watch(clock.refresh);
      if (body.sort() && boundary)
        boundary->follow_ranks();
    }
    start_nodes();
    if (obstacles)
      obstacles->list_points(body.groups());
    nodes->mark_held();
    body_mass     = body.mass_of_rank();
    must_refresh  = false;
    since_refresh = 0;
  }

  void
  ExplicitMPM::step(const Stage &stage,
                    const double t,
                    const double dt,
                    const bool   measures_force)
  {
    gravity = scene->gravity.at(t + dt / 2.);
    body.begin_step(fade_end > t ? std::max(0., 1. - dt / (fade_end - t)) : 0.);
    if (boundary)
      boundary->begin_step(t + dt / 2.);
    if (obstacles)
      obstacles->begin_step(body.groups(), body.last_sums(), t, dt);
    const NodalUpdate::Step at_nodes = {
      t, dt, gravity, stage.damping, measures_force};
    const auto accelerate = [&](const bool velocity_is_read, const bool moves) {
      const Stopwatch watch(clock.grid);
      sum.impulse[0] += dt * body.hoop_force();
      nodes->accelerate(at_nodes, velocity_is_read, moves);
      if (boundary)
        boundary->move(body.grid(), dt);
    };
    // Data for the next step would be useless if the transfer is refreshed
    // before it.
    const bool gives_next = !body.grid().moves_each_step();
    const auto scattered  = [&](const ScatteredData what) {
      return gives_next ? what : ScatteredData::nothing;
    };
    if (parameters.order == Order::usl)
      {
        accelerate(false, true);
        pass(everything, scattered(ScatteredData::all), dt);
      }
    else if (parameters.order == Order::musl)
      {
        accelerate(false, false);
        pass(velocity, ScatteredData::momentum, dt);
        exchange_nodes(false);
        {
          const Stopwatch watch(clock.grid);
          nodes->velocity_after(at_nodes);
        }
        pass(strain_and_position, scattered(ScatteredData::all), dt);
      }
    else
      {
        {
          const Stopwatch watch(clock.grid);
          nodes->velocity_before(t);
        }
        pass(strain, ScatteredData::force, dt);
        exchange_nodes(false);
        accelerate(true, true);
        pass(velocity_and_position,
             scattered(ScatteredData::momentum_and_mass),
             dt);
      }
    if (gives_next)
      exchange_nodes(true);
    else
      must_refresh = true;
    if (obstacles)
      obstacles->move();
    sum.stress_work += body.last_sums().work;
    sum.impulse += dt * body_mass * gravity;
    if (body.pore_water().acts())
      {
        const PoreWater::Totals of_water = body.pore_water().take_totals();
        sum.stress_work += of_water.pressure_work;
        sum.support_work += of_water.work;
        sum.seepage_work += of_water.loss;
        sum.outflow += of_water.outflow;
        sum.impulse += of_water.impulse;
      }
    if (fade_end > 0.)
      body_mass = body.mass_of_rank();
    ++n_steps;
    ++since_refresh;
  }

  ExplicitReport
  ExplicitMPM::advance(const Stage &stage, const double t, const double h)
  {
    if (!progress.begun)
      progress = {true, t, {}};
    if (body.grid().begin_stage(stage.name))
      must_refresh = true;
    ExplicitReport &report = progress.report;
    double         &now    = progress.now;
    const double    end    = t + h;
    while (now < end)
      {
        if (must_refresh || since_refresh >= parameters.sort_every)
          refresh();
        double dt = parameters.step_size(
          now, body.stability_limit(), body.last_sums(), last_step);
        // Ends exactly, without a tiny last step.
        const double left = end - now;
        const bool   last = left <= dt * (1. + 1e-9);
        if (last)
          dt = left;
        else if (left < 2. * dt && parameters.fixed_step == 0.)
          dt = left / 2.;
        step(stage, now, dt, last);
        last_step                                 = dt;
        now                                       = last ? end : now + dt;
        const ExplicitPoints::Decisions decisions = body.combine(must_refresh);
        must_refresh                              = decisions.must_sort;
        // The end of a record outputs and tests unmodified velocities.
        if (stage.kinetic_damping && !last)
          stop_at_peak();
        if (fade_end > 0. && now >= fade_end * (1. - 1e-12))
          end_removal();
        ++report.n_steps;
        report.largest_step = std::max(report.largest_step, dt);
        report.smallest_step =
          report.smallest_step == 0. ? dt : std::min(report.smallest_step, dt);
        if (decisions.stop_signal > 0 && now < end)
          throw Stopped(decisions.stop_signal);
      }
    // Detects points that have left before any evaluation.
    if (must_refresh)
      refresh();
    report.unbalanced_force =
      Utilities::MPI::max(nodes->unbalanced_force(), comm);
    report.reactions = nodes->take_support_impulses();
    if (obstacles)
      for (const Reaction &one : obstacles->take_impulses())
        report.reactions.push_back(one);
    sum_states_over_ranks(report.reactions, comm);
    for (Reaction &reaction : report.reactions)
      {
        reaction.force /= h;
        reaction.moment /= h;
      }
    progress.begun = false;
    return report;
  }

  Exchange
  ExplicitMPM::exchange() const
  {
    std::vector<Exchange> all = {sum};
    sum_states_over_ranks(all, comm);
    return all[0];
  }
} // namespace geocone::GEOCONE_DIM
