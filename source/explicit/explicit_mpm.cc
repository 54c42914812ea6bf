// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/stopwatch.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/explicit/explicit_mpm.h>
#include <geocone/time_stepping/check_removal.h>
#include <geocone/time_stepping/time_stepper.h>
#include <geocone/transfer/cartesian_transfer.h>
#include <geocone/transfer/mesh_transfer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_explicit_mpm[] = {
      {"Explicit/*", "Discretisation/Method", {"explicit MPM"}}};
  } // namespace

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

    /** @throws InputError if a stage has more steps than any run can perform */
    void
    check_number_of_steps(const LoadingProgramme &loading,
                          const double            fixed_step,
                          const double            courant,
                          const double            stability_limit)
    {
      constexpr double most     = 1e9;
      const bool       is_fixed = fixed_step > 0.;
      const double     step = is_fixed ? fixed_step : courant * stability_limit;
      for (const auto &stage : loading.list)
        if (!(stage->duration <= most * step))
          throw InputError(
            is_fixed ? "Explicit/Time step" : "Explicit/Courant number",
            is_fixed ? fixed_step : courant,
            format("steps of at least %.3g s, of which the stage '%s' has at "
                   "most %g",
                   stage->duration / most,
                   stage->name.c_str(),
                   most),
            is_fixed ? std::string("take a larger step, or 0 for the largest "
                                   "stable one")
                     : format("its steps are %.3g s: take a larger number, "
                              "larger cells, a softer body or a shorter "
                              "'Loading/%s/Duration'",
                              step,
                              stage->name.c_str()));
    }
  } // namespace

  ExplicitMPM::ExplicitMPM(const MPI_Comm comm, const ParameterFile &file)
    : ParameterAcceptor("/Explicit")
    , comm(comm)
    , mesh(comm)
    , seeding(file)
  {
    order.declare(
      *this,
      "Order",
      ". MUSL: velocities of points are updated first, and stresses follow "
      "from the velocities mapped back to the grid; tolerates small nodal "
      "masses. USL: stresses are updated last, in a single pass over the "
      "points; fastest, for B-splines. USF: stresses are updated first.");
    add_parameter(
      "Courant number",
      courant,
      "Courant number C [-] of the time step C h/(c + v), with the cell size "
      "h, the fastest elastic wave speed c and the largest speed v of a point; "
      "0 < C <= 1. For Element = Q1 use 0.1 to 0.3.");
    add_parameter("Time step",
                  fixed_step,
                  "Constant time step [s]; 0: from the Courant number, updated "
                  "in each step.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Allow unstable step",
                  allow_unstable,
                  "Whether a given time step may exceed h/(c + v).");
    add_parameter("Largest strain increment",
                  largest_strain,
                  "Limits the time step so that no displacement gradient "
                  "changes by more than about this value [-], estimated from "
                  "its rate in the previous step; 0: no limit.",
                  prm,
                  Patterns::Double(0.));
    add_parameter(
      "Fast path",
      fast_path,
      "Whether the faster algorithm for uniform grids is used. false: the "
      "algorithm for general meshes, for comparison; results are the same, "
      "except for Q1 and for points exactly on cell edges.");
    add_parameter("Sort every",
                  sort_every,
                  "Number of steps after which points are sorted by cell and "
                  "redistributed among the ranks (20 to 100 is fastest).",
                  prm,
                  Patterns::Integer(1));
  }

  void
  ExplicitMPM::check_parameters() const
  {
    const std::string section = "Explicit/";
    if (!(courant > 0. && courant <= 1.))
      throw InputError(
        section + "Courant number", courant, "0 < C <= 1", "0.3 is usual");

    scene->structures.refuse("explicit MPM",
                             "set Discretisation/Method = FEM");
    if (!water.acts())
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
    else if (order == Order::usf)
      throw InputError(section + "Order",
                       order.word(),
                       std::string("MUSL | USL with ") + Drainage::parameter,
                       "take MUSL");
    scene->regions.refuse_fixed("explicit MPM");
    scene->refuse_contact("explicit MPM",
                          "set Discretisation/Method = FEM or MPM, or hold "
                          "the body by 'Boundary conditions'");
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

  bool
  ExplicitMPM::acts_on_sides() const
  {
    return !scene->tractions.list.empty() || !scene->absorbing.list.empty();
  }

  void
  ExplicitMPM::make_transfer(const Method             &method,
                             std::vector<std::string> &remarks)
  {
    const auto lines = mesh.uniform_lines(*scene, method);
    if (fast_path && !lines[0].empty() && !acts_on_sides())
      {
        space.choose_element(false, true, method);
        const CartesianGrid grid(space.degree(), lines);
        transfer = std::make_unique<CartesianTransfer>(
          comm, grid, scene->dirichlet, scene->loading.list.front()->name);
        for (unsigned int d = 0; d < dim; ++d)
          datum[d] = lines[d].front();
        std::vector<std::string> names;
        for (unsigned int d = 0; d < dim; ++d)
          names.insert(names.end(), side_of_box[d], side_of_box[d] + 2);
        water.use(*transfer, names);
        seed_columns(grid, remarks);
      }
    else
      {
        mesh.prepare(*scene, method);
        space.prepare(mesh, method);
        transfer = std::make_unique<MeshTransfer>(*scene, mesh, space, balance);
        datum    = mesh.lower_corner();
        std::vector<std::string> names;
        for (const auto &side : mesh.named_sides())
          names.push_back(side.first);
        water.use(*transfer, names);
        seed_points(
          seeding.count(*scene, mesh),
          [&](const Seeding::Take &take) {
            seeding.for_each(*scene, mesh, take);
          },
          remarks);
      }
  }

  std::vector<std::string>
  ExplicitMPM::prepare(const Scene &scene_, const Method &method)
  {
    scene        = &scene_;
    affine       = rule.is_affine();
    b_bar        = space.has_b_bar();
    axisymmetric = scene->geometry.is_axisymmetric();
    check_parameters();
    check_axisymmetric_body(*scene);
    water.prepare(*scene, rule, b_bar);
    seeding.prepare(*scene);
    balance.prepare();
    kernels = &transfer_kernels();

    std::vector<std::string> remarks;
    make_transfer(method, remarks);

    if (b_bar && space.is_spline() && scene->materials.traits().dilates)
      remarks.push_back(
        "in explicit steps B-bar makes soil that dilates too strong with "
        "splines: each point should grow as it is sheared, but the points of a "
        "cell grow alike; set Discretisation/B-bar = false, or the dilatancy "
        "to 0, or take implicit steps");
    if (affine && space.degree() == 1)
      throw InputError(ParticleTransfer::parameter,
                       rule.name(),
                       "FLIP | PIC where the element is Q1",
                       "take splines for " + rule.name() +
                         ": with Q1 the noise of nodes with "
                         "little mass grows from step to step");

    least_radius = 1e-6 * transfer->cell_size();
    if (const auto given = scene->observation.moment_centre())
      std::fill(transfer->centres.begin(), transfer->centres.end(), *given);
    if (acts_on_sides())
      boundary = std::make_unique<BoundaryForces>(*scene, mesh, space);
    nodes = std::make_unique<NodalUpdate>(*transfer,
                                          scene->dirichlet,
                                          rule.flip_part(),
                                          least_mass,
                                          boundary.get(),
                                          water.acts() ? &water : nullptr,
                                          sum);
    refresh();
    if (fixed_step > stability_limit() && !allow_unstable)
      throw InputError("Explicit/Time step",
                       fixed_step,
                       "at most " + format("%.3g", stability_limit()) +
                         " s, which an elastic wave takes through a cell",
                       "take a smaller step, or 0 for the largest stable one; "
                       "'Explicit/Allow unstable step' = true forces it");
    if (const Stage &first = *scene->loading.list.front(); first.removes())
      {
        unsigned long n_removed = 0;
        for (const PointArrays &group : groups)
          for (unsigned int p = 0; p < group.n_points(); ++p)
            n_removed += first.removes(group.position.of(p));
        check_removal(first,
                      Utilities::MPI::sum(n_removed, comm),
                      Utilities::MPI::sum(
                        static_cast<unsigned long>(n_points_of_rank()), comm),
                      "points");
      }
    check_number_of_steps(
      scene->loading, fixed_step, courant, stability_limit());
    return remarks;
  }

  void
  ExplicitMPM::remove_massless()
  {
    for (PointArrays &group : groups)
      {
        std::vector<unsigned int> staying;
        for (unsigned int p = 0; p < group.n_points(); ++p)
          if (group.mass[p] > 0.)
            staying.push_back(p);
        if (staying.size() < group.n_points())
          group.reorder(staying);
      }
    some_left = false;
  }

  void
  ExplicitMPM::start_nodes()
  {
    const bool stress_first = order == Order::usf;
    if (water.acts())
      water.reset_nodes();
    pass(nothing,
         stress_first ? ScatteredData::momentum_and_mass : ScatteredData::all,
         0.);
    const Stopwatch watch(clock.exchange);
    transfer->exchange(true);
    if (water.acts())
      water.exchange(true);
  }

  void
  ExplicitMPM::refresh()
  {
    if (Utilities::MPI::logical_or(some_left, comm))
      remove_massless();
    if (Utilities::MPI::sum(n_points_of_rank(), comm) == 0)
      throw StepFailure("all points have left the background mesh\n"
                        "  remedy:  end the loading earlier, or enlarge "
                        "'Mesh/Box'");
    {
      const Stopwatch    watch(clock.refresh);
      const unsigned int before = transfer->n_repartitions();
      transfer->sort(groups);
      if (boundary && transfer->n_repartitions() > before)
        boundary->follow_ranks();
    }
    for (const auto &[g, p] : transfer->lost)
      {
        PointArrays &group = groups[g];
        if (outflow.is_error() && error_message.empty())
          error_message = lost_point_message(group, p);
        remove_point(group, p);
        some_left = true;
      }
    if (Utilities::MPI::logical_or(!error_message.empty(), comm))
      throw StepFailure(text_of_any_rank(comm, error_message));
    start_nodes();
    nodes->mark_held();
    body_mass     = current_mass();
    must_refresh  = false;
    since_refresh = 0;
  }

  double
  ExplicitMPM::stability_limit() const
  {
    return transfer->cell_size() /
           (std::sqrt(sums.wave_speed2) + std::sqrt(sums.speed2));
  }

  void
  ExplicitMPM::step(const Stage &stage,
                    const double t,
                    const double dt,
                    const bool   measures_force)
  {
    gravity = scene->gravity.at(t + dt / 2.);
    sums    = PassSums();
    mass_ratio = fade_end > t ? std::max(0., 1. - dt / (fade_end - t)) : 0.;
    if (boundary)
      boundary->begin_step(t + dt / 2.);
    const NodalUpdate::Step at_nodes = {
      t, dt, gravity, stage.damping, measures_force};
    const auto exchange = [&](const bool with_mass) {
      const Stopwatch watch(clock.exchange);
      transfer->exchange(with_mass);
      if (water.acts())
        water.exchange(with_mass);
    };
    const auto accelerate = [&](const bool velocity_is_read, const bool moves) {
      const Stopwatch watch(clock.grid);
      sum.impulse[0] += dt * hoop_force;
      nodes->accelerate(at_nodes, velocity_is_read, moves);
      if (boundary)
        boundary->move(*transfer, dt);
    };
    // Data for the next step would be useless if the transfer is refreshed
    // before it.
    const bool gives_next = !transfer->moves_each_step();
    const auto scattered  = [&](const ScatteredData what) {
      return gives_next ? what : ScatteredData::nothing;
    };
    if (order == Order::usl)
      {
        accelerate(false, true);
        pass(everything, scattered(ScatteredData::all), dt);
      }
    else if (order == Order::musl)
      {
        accelerate(false, false);
        pass(velocity, ScatteredData::momentum, dt);
        exchange(false);
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
        exchange(false);
        accelerate(true, true);
        pass(velocity_and_position,
             scattered(ScatteredData::momentum_and_mass),
             dt);
      }
    if (gives_next)
      exchange(true);
    else
      must_refresh = true;
    sum.stress_work += sums.work;
    sum.impulse += dt * body_mass * gravity;
    if (water.acts())
      {
        const PoreWater::Totals of_water = water.take_totals();
        sum.stress_work += of_water.pressure_work;
        sum.support_work += of_water.work;
        sum.seepage_work += of_water.loss;
        sum.outflow += of_water.outflow;
        sum.impulse += of_water.impulse;
      }
    if (fade_end > 0.)
      body_mass = current_mass();
    ++n_steps;
    ++since_refresh;
  }

  void
  ExplicitMPM::gather_sums()
  {
    if (error_message.empty() && !(sums.least_volume > 0.))
      for (const PointArrays &group : groups)
        for (unsigned int p = 0; p < group.n_points() && error_message.empty();
             ++p)
          if (!(group.volume[p] > 0.) && group.mass[p] > 0.)
            error_message =
              format("the volume of point %u at (%s) has become "
                     "zero or negative\n"
                     "  remedy:  take a smaller 'Explicit/Courant "
                     "number' or 'Explicit/Time step', or splines",
                     group.id[p],
                     text_of_place(group.position.of(p)).c_str());
    double largest[6] = {
      sums.wave_speed2,
      sums.speed2,
      sums.strain,
      double(must_refresh || some_left || transfer->must_sort(sums)),
      double(!error_message.empty()),
      double(stop_request_of_rank())};
    Utilities::MPI::max(largest, comm, largest);
    asked_to_stop    = static_cast<int>(largest[5]);
    sums.wave_speed2 = largest[0];
    sums.speed2      = largest[1];
    sums.strain      = largest[2];
    must_refresh     = largest[3] > 0.;
    if (largest[4] > 0.)
      throw StepFailure(text_of_any_rank(comm, error_message));
  }

  ExplicitReport
  ExplicitMPM::advance(const Stage &stage, const double t, const double h)
  {
    if (!progress.begun)
      progress = {true, t, {}};
    if (transfer->begin_stage(stage.name))
      must_refresh = true;
    ExplicitReport &report = progress.report;
    double         &now    = progress.now;
    const double    end    = t + h;
    while (now < end)
      {
        if (must_refresh || since_refresh >= sort_every)
          refresh();
        double dt = courant * stability_limit();
        if (largest_strain > 0. && sums.strain > 0.)
          dt = std::min(dt, last_step * largest_strain / sums.strain);
        if (sums.speed2 > 1e6 * sums.wave_speed2 || !(now + dt > now))
          throw StepFailure(
            format("points move at %.3g m/s, more than a thousand times as "
                   "fast as elastic waves, at t = %g s: the run is unstable",
                   std::sqrt(sums.speed2),
                   now) +
            "\n  remedy:  take a smaller 'Explicit/Courant number', splines, "
            "or the order MUSL");
        if (fixed_step > 0.)
          {
            dt = fixed_step;
            if (dt > stability_limit() && !allow_unstable)
              throw StepFailure(
                format(
                  "the step of %.6g s is longer than the %.6g s in which an "
                  "elastic wave now crosses a cell, at t = %g s",
                  dt,
                  stability_limit(),
                  now) +
                "\n  remedy:  take a smaller 'Explicit/Time step', or 0 for "
                "the largest stable one");
          }
        // Ends exactly, without a tiny last step.
        const double left = end - now;
        const bool   last = left <= dt * (1. + 1e-9);
        if (last)
          dt = left;
        else if (left < 2. * dt && fixed_step == 0.)
          dt = left / 2.;
        step(stage, now, dt, last);
        last_step = dt;
        now       = last ? end : now + dt;
        gather_sums();
        // The end of a record outputs and tests unmodified velocities.
        if (stage.kinetic_damping && !last)
          stop_at_peak();
        if (fade_end > 0. && now >= fade_end * (1. - 1e-12))
          end_removal();
        ++report.n_steps;
        report.largest_step = std::max(report.largest_step, dt);
        report.smallest_step =
          report.smallest_step == 0. ? dt : std::min(report.smallest_step, dt);
        if (asked_to_stop > 0 && now < end)
          throw Stopped(asked_to_stop);
      }
    // Detects points that have left before any evaluation.
    if (must_refresh)
      refresh();
    report.unbalanced_force =
      Utilities::MPI::max(nodes->unbalanced_force(), comm);
    report.reactions = nodes->take_support_impulses();
    sum_states_over_ranks(report.reactions, comm);
    for (Reaction &reaction : report.reactions)
      {
        reaction.force /= h;
        reaction.moment /= h;
      }
    progress.begun = false;
    return report;
  }
} // namespace geocone::GEOCONE_DIM
