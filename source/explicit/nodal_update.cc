// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/explicit/nodal_update.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  NodalUpdate::NodalUpdate(GridTransfer             &transfer,
                           const BoundaryConditions &conditions,
                           const double              flip_part,
                           const double              least_mass,
                           const BoundaryForces     *boundary,
                           PoreWater                *water,
                           ExplicitObstacles        *obstacles,
                           Exchange                 &sum)
    : transfer(transfer)
    , conditions(conditions)
    , flip_part(flip_part)
    , least_mass(least_mass)
    , boundary(boundary)
    , water(water)
    , obstacles(obstacles)
    , sum(sum)
    , support_impulse(conditions.list.size())
  {}

  void
  NodalUpdate::mark_held()
  {
    is_prescribed.assign(dim * static_cast<std::size_t>(transfer.n_nodes()), 0);
    for (const PrescribedNode &node : transfer.prescribed)
      is_prescribed[dim * node.node + node.component] = 1;
  }

  double
  NodalUpdate::prescribed_velocity(const PrescribedNode &node,
                                   const double          t) const
  {
    return conditions.list[node.condition]->value(
      node.component, node.place, t);
  }

  void
  NodalUpdate::divide_momentum()
  {
    double       *read  = transfer.read.data();
    const double *write = transfer.write.data();
    const double *mass  = transfer.mass.data();
    for (unsigned int i = 0; i < transfer.n_nodes(); ++i)
      {
        const double per_mass = mass[i] > least_mass ? 1. / mass[i] : 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            read[node_size * i + d] = write[node_size * i + d] * per_mass;
            read[node_size * i + change_of_node + d] = 0.;
          }
      }
  }

  void
  NodalUpdate::clear(const bool keep_mass)
  {
    const std::size_t n = transfer.n_nodes();
    std::fill_n(transfer.write.data(), node_size * n, 0.);
    if (!keep_mass)
      std::fill_n(transfer.mass.data(), n, 0.);
    if (water != nullptr)
      water->clear(keep_mass);
  }

  void
  NodalUpdate::velocity_before(const double t)
  {
    divide_momentum();
    for (const PrescribedNode &node : transfer.prescribed)
      {
        const double m = transfer.mass[node.node];
        if (!(m > least_mass))
          continue;
        double      &v = transfer.read[node_size * node.node + node.component];
        const double before = v;
        v                   = prescribed_velocity(node, t);
        if (!node.mine)
          continue;
        // PIC transfers the change by the condition to the points.
        const double impulse = (1. - flip_part) * m * (v - before);
        add_impulse(node, impulse);
        sum.support_work += impulse * v;
      }
    clear(true);
  }

  void
  NodalUpdate::velocity_after(const Step &step)
  {
    divide_momentum();
    for (const PrescribedNode &node : transfer.prescribed)
      if (transfer.mass[node.node] > least_mass)
        transfer.read[node_size * node.node + node.component] =
          prescribed_velocity(node, step.t + step.dt);
    if (obstacles != nullptr)
      obstacles->hold(is_prescribed, least_mass);
    if (water != nullptr)
      water->divide_momentum(least_mass);
    count_gravity_work(step);
    clear(false);
  }

  void
  NodalUpdate::impose_prescribed(const Step &step)
  {
    held.clear();
    for (const PrescribedNode &node : transfer.prescribed)
      {
        const unsigned int i = node.node, d = node.component;
        const double       m = transfer.mass[i];
        if (!(m > least_mass))
          continue;
        const double before = prescribed_velocity(node, step.t);
        const double after  = prescribed_velocity(node, step.t + step.dt);
        held.push_back({i, d, after, after - before});
        if (water != nullptr)
          water->advance_relative_at(
            node, step.dt, step.gravity, after - before);
        if (!node.mine)
          continue;
        const double impulse =
          m * (after - before) - step.dt * force_at(i, d) +
          (1. - flip_part) * m * (before - transfer.read[node_size * i + d]);
        add_impulse(node, impulse);
        sum.support_work += impulse * (before + after) / 2.;
      }
  }

  void
  NodalUpdate::accelerate(const Step &step,
                          const bool  velocity_is_read,
                          const bool  moves)
  {
    const unsigned int n     = transfer.n_nodes();
    double            *read  = transfer.read.data();
    double            *write = transfer.write.data();
    const double      *mass  = transfer.mass.data();
    const double       dt    = step.dt;
    double             g[dim]; // for the compiler, which need not load it anew
    for (unsigned int d = 0; d < dim; ++d)
      g[d] = step.gravity[d];

    // Velocities before the step, and the force with gravity and damping.
    for (unsigned int i = 0; i < n; ++i)
      {
        double      *v = read + node_size * i;
        double      *f = write + node_size * i;
        const double m = mass[i];
        if (!velocity_is_read)
          {
            const double per_mass = m > least_mass ? 1. / m : 0.;
            for (unsigned int d = 0; d < dim; ++d)
              v[d] = f[d] * per_mass;
          }
        for (unsigned int d = 0; d < dim; ++d)
          f[change_of_node + d] += m * g[d];
      }
    if (boundary != nullptr)
      boundary->add_tractions(transfer);
    if (water != nullptr)
      water->add_buoyancy(dt, step.gravity);
    if (step.measures_force)
      measure_unbalanced_force();
    if (step.damping > 0.)
      add_damping(step);
    if (boundary != nullptr)
      {
        const BoundaryForces::Done done =
          boundary->add_dashpots(transfer, dt, least_mass, is_prescribed);
        sum.support_work += done.work;
        sum.impulse += done.impulse;
      }

    if (water != nullptr)
      water->advance_relative(dt, step.gravity, least_mass, is_prescribed);
    impose_prescribed(step);
    for (const auto &range : transfer.mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        sum.small_masses += mass[i] > 0. && !(mass[i] > least_mass);

    for (unsigned int i = 0; i < n; ++i)
      {
        double       *v        = read + node_size * i;
        const double *f        = write + node_size * i + change_of_node;
        double       *change   = v + change_of_node;
        const double  per_mass = mass[i] > least_mass ? dt / mass[i] : 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            change[d] = f[d] * per_mass;
            v[d] += change[d];
          }
      }
    for (const PrescribedComponent &node : held)
      {
        double *v = read + node_size * node.node + node.component;

        v[0]              = node.velocity;
        v[change_of_node] = node.change;
      }
    if (obstacles != nullptr)
      push_by_obstacles();
    if (water != nullptr)
      water->add_velocity_of_soil(dt);
    if (moves)
      count_gravity_work(step);
    clear(!moves);
  }

  void
  NodalUpdate::count_gravity_work(const Step &step)
  {
    // sum m_p dx_p = dt sum m_i v_i
    Tensor<1, dim> momentum;
    for (const auto &range : transfer.mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          momentum[d] += transfer.mass[i] * transfer.read[node_size * i + d];
    sum.gravity_work += step.dt * (step.gravity * momentum);
    if (water != nullptr)
      water->count_work(step.dt, step.gravity);
  }

  const std::vector<unsigned char> &
  NodalUpdate::reactions()
  {
    if (obstacles == nullptr)
      return is_prescribed;
    is_reaction = is_prescribed;
    obstacles->mark(is_reaction);
    return is_reaction;
  }

  void
  NodalUpdate::measure_unbalanced_force()
  {
    unbalanced = 0.;
    const std::vector<unsigned char> &has_reaction = reactions();
    for (unsigned int i = 0; i < transfer.n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (!has_reaction[dim * i + d])
          unbalanced = std::max(unbalanced, std::abs(force_at(i, d)));
  }

  void
  NodalUpdate::add_damping(const Step &step)
  {
    const std::vector<unsigned char> &has_reaction = reactions();
    const double *read  = transfer.read.data();
    const auto    force = [&](const unsigned int i, const unsigned int d) {
      const double F = std::abs(force_at(i, d));
      if (has_reaction[dim * i + d] || !(transfer.mass[i] > least_mass) ||
          F == 0.)
        return 0.;
      // Sign of the velocity, continuous if it is small compared with its
      // change in the step: rounding must not determine a force.
      const double v =
        read[node_size * i + d] * transfer.mass[i] / (step.dt * F);
      return -step.damping * F * std::max(-1., std::min(1., v));
    };
    for (const auto &range : transfer.mine)
      for (unsigned int i = range[0]; i < range[1]; ++i)
        if (transfer.mass[i] > least_mass)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double f = force(i, d);
              sum.impulse[d] += step.dt * f;
              sum.damping_work -=
                step.dt * f *
                (read[node_size * i + d] +
                 step.dt * (force_at(i, d) + f) / transfer.mass[i] / 2.);
            }
    for (unsigned int i = 0; i < transfer.n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        force_at(i, d) += force(i, d);
  }

  void
  NodalUpdate::add_impulse(const PrescribedNode &node, const double impulse)
  {
    support_impulse[node.carrier].add(
      node.place - transfer.centres[node.carrier], node.component, impulse);
    sum.impulse[node.component] += impulse;
  }

  void
  NodalUpdate::push_by_obstacles()
  {
    obstacles->push(is_prescribed, least_mass, sum);
    const auto &carried = obstacles->impulses_on_supports();
    if (carried.empty())
      return;
    for (const PrescribedNode &node : transfer.prescribed)
      if (const auto at = carried.find(node.node);
          node.mine && at != carried.end())
        support_impulse[node.carrier].add(node.place -
                                            transfer.centres[node.carrier],
                                          node.component,
                                          -at->second[node.component]);
  }

  std::vector<Reaction>
  NodalUpdate::take_support_impulses()
  {
    std::vector<Reaction> taken(support_impulse.size());
    taken.swap(support_impulse);
    return taken;
  }
} // namespace geocone::GEOCONE_DIM
