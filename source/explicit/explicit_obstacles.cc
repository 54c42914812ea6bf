// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/contact/obstacle_step.h>
#include <geocone/explicit/explicit_obstacles.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    constexpr double no_gap = std::numeric_limits<double>::infinity();

    /** Distance from an obstacle, over the size of a cell, up to which a node is one of
     *  its surface: the nearest row. Nodes in or on the obstacle alone would leave most of
     *  a cell between an obstacle that moves and the row before it, and the soil in it
     *  without support until that row is passed. */
    constexpr double of_surface = 0.4999;

    /** Gap of the points that are listed as near, over the size of a cell. */
    constexpr double listed = 2.;

    /** Sweeps over the contacts of a node in a corner. Each sweep reduces the error by
     *  the squared cosine of the angle between the normals, 0.97 at most. */
    constexpr unsigned int most_sweeps = 200;

    template <typename Function>
    void
    for_each_point_of(const std::vector<PointArrays> &groups, const Function &f)
    {
      for (unsigned int g = 0; g < groups.size(); ++g)
        for (unsigned int p = 0; p < groups[g].n_points(); ++p)
          f(g, p, groups[g].position.of(p));
    }
  } // namespace

  ExplicitObstacles::ExplicitObstacles(const Scene   &scene,
                                       GridTransfer  &transfer,
                                       const MPI_Comm comm)
    : scene(scene)
    , transfer(transfer)
    , comm(comm)
    , displacement(scene.obstacles.list.size())
    , velocity(scene.obstacles.list.size())
    , impulse(scene.obstacles.list.size())
    , particle(scene.obstacles, positions)
    , gaps(scene.obstacles.list.size())
  {
    for (const auto &obstacle : scene.obstacles.list)
      if (is_thinner(*obstacle, transfer.cell_size()))
        refuse_thin(*obstacle, transfer.cell_size());
    check_start_of_free(scene.obstacles, margin());
  }

  void
  ExplicitObstacles::check(const std::vector<PointArrays> &groups) const
  {
    std::vector<Point<dim>> positions;
    for_each_point_of(groups,
                      [&](unsigned int, unsigned int, const Point<dim> &x) {
                        positions.push_back(x);
                      });
    check_obstacles_of_particles(positions, scene.obstacles, comm);
    for (const auto &obstacle : scene.obstacles.list)
      if (obstacle->law.restitution > 0.)
        throw InputError(obstacle->parameter("Restitution"),
                         obstacle->law.restitution,
                         "0 with explicit MPM",
                         "the waves in the soil make it rebound: leave it out");
  }

  Tensor<1, dim>
  ExplicitObstacles::centre(const unsigned int o) const
  {
    return scene.obstacles.list[o]->centre() + displacement[o].centre;
  }

  void
  ExplicitObstacles::list_points(const std::vector<PointArrays> &groups)
  {
    positions = transfer.node_positions();
    travelled = 0.;
    near.clear();
    for_each_point_of(
      groups,
      [&](const unsigned int g, const unsigned int p, const Point<dim> &x) {
        const auto  &list = scene.obstacles.list;
        const double half =
          scene.geometry.size_of_point(x, groups[g].volume[p]) / 2.;
        ObstacleSet obstacles;
        for (unsigned int o = 0; o < list.size(); ++o)
          if (list[o]->nearest(x, displacement[o], {}).distance <
              half + listed * transfer.cell_size())
            obstacles.set(element_of(o));
        if (obstacles.any())
          near.push_back({g, p, obstacles});
      });
  }

  double
  ExplicitObstacles::fastest(const PassSums &points) const
  {
    if (points.lower[0] > points.upper[0])
      return 0.;
    double most = 0.;
    for (unsigned int o = 0; o < velocity.size(); ++o)
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = corner & (1u << d) ? points.upper[d] : points.lower[d];
          most =
            std::max(most, motions.velocities()[o].at(x - centre(o)).norm());
        }
    return most;
  }

  std::vector<unsigned int>
  ExplicitObstacles::find_gaps(const std::vector<PointArrays> &groups)
  {
    const unsigned int n = scene.obstacles.list.size();
    for (auto &of_obstacle : gaps)
      if (of_obstacle.size() != transfer.n_nodes())
        of_obstacle.assign(transfer.n_nodes(), no_gap);
    std::vector<unsigned int> touched;
    particle.begin_step(displacement, margin());
    for (const auto &[g, p, obstacles] : near)
      {
        const Point<dim> x = groups[g].position.of(p);
        particle.take(x,
                      scene.geometry.size_of_point(x, groups[g].volume[p]) / 2.,
                      obstacles);
        if (particle.least_gap() < closable)
          transfer.for_each_node(groups[g], g, p, [&](const unsigned int node) {
            touched.push_back(node);
            for (unsigned int o = 0; o < n; ++o)
              gaps[o][node] = std::min(gaps[o][node], particle.gap(o, node));
          });
      }
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        for (auto &of_obstacle : gaps)
          transfer.minimise_over_ranks(of_obstacle);
        touched.clear();
        for (unsigned int node = 0; node < transfer.n_nodes(); ++node)
          for (const auto &of_obstacle : gaps)
            if (of_obstacle[node] < no_gap)
              touched.push_back(node);
      }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    return touched;
  }

  void
  ExplicitObstacles::begin_step(const std::vector<PointArrays> &groups,
                                const PassSums                 &points,
                                const double                    t,
                                const double                    size)
  {
    dt = size;
    // As the velocities of sides: driven motions at the end of the step.
    motions.begin_step(
      bodies_of_step(scene, velocity, t + dt, t + dt / 2., dt));
    check_free(scene.obstacles, displacement, margin());
    const double path = dt * (std::sqrt(points.speed2) + fastest(points));
    closable          = 0.01 * transfer.cell_size() + 4. * path;
    travelled += path;
    if (travelled + closable > listed * transfer.cell_size())
      list_points(groups);

    contacts.clear();
    nodes.clear();
    const auto others = scene.obstacles.neighbours(displacement, margin());
    refusal.clear();
    for (const unsigned int node : find_gaps(groups))
      {
        add_contacts(node, others);
        for (auto &of_obstacle : gaps)
          of_obstacle[node] = no_gap;
      }
    if (displacement.size() > 1)
      refusal = text_of_any_rank(comm, refusal);
    if (!refusal.empty())
      throw StepFailure(refusal);
    forces.assign(contacts.size(), {});
    on_supports.clear();
  }

  void
  ExplicitObstacles::add_contacts(const unsigned int             number,
                                  const std::vector<Neighbours> &others)
  {
    const auto       &list = scene.obstacles.list;
    const Point<dim> &x    = positions[number];
    Tensor<1, dim>    v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = transfer.read[node_size * number + d];
    std::vector<ContactNode> found;
    for (unsigned int o = 0; o < list.size(); ++o)
      {
        if (gaps[o][number] == no_gap)
          continue;
        ContactNode contact;
        contact.node               = number;
        contact.obstacle           = o;
        contact.arm                = x - centre(o);
        contact.velocity           = motions.velocities()[o].at(contact.arm);
        const Obstacle::Nearest at = list[o]->nearest(
          x, displacement[o], dt * (contact.velocity - v), &others[o]);
        if (at.distance > of_surface * transfer.cell_size())
          continue;
        const double gap  = std::max(gaps[o][number], 0.);
        contact.normal    = at.normal;
        contact.least     = -gap / dt;
        contact.friction  = list[o]->law.friction;
        found.push_back(contact);
      }
    if (found.empty())
      return;
    std::stable_sort(found.begin(),
                     found.end(),
                     [](const ContactNode &a, const ContactNode &b) {
                       return a.least > b.least; // the nearest first
                     });
    const unsigned int begin = contacts.size();
    for (const ContactNode &contact : found)
      {
        bool is_new =
          contacts.size() - begin < dim; // more may contradict each other
        for (unsigned int k = begin; k < contacts.size(); ++k)
          {
            const double cosine = contact.normal * contacts[k].normal;
            is_new              = is_new && std::abs(cosine) < parallel;
            if (cosine < -parallel && contact.least > -closable / dt &&
                contacts[k].least > -closable / dt)
              refusal =
                format("the node at (%s) is squeezed between '%s' and '%s'"
                       "\n  remedy:  take smaller cells, or end the loading "
                       "before less than a cell of soil is between them",
                       text_of_place(x).c_str(),
                       list[contacts[k].obstacle]->name.c_str(),
                       list[contact.obstacle]->name.c_str());
          }
        if (is_new)
          contacts.push_back(contact);
      }
    nodes.push_back(
      {number, begin, static_cast<unsigned int>(contacts.size())});
  }

  void
  ExplicitObstacles::mark(std::vector<unsigned char> &components) const
  {
    for (const Node &node : nodes)
      std::fill_n(components.begin() + dim * node.number, dim, 1);
  }

  Tensor<1, dim>
  ExplicitObstacles::free_part(
    Tensor<1, dim>                    x,
    const unsigned int                node,
    const std::vector<unsigned char> &is_prescribed) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (is_prescribed[dim * node + d])
        x[d] = 0.;
    return x;
  }

  void
  ExplicitObstacles::solve(const Node &node)
  {
    const Contact::Local &free = locals[&node - nodes.data()];
    const unsigned int    n    = node.end - node.begin;
    Tensor<1, dim>        sum;
    for (unsigned int k = node.begin; k < node.end; ++k)
      {
        forces[k].q = Tensor<1, dim>();
        contacts[k].velocity =
          motions.velocities()[contacts[k].obstacle].at(contacts[k].arm);
      }
    for (unsigned int sweep = 0; sweep < (n > 1 ? most_sweeps : 1); ++sweep)
      {
        double change = 0.;
        for (unsigned int k = node.begin; k < node.end; ++k)
          {
            const Tensor<1, dim> others = sum - forces[k].q;
            const Contact::Local here   = {
                {}, free.v + others / free.rho, free.rho};
            forces[k] =
              Contact::project(contacts[k],
                               here,
                               contacts[k].of_obstacle * contacts[k].velocity,
                               {});
            change = std::max(change, (others + forces[k].q - sum).norm());
            sum    = others + forces[k].q;
          }
        if (change <= 1e-14 * sum.norm())
          break;
      }
  }

  void
  ExplicitObstacles::drop_supported(
    const std::vector<unsigned char> &is_prescribed, const double least_mass)
  {
    nodes.erase(std::remove_if(nodes.begin(),
                               nodes.end(),
                               [&](const Node &node) {
                                 return !(transfer.mass[node.number] >
                                          least_mass);
                               }),
                nodes.end());
    for (const Node &node : nodes)
      {
        std::array<bool, dim> is_held;
        Tensor<1, dim>        v;
        for (unsigned int d = 0; d < dim; ++d)
          {
            is_held[d] = is_prescribed[dim * node.number + d];
            v[d]       = transfer.read[node_size * node.number + d];
          }
        for (unsigned int k = node.begin; k < node.end; ++k)
          {
            ContactNode &contact = contacts[k];
            bool         acts =
              free_part(contact.normal, contact.node, is_prescribed).norm() >=
              least_free_normal;
            if (acts)
              contact.support(is_held, v);
            for (unsigned int other = node.begin; other < k; ++other)
              acts =
                acts && contact.normal * contacts[other].normal > -parallel;
            if (!acts) // the supports act alone
              {
                contact.normal      = Tensor<1, dim>();
                contact.of_obstacle = Contact::Matrix();
                contact.least       = -no_gap;
              }
          }
      }
    locals.clear();
    for (const Node &node : nodes)
      {
        Contact::Local local;
        for (unsigned int d = 0; d < dim; ++d)
          local.v[d] = transfer.read[node_size * node.number + d];
        local.v   = free_part(local.v, node.number, is_prescribed);
        local.rho = transfer.mass[node.number] / dt;
        locals.push_back(local);
      }
  }

  Tensor<1, dim>
  ExplicitObstacles::act_on(const Node &node)
  {
    double *const  v = &transfer.read[node_size * node.number];
    const double   m = transfer.mass[node.number];
    Tensor<1, dim> q, mean;
    for (unsigned int k = node.begin; k < node.end; ++k)
      q += forces[k].q;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double before = v[d] - v[change_of_node + d];
        v[d] += dt / m * q[d];
        v[change_of_node + d] += dt / m * q[d];
        mean[d] = before + v[change_of_node + d] / 2.;
      }
    return mean;
  }

  void
  ExplicitObstacles::push(const std::vector<unsigned char> &is_prescribed,
                          const double                      least_mass,
                          Exchange                         &sum)
  {
    drop_supported(is_prescribed, least_mass);
    std::vector<char> is_mine(transfer.n_nodes(), 0);
    for (const auto &[begin, end] : transfer.mine)
      std::fill(is_mine.begin() + begin, is_mine.begin() + end, 1);
    motions.find([&]() {
      std::vector<double> sums(ObstacleMotions::n_sums * displacement.size());
      for (const Node &node : nodes)
        if (is_mine[node.number])
          {
            solve(node);
            for (unsigned int k = node.begin; k < node.end; ++k)
              Contact::add_to_obstacle(
                contacts[k],
                transfer.mass[node.number] / dt,
                forces[k],
                &sums[ObstacleMotions::n_sums * contacts[k].obstacle]);
          }
      sum_over_ranks(sums, comm);
      return sums;
    });

    const auto about = scene.observation.moment_centre();
    for (const Node &node : nodes)
      {
        solve(node);
        const Tensor<1, dim> mean = act_on(node);
        for (unsigned int k = node.begin; k < node.end && is_mine[node.number];
             ++k)
          {
            const ContactNode   &contact = contacts[k];
            const Tensor<1, dim> J       = dt * forces[k].q,
                                 of_side = contact.whole(J) - J;
            const Tensor<1, dim> arm =
              about ? positions[node.number] - *about : contact.arm;
            for (unsigned int d = 0; d < dim; ++d)
              impulse[contact.obstacle].add(arm, d, J[d] + of_side[d]);
            sum.impulse += J;
            on_supports[node.number] += of_side;
            sum.contact_dissipation -=
              (J + of_side) * (mean - contact.velocity);
            sum.support_work +=
              (J + of_side) * contact.velocity - of_side * mean;
          }
      }
  }

  void
  ExplicitObstacles::hold(const std::vector<unsigned char> &is_prescribed,
                          const double                      least_mass)
  {
    for (const Node &node : nodes)
      {
        if (!(transfer.mass[node.number] > least_mass))
          continue;
        double *const v = &transfer.read[node_size * node.number];
        for (unsigned int k = node.begin; k < node.end; ++k)
          {
            const ContactNode &contact = contacts[k];
            if (forces[k].state == Contact::State::open)
              continue;
            Tensor<1, dim> u;
            for (unsigned int d = 0; d < dim; ++d)
              u[d] = v[d];
            u = free_part(u, node.number, is_prescribed) -
                contact.of_obstacle * contact.velocity;
            const double   u_N    = u * contact.normal;
            Tensor<1, dim> change = (contact.least - u_N) * contact.normal;
            if (forces[k].state == Contact::State::stick)
              change -= u - u_N * contact.normal;
            for (unsigned int d = 0; d < dim; ++d)
              v[d] += change[d];
          }
      }
  }

  void
  ExplicitObstacles::move()
  {
    for (unsigned int o = 0; o < displacement.size(); ++o)
      {
        velocity[o] = motions.velocities()[o];
        displacement[o].add(
          {dt * velocity[o].centre, dt * velocity[o].rotation});
      }
  }

  std::vector<Reaction>
  ExplicitObstacles::take_impulses()
  {
    std::vector<Reaction> taken(impulse.size());
    taken.swap(impulse);
    return taken;
  }
} // namespace geocone::GEOCONE_DIM
