// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mechanics/cartesian_transfer.h>
#include <geocone/mechanics/mesh_transfer.h>
#include <geocone/time_stepping/explicit_mpm.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    using Field = PointArrays::Field;

    /** Adds the wall time of its scope to a number of seconds. */
    class Stopwatch
    {
    public:
      explicit Stopwatch(double &seconds)
        : seconds(seconds)
        , start(std::chrono::steady_clock::now())
      {}
      ~Stopwatch()
      {
        seconds += std::chrono::duration<double>(
                     std::chrono::steady_clock::now() - start)
                     .count();
      }

    private:
      double                                     &seconds;
      const std::chrono::steady_clock::time_point start;
    };
  } // namespace

  ExplicitMPM::ExplicitMPM(const MPI_Comm comm, const ParameterFile &file)
    : ParameterAcceptor("/Explicit")
    , comm(comm)
    , mesh(comm)
    , seeding(file)
  {
    add_parameter("Order",
                  order_name,
                  "MUSL (velocities of points first, stress from their mean; "
                  "tolerates small nodal masses) | USL (stress last, one pass "
                  "over the points: the fastest; for splines) | USF (stress "
                  "first).");
    add_parameter("Transfer",
                  transfer_name,
                  "FLIP: points take the change of the nodes' velocities. "
                  "APIC: they take the velocity and its affine part, which "
                  "keeps angular momentum and damps vibrations.");
    add_parameter("FLIP part",
                  flip_part,
                  "For FLIP: the part of the new velocity that FLIP gives, the "
                  "rest is PIC (interpolated, damps); 0 to 1.");
    add_parameter("Courant number",
                  courant,
                  "C of the step C h/(c + v), with the cell size h, the "
                  "fastest elastic wave c and point v; 0 < C <= 1. With "
                  "Element = Q1 take 0.1 to 0.3.");
    add_parameter("Time step",
                  fixed_step,
                  "A step of this size (s); 0: the one that the Courant number "
                  "gives, anew in each step.");
    add_parameter("Allow unstable step",
                  allow_unstable,
                  "Whether a given step may exceed h/(c + v).");
    add_parameter("Largest strain increment",
                  largest_strain,
                  "Steps are kept so small that no displacement gradient "
                  "changes by more than about this, by its rate in the step "
                  "before; 0: no such limit.");
    add_parameter("Fast path",
                  fast_path,
                  "Whether a uniform grid is treated as such; false: like any "
                  "other mesh, for comparisons, with the same result (but for "
                  "Q1 and points exactly on edges of cells).");
    add_parameter("Sort every",
                  sort_every,
                  "Points are sorted by cell, and shared out among the ranks, "
                  "every so many steps (20 to 100 are fastest).");
  }

  void
  ExplicitMPM::check_parameters() const
  {
    const std::string section = "Explicit/";
    const auto        choose  = [&](const std::string              &entry,
                            const std::string              &value,
                            const std::vector<std::string> &choices) {
      std::string allowed;
      for (const std::string &choice : choices)
        allowed += (allowed.empty() ? "" : " | ") + choice;
      if (std::find(choices.begin(), choices.end(), value) == choices.end())
        throw InputError(section + entry, value, allowed, "choose one of them");
    };
    choose("Order", order_name, {"MUSL", "USL", "USF"});
    choose("Transfer", transfer_name, {"FLIP", "APIC"});
    if (transfer_name == "APIC" && flip_part != 1.)
      throw InputError(section + "FLIP part",
                       flip_part,
                       "1 (not given) where Transfer = APIC",
                       "leave it out, or set Transfer = FLIP");
    if (!(flip_part >= 0. && flip_part <= 1.))
      throw InputError(
        section + "FLIP part", flip_part, "0 to 1", "1 is FLIP, 0 is PIC");
    if (!(courant > 0. && courant <= 1.))
      throw InputError(
        section + "Courant number", courant, "0 < C <= 1", "0.3 is usual");
    if (!(fixed_step >= 0.))
      throw InputError(section + "Time step",
                       fixed_step,
                       ">= 0 s",
                       "0 lets the Courant number choose");
    if (!(largest_strain >= 0.))
      throw InputError(section + "Largest strain increment",
                       largest_strain,
                       ">= 0",
                       "0 is no limit");
    if (sort_every == 0)
      throw InputError(
        section + "Sort every", sort_every, ">= 1", "50 is usual");

    for (const auto &condition : scene->dirichlet.list)
      if (condition->moves())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposed_on,
                         "nodes with explicit MPM",
                         "prescribe velocities on sides of the background "
                         "mesh, or set Discretisation/Method = MPM");
    if (!scene->tractions.list.empty())
      throw InputError("Tractions/Names",
                       scene->tractions.list[0]->name,
                       "none with explicit MPM",
                       "give a layer of soil instead of a surcharge, or set "
                       "Discretisation/Method = MPM");
  }

  std::vector<std::string>
  ExplicitMPM::prepare(const Scene &scene_, const Method &method)
  {
    scene  = &scene_;
    kind   = order_name == "MUSL"  ? Order::musl
             : order_name == "USL" ? Order::usl
                                   : Order::usf;
    affine = transfer_name == "APIC";
    check_parameters();
    if (affine)
      flip_part = 0.; // the velocity is interpolated
    outflow.prepare();
    seeding.prepare(*scene);
    kernels = &transfer_kernels();

    std::vector<std::string> remarks;
    const auto               lines = mesh.uniform_lines(*scene, method);
    if (fast_path && !lines[0].empty())
      {
        space.choose_element(false, true, method);
        const CartesianGrid grid(space.degree(), lines);
        transfer =
          std::make_unique<CartesianTransfer>(comm, grid, scene->dirichlet);
        datum = {lines[0].front(), lines[1].front()};
        seed_points(seeding.make(*scene, grid, comm), remarks);
      }
    else
      {
        mesh.prepare(*scene, method);
        space.prepare(mesh, method);
        transfer =
          std::make_unique<MeshTransfer>(mesh, space, scene->dirichlet);
        datum = mesh.lower_corner();
        seed_points(seeding.make(*scene, mesh), remarks);
      }

    if (affine && space.degree() == 1)
      throw InputError("Explicit/Transfer",
                       transfer_name,
                       "FLIP where the element is Q1",
                       "take splines for APIC: with Q1 the noise of nodes with "
                       "little mass grows from step to step");

    support_impulse.resize(scene->dirichlet.list.size());
    for (const auto &condition : scene->dirichlet.list)
      for (unsigned int d = 0; d < dim; ++d)
        {
          // Formulas are slow: numbers are read once.
          double value = std::numeric_limits<double>::quiet_NaN();
          if (condition->components[d])
            try
              {
                value = Utilities::string_to_double(condition->formula(d));
              }
            catch (const ExceptionBase &)
              {}
          constant_value.push_back(value);
        }

    refresh();
    if (fixed_step > stability_limit() && !allow_unstable)
      throw InputError("Explicit/Time step",
                       fixed_step,
                       "at most " + format("%.3g", stability_limit()) +
                         " s, which an elastic wave takes through a cell",
                       "take a smaller step, or 0 for the largest stable one; "
                       "'Explicit/Allow unstable step' = true forces it");
    return remarks;
  }

  void
  ExplicitMPM::seed_points(const std::vector<Seed>  &seeds,
                           std::vector<std::string> &remarks)
  {
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      groups.emplace_back(m, scene->materials.law(m).n_history(), affine);
    unsigned int       first = 0;
    const unsigned int n     = seeds.size();
    MPI_Exscan(&n, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
    unsigned long n_changed = 0;
    std::string   change, refusal;
    double        largest_mass = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Seed            &seed  = seeds[i];
        PointArrays           &group = groups[seed.material];
        const ConstitutiveLaw &law   = scene->materials.law(seed.material);
        std::vector<double>    values(group.n_fields(), 0.);
        for (unsigned int d = 0; d < dim; ++d)
          {
            values[Field::x + d]       = seed.position[d];
            values[Field::x_start + d] = seed.position[d];
            values[Field::vx + d]      = seed.velocity[d];
          }
        values[Field::s_xx]   = seed.stress[0];
        values[Field::s_yy]   = seed.stress[1];
        values[Field::s_xy]   = seed.stress[2] / sqrt2;
        values[Field::volume] = seed.volume;
        values[Field::mass]   = seed.volume * law.density();
        largest_mass          = std::max(largest_mass, values[Field::mass]);
        const ConstitutiveLaw::Stress stress = {{seed.stress[0],
                                                 seed.stress[1],
                                                 seed.stress_zz,
                                                 seed.stress[2] / sqrt2}};
        for (unsigned int k = 0; k < group.first_history(); ++k)
          if (!std::isfinite(values[k]) && refusal.empty())
            refusal = format("the initial stress or velocity at (%g, %g) is "
                             "not a finite number\n  remedy:  check the "
                             "formulas in 'Initial stress' and 'Initial "
                             "velocity'",
                             seed.position[0],
                             seed.position[1]);
        if (!refusal.empty())
          break;
        try
          {
            const std::string remark =
              law.initialise(stress, &values[group.first_history()]);
            if (!remark.empty() && n_changed++ == 0)
              change = remark;
          }
        catch (const InputError &error)
          {
            if (refusal.empty())
              refusal = std::string(error.what()) +
                        format("\n  at:      the point (%g, %g)",
                               seed.position[0],
                               seed.position[1]);
          }
        sums.wave_speed2 =
          std::max(sums.wave_speed2,
                   law.wave_modulus(stress, &values[group.first_history()]) /
                     law.density());
        sums.speed2 = std::max(sums.speed2, seed.velocity.norm_square());
        if (affine)
          for (unsigned int d = 0; d < dim; ++d)
            {
              // The gradient of the initial velocity, exact for linear ones.
              Tensor<1, dim> r;
              r[d] = 1e-4 * std::sqrt(seed.volume);
              const Tensor<1, dim> difference =
                scene->initial_velocity.at(seed.position + r) -
                scene->initial_velocity.at(seed.position - r);
              for (unsigned int c = 0; c < dim; ++c)
                values[group.first_affine() + dim * c + d] =
                  difference[c] / (2. * r[d]);
            }
        group.append(values.data(), first + i);
      }
    refusal = text_of_any_rank(comm, refusal);
    if (!refusal.empty())
      throw InputError(refusal);
    change    = text_of_any_rank(comm, change);
    n_changed = Utilities::MPI::sum(n_changed, comm);
    if (n_changed > 0)
      remarks.push_back(format("%lu points: ", n_changed) + change);
    for (PointArrays &group : groups)
      group.pad();
    least_mass       = 1e-14 * Utilities::MPI::max(largest_mass, comm);
    sums.wave_speed2 = Utilities::MPI::max(sums.wave_speed2, comm);
    sums.speed2      = Utilities::MPI::max(sums.speed2, comm);
  }

  void
  ExplicitMPM::remove_massless()
  {
    for (PointArrays &group : groups)
      {
        std::vector<unsigned int> staying;
        for (unsigned int p = 0; p < group.n_points(); ++p)
          if (group[Field::mass][p] > 0.)
            staying.push_back(p);
        if (staying.size() < group.n_points())
          group.reorder(staying);
      }
    some_left = false;
  }

  BlockPoints
  ExplicitMPM::block(const unsigned int g, const unsigned int first)
  {
    PointArrays       &group = groups[g];
    const unsigned int n =
      std::min(PointBlock::capacity, group.n_padded() - first);
    const auto array = [&](const unsigned int field) {
      return group[field] + first;
    };
    const unsigned int c = group.first_affine();
    return {n,
            g,
            first,
            array(Field::x),
            array(Field::y),
            array(Field::vx),
            array(Field::vy),
            array(Field::s_xx),
            array(Field::s_yy),
            array(Field::s_xy),
            array(Field::volume),
            array(Field::mass),
            affine ? array(c) : nullptr,
            affine ? array(c + 1) : nullptr,
            affine ? array(c + 2) : nullptr,
            affine ? array(c + 3) : nullptr};
  }

  void
  ExplicitMPM::pass(const Pass &what, const double dt)
  {
    const Stopwatch watch(clock.passes);
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        PointArrays           &group = groups[g];
        const ConstitutiveLaw &law   = scene->materials.law(group.material);
        history.resize(group.n_history);
        for (unsigned int first = 0; first < group.n_padded();
             first += PointBlock::capacity)
          {
            const BlockPoints points = block(g, first);
            if (what.reads)
              {
                if (what.gradients)
                  transfer->gather(points, scratch);
                else
                  transfer->gather_values(points, scratch);
                if (what.update.velocity && affine)
                  transfer->gather_affine(points, scratch);
                kernels->update_points(
                  what.update, dt, flip_part, points, scratch);
              }
            if (what.update.strain)
              {
                for (unsigned int k = 0; k < group.n_history; ++k)
                  history[k] = group[group.first_history() + k] + first;
                law.advance({std::min(points.n, group.n_points() - first),
                             scratch.l_xx,
                             scratch.l_xy,
                             scratch.l_yx,
                             scratch.l_yy,
                             points.s_xx,
                             points.s_yy,
                             points.s_xy,
                             history.data(),
                             group[Field::plastic_strain] + first,
                             scratch.work,
                             scratch.wave_modulus},
                            counts);
                kernels->finish(points, scratch, sums);
              }
            if (what.update.position)
              {
                PassSums here;
                kernels->bound(points, here);
                if (!std::isfinite(here.check) ||
                    !transfer->reaches({here.lower[0], here.lower[1]}) ||
                    !transfer->reaches({here.upper[0], here.upper[1]}))
                  {
                    mend_positions(points);
                    here = PassSums();
                    kernels->bound(points, here);
                  }
                sums.add(here);
              }
            if (what.last && group.fading)
              fade_points(points);
            if (what.gives == Gives::nothing)
              continue;
            kernels->prepare_scatter(what.gives != Gives::force,
                                     what.gives == Gives::force ||
                                       what.gives == Gives::all,
                                     points,
                                     scratch);
            const bool with_mass = what.gives == Gives::momentum_and_mass ||
                                   what.gives == Gives::all;
            if (what.gives == Gives::force || what.gives == Gives::all)
              transfer->scatter(points, scratch, with_mass);
            else
              transfer->scatter_values(points, scratch, with_mass);
            if (affine && what.gives != Gives::force)
              transfer->scatter_affine(points, scratch);
          }
        if (what.update.strain)
          n_point_steps += group.n_points();
      }
  }

  std::string
  ExplicitMPM::has_left(const PointArrays &group, const unsigned int p) const
  {
    return format("point %u has left the background mesh at (%g, %g)\n"
                  "  remedy:  enlarge 'Mesh/Box', hold the side, or set "
                  "'Particles/Outflow' = count",
                  group.id[p],
                  group[Field::x][p],
                  group[Field::y][p]);
  }

  void
  ExplicitMPM::mend_positions(const BlockPoints &points)
  {
    PointArrays       &group = groups[points.group];
    const unsigned int end =
      std::min(points.first + points.n, group.n_points());
    const double tolerance = 1e-6 * transfer->cell_size();
    for (unsigned int p = points.first; p < points.first + points.n; ++p)
      {
        const Point<dim> place = group.position(p);
        if (std::isfinite(place.square()) &&
            std::isfinite(group[Field::vx][p] + group[Field::vy][p]) &&
            transfer->reaches(place))
          continue;
        Point<dim> nearest;
        if (!std::isfinite(place.square()) ||
            !std::isfinite(group[Field::vx][p] + group[Field::vy][p]))
          {
            if (obstacle.empty() && p < end)
              obstacle =
                format("the velocity of point %u is not a number", group.id[p]);
            group[Field::vx][p] = group[Field::vy][p] = 0.;
            nearest = transfer->a_stored_place();
            for (unsigned int d = 0; d < dim; ++d)
              group[Field::x + d][p] = nearest[d];
            continue;
          }
        nearest            = transfer->nearest_in_domain(place);
        const bool outside = nearest.distance(place) > tolerance;
        if (!transfer->reaches(nearest))
          {
            if (obstacle.empty() && p < end)
              obstacle =
                format("point %u at (%g, %g) moved through more than a cell "
                       "in one step",
                       group.id[p],
                       place[0],
                       place[1]);
            nearest = transfer->a_stored_place(); // the run ends anyhow
          }
        else if (outside && p < end)
          {
            if (outflow.is_error() && obstacle.empty())
              obstacle = has_left(group, p);
            take_away(group, p);
            some_left = true;
          }
        for (unsigned int d = 0; d < dim; ++d)
          group[Field::x + d][p] = nearest[d];
      }
  }

  void
  ExplicitMPM::start_nodes()
  {
    const bool stress_first = kind == Order::usf;
    pass({false,
          false,
          {false, false, false},
          stress_first ? Gives::momentum_and_mass : Gives::all,
          false},
         0.);
    const Stopwatch watch(clock.exchange);
    transfer->exchange(true);
  }

  void
  ExplicitMPM::refresh()
  {
    if (Utilities::MPI::logical_or(some_left, comm))
      remove_massless();
    unsigned long n_points = 0;
    for (const PointArrays &group : groups)
      n_points += group.n_points();
    if (Utilities::MPI::sum(n_points, comm) == 0)
      throw StepFailure("all points have left the background mesh\n"
                        "  remedy:  end the loading earlier, or enlarge "
                        "'Mesh/Box'");
    {
      const Stopwatch watch(clock.refresh);
      transfer->refresh(groups);
    }
    for (const auto &[g, p] : transfer->lost)
      {
        PointArrays &group = groups[g];
        if (outflow.is_error() && obstacle.empty())
          obstacle = has_left(group, p);
        take_away(group, p);
        some_left = true;
      }
    if (Utilities::MPI::logical_or(!obstacle.empty(), comm))
      throw StepFailure(text_of_any_rank(comm, obstacle));
    start_nodes();
    is_held.assign(dim * static_cast<std::size_t>(transfer->n_nodes()), 0);
    for (const PrescribedNode &node : transfer->prescribed)
      is_held[dim * node.node + node.component] = 1;
    body_mass     = current_mass();
    must_refresh  = false;
    since_refresh = 0;
  }

  double
  ExplicitMPM::prescribed_velocity(const PrescribedNode &node, const double t)
  {
    const double constant =
      constant_value[dim * node.condition + node.component];
    return std::isnan(constant) ? scene->dirichlet.list[node.condition]
                                    ->components[node.component]
                                    ->value(node.place, t)
                                : constant;
  }

  void
  ExplicitMPM::take_velocity(const double t,
                             const double moves,
                             const bool   keep_mass)
  {
    const Stopwatch    watch(clock.grid);
    const unsigned int n     = transfer->n_nodes();
    double            *read  = transfer->read.data();
    double            *write = transfer->write.data();
    double            *mass  = transfer->mass.data();
    for (unsigned int i = 0; i < n; ++i)
      {
        const double per_mass = mass[i] > least_mass ? 1. / mass[i] : 0.;
        read[4 * i]           = write[4 * i] * per_mass;
        read[4 * i + 1]       = write[4 * i + 1] * per_mass;
        read[4 * i + 2] = read[4 * i + 3] = 0.;
      }
    for (const PrescribedNode &node : transfer->prescribed)
      if (mass[node.node] > least_mass)
        {
          double      &v      = read[4 * node.node + node.component];
          const double before = v;
          v                   = prescribed_velocity(node, t);
          // USF: PIC gives the points what the condition has changed.
          if (kind == Order::usf && node.mine)
            {
              const double impulse =
                (1. - flip_part) * mass[node.node] * (v - before);
              support_impulse[node.condition][node.component] += impulse;
              sum.impulse[node.component] += impulse;
              sum.support_work += impulse * v;
            }
        }
    if (moves > 0.)
      count_gravity_work(moves);
    std::fill_n(write, 4 * static_cast<std::size_t>(n), 0.);
    if (!keep_mass)
      std::fill_n(mass, n, 0.);
  }

  void
  ExplicitMPM::accelerate(const Stage &stage,
                          const double t,
                          const double dt,
                          const bool   velocity_is_read,
                          const bool   keep_mass)
  {
    const Stopwatch    watch(clock.grid);
    const unsigned int n     = transfer->n_nodes();
    double            *read  = transfer->read.data();
    double            *write = transfer->write.data();
    double            *mass  = transfer->mass.data();
    const double       gx = gravity[0], gy = gravity[1];
    const double       damping = stage.damping;

    // Velocities before the step, and the force with gravity and damping.
    for (unsigned int i = 0; i < n; ++i)
      {
        double      *v = read + 4 * i;
        double      *f = write + 4 * i;
        const double m = mass[i];
        if (!velocity_is_read)
          {
            const double per_mass = m > least_mass ? 1. / m : 0.;
            v[0]                  = f[0] * per_mass;
            v[1]                  = f[1] * per_mass;
          }
        f[2] += m * gx;
        f[3] += m * gy;
      }
    if (wants_unbalanced)
      measure_unbalanced_force();
    if (damping > 0.)
      damp(damping, dt);

    // What conditions hold has its velocity from them; the reaction is what the
    // points get of momentum beyond the forces.
    held.clear();
    for (const PrescribedNode &node : transfer->prescribed)
      {
        const unsigned int i = node.node, d = node.component;
        const double       m = mass[i];
        if (!(m > least_mass))
          continue;
        const double before = prescribed_velocity(node, t);
        const double after =
          std::isnan(constant_value[dim * node.condition + d])
            ? prescribed_velocity(node, t + dt)
            : before;
        held.push_back({i, d, after, after - before});
        if (!node.mine)
          continue;
        const double impulse =
          m * (after - before) - dt * write[4 * i + 2 + d] +
          (1. - flip_part) * m * (before - read[4 * i + d]);
        support_impulse[node.condition][d] += impulse;
        sum.impulse[d] += impulse;
        sum.support_work += impulse * (before + after) / 2.;
      }
    for (const auto &range : transfer->mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        if (mass[i] > 0. && !(mass[i] > least_mass))
          ++sum.small_masses;

    for (unsigned int i = 0; i < n; ++i)
      {
        double      *v        = read + 4 * i;
        double      *f        = write + 4 * i;
        const double per_mass = mass[i] > least_mass ? dt / mass[i] : 0.;
        v[2]                  = f[2] * per_mass;
        v[3]                  = f[3] * per_mass;
        v[0] += v[2];
        v[1] += v[3];
        f[0] = f[1] = f[2] = f[3] = 0.;
      }
    for (const Held &node : held)
      {
        read[4 * node.node + node.component]     = node.velocity;
        read[4 * node.node + 2 + node.component] = node.change;
      }
    if (kind != Order::musl)
      count_gravity_work(dt);
    if (!keep_mass)
      std::fill_n(mass, n, 0.);
  }

  void
  ExplicitMPM::count_gravity_work(const double dt)
  {
    // sum m_p dx_p = dt sum m_i v_i
    Tensor<1, dim> momentum;
    for (const auto &range : transfer->mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          momentum[d] += transfer->mass[i] * transfer->read[4 * i + d];
    sum.gravity_work += dt * (gravity * momentum);
  }

  void
  ExplicitMPM::measure_unbalanced_force()
  {
    // Of free components, before damping.
    unbalanced = 0.;
    for (unsigned int i = 0; i < transfer->n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (!is_held[dim * i + d])
          unbalanced =
            std::max(unbalanced, std::abs(transfer->write[4 * i + 2 + d]));
    unbalanced = Utilities::MPI::max(unbalanced, comm);
  }

  void
  ExplicitMPM::damp(const double damping, const double dt)
  {
    // Not of held components, whose force is a reaction.
    const double *read  = transfer->read.data();
    double       *write = transfer->write.data();
    const auto    force = [&](const unsigned int i, const unsigned int d) {
      const double F = std::abs(write[4 * i + 2 + d]);
      if (is_held[dim * i + d] || !(transfer->mass[i] > least_mass) || F == 0.)
        return 0.;
      // The sign of the velocity, continuous where it is small against its
      // change in the step: rounding must not decide on a force.
      const double v = read[4 * i + d] * transfer->mass[i] / (dt * F);
      return -damping * F * std::max(-1., std::min(1., v));
    };
    for (const auto &range : transfer->mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        if (transfer->mass[i] > least_mass)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double f = force(i, d);
              sum.impulse[d] += dt * f;
              sum.damping_work -=
                dt * f *
                (read[4 * i + d] +
                 dt * (write[4 * i + 2 + d] + f) / transfer->mass[i] / 2.);
            }
    for (unsigned int i = 0; i < transfer->n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        write[4 * i + 2 + d] += force(i, d);
  }

  double
  ExplicitMPM::stability_limit() const
  {
    return transfer->cell_size() /
           (std::sqrt(sums.wave_speed2) + std::sqrt(sums.speed2));
  }

  void
  ExplicitMPM::step(const Stage &stage, const double t, const double dt)
  {
    gravity = scene->gravity.at(t + dt / 2.);
    sums    = PassSums();
    fade    = fade_end > t ? std::max(0., 1. - dt / (fade_end - t)) : 0.;
    const auto exchange = [&](const bool with_mass) {
      const Stopwatch watch(clock.exchange);
      transfer->exchange(with_mass);
    };
    // What the next step needs of a transfer that must be refreshed before it
    // would be given in vain.
    const auto gives = [&](const Gives what) {
      return transfer->moves_each_step() ? Gives::nothing : what;
    };
    const bool gives_next = !transfer->moves_each_step();
    if (kind == Order::usl)
      {
        accelerate(stage, t, dt, false, false);
        pass({true, true, {true, true, true}, gives(Gives::all), true}, dt);
      }
    else if (kind == Order::musl)
      {
        accelerate(stage, t, dt, false, true);
        pass({true, false, {false, true, false}, Gives::momentum, false}, dt);
        exchange(false);
        take_velocity(t + dt, dt, false);
        pass({true, true, {true, false, true}, gives(Gives::all), true}, dt);
      }
    else
      {
        take_velocity(t, 0., true);
        pass({true, true, {true, false, false}, Gives::force, false}, dt);
        exchange(false);
        accelerate(stage, t, dt, true, false);
        pass({true,
              false,
              {false, true, true},
              gives(Gives::momentum_and_mass),
              true},
             dt);
      }
    if (gives_next)
      exchange(true);
    else
      must_refresh = true;
    sum.stress_work += sums.work;
    sum.impulse += dt * body_mass * gravity;
    if (fade_end > 0.)
      body_mass = current_mass();
    ++n_steps;
    ++since_refresh;
  }

  void
  ExplicitMPM::gather_sums()
  {
    if (obstacle.empty() && !(sums.least_volume > 0.))
      for (const PointArrays &group : groups)
        for (unsigned int p = 0; p < group.n_points() && obstacle.empty(); ++p)
          if (!(group[Field::volume][p] > 0.) && group[Field::mass][p] > 0.)
            obstacle = format("the volume of point %u at (%g, %g) has become "
                              "zero or negative\n"
                              "  remedy:  take a smaller 'Explicit/Courant "
                              "number' or 'Explicit/Time step', or splines",
                              group.id[p],
                              group[Field::x][p],
                              group[Field::y][p]);
    double largest[5] = {
      sums.wave_speed2,
      sums.speed2,
      sums.strain,
      double(must_refresh || some_left || transfer->must_refresh(sums)),
      double(!obstacle.empty())};
    Utilities::MPI::max(largest, comm, largest);
    sums.wave_speed2 = largest[0];
    sums.speed2      = largest[1];
    sums.strain      = largest[2];
    must_refresh     = largest[3] > 0.;
    if (largest[4] > 0.)
      throw StepFailure(text_of_any_rank(comm, obstacle));
  }

  ExplicitReport
  ExplicitMPM::advance(const Stage &stage, const double t, const double h)
  {
    ExplicitReport report;
    for (Tensor<1, dim> &impulse : support_impulse)
      impulse = Tensor<1, dim>();
    const double end = t + h;
    double       now = t;
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
        // Land on the end exactly, without a sliver before it.
        const double left = end - now;
        const bool   last = left <= dt * (1. + 1e-9);
        if (last)
          dt = left;
        else if (left < 2. * dt && fixed_step == 0.)
          dt = left / 2.;
        wants_unbalanced = last;
        step(stage, now, dt);
        last_step = dt;
        now       = last ? end : now + dt;
        gather_sums();
        // The end of a record shows and tests velocities as they are.
        if (stage.kinetic_damping && !last)
          stop_at_peak();
        if (fade_end > 0. && now >= fade_end * (1. - 1e-12))
          end_removal();
        ++report.n_steps;
        report.largest_step = std::max(report.largest_step, dt);
        report.smallest_step =
          report.smallest_step == 0. ? dt : std::min(report.smallest_step, dt);
      }
    // Those that have left are found before anybody looks.
    if (must_refresh)
      refresh();
    report.unbalanced_force = unbalanced;
    for (const Tensor<1, dim> &impulse : support_impulse)
      report.reactions.push_back(Utilities::MPI::sum(impulse, comm) / h);
    return report;
  }
} // namespace geocone
