// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/contact/particle_contact.h>
#include <geocone/points/point_functions.h>
#include <geocone/shapes/convex_hull.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Value of a shape function below which its node does not move the
     *  particle. */
    constexpr double least_function = 1e-12;

    /** Minimum distance of adjacent squares, over the sum of both half sides,
     *  valid also for Gauss points. */
    constexpr double beside = 0.4;

    /** Surfaces are flush if they differ by less than this fraction of half a
     *  particle. */
    constexpr double flush = 0.2;

    /**
     * Distance from a particle to obstacles that continue the surface of
     * another one whose node also moves the particle; infinite without any.
     * @param near from the particle, by obstacle @param own the obstacle of the
     * node
     * @param of_node from the node to it @param arm from the node to the
     * particle
     * @param tolerance of the difference between both surfaces
     */
    double
    along_others(const std::vector<Obstacle::Nearest> &near,
                 const unsigned int                    own,
                 const Obstacle::Nearest              &of_node,
                 const Tensor<1, dim>                 &arm,
                 const double                          tolerance)
    {
      const double expected = of_node.distance + arm * of_node.normal;
      double       least    = 1e300;
      for (unsigned int o = 0; o < near.size(); ++o)
        if (o != own && near[o].normal * of_node.normal > parallel &&
            std::abs(near[o].distance - expected) < tolerance)
          least = std::min(least, near[o].distance);
      return least;
    }

    /** Position of a particle in contact: fixed quadrature points in moving
     *  soil are displaced. */
    Point<dim>
    position_of(const Scene          &scene,
                const MaterialPoints &points,
                const unsigned int    p)
    {
      return scene.regions.are_fixed(points.material[p])
               ? points.position[p] + points.displacement[p]
               : points.position[p];
    }
  } // namespace

  ParticleGaps::ParticleGaps(const Obstacles               &obstacles,
                             const std::vector<Point<dim>> &nodes)
    : obstacles(obstacles)
    , nodes(nodes)
    , of_nodes(obstacles.list.size())
    , near(obstacles.list.size())
  {}

  void
  ParticleGaps::begin_step(const std::vector<RigidMotion> &displacements,
                           const double                    tolerance)
  {
    moved      = &displacements;
    margin     = tolerance;
    neighbours = obstacles.neighbours(displacements, margin);
    ++step;
    if (near.size() > 1)
      for (auto &of_obstacle : of_nodes)
        of_obstacle.resize(nodes.size());
  }

  void
  ParticleGaps::take(const Point<dim>  &place,
                     const double       half_side,
                     const ObstacleSet &is_near)
  {
    x    = place;
    half = half_side;
    for (unsigned int o = 0; o < near.size(); ++o)
      near[o] =
        is_near[element_of(o)]
          ? obstacles.list[o]->nearest(x, (*moved)[o], {})
          : Obstacle::Nearest{std::numeric_limits<double>::infinity(), {}};
  }

  double
  ParticleGaps::gap(const unsigned int o, const unsigned int node)
  {
    double distance = near[o].distance;
    if (near.size() > 1 && std::isfinite(distance))
      {
        OfNode &at = of_nodes[o][node];
        if (at.step != step)
          at = {obstacles.list[o]->nearest(
                  nodes[node], (*moved)[o], {}, &neighbours[o]),
                step};
        if (at.nearest.distance < margin)
          distance = std::min(
            distance,
            along_others(near, o, at.nearest, x - nodes[node], flush * half));
      }
    return distance - half;
  }

  double
  ParticleGaps::least_gap() const
  {
    double least = 1e300;
    for (const Obstacle::Nearest &one : near)
      least = std::min(least, one.distance);
    return least - half;
  }

  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Scene                    &scene,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space,
                    const double                    margin)
  {
    const unsigned int  n = scene.obstacles.list.size();
    std::vector<Vector> all(n);
    for (Vector &of_obstacle : all)
      {
        of_obstacle.reinit(space.partitioner());
        for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
          of_obstacle.local_element(dim * node) = 1e300;
      }
    ParticleGaps gaps(scene.obstacles, space.node_positions());
    gaps.begin_step(moved, margin);
    for_each_point(points,
                   [&](const unsigned int p,
                       const unsigned int /* cell */,
                       const PointFunctions &at) {
                     const Point<dim> x = position_of(scene, points, p);
                     gaps.take(
                       x,
                       scene.geometry.size_of_point(x, points.volume[p]) / 2.);
                     for (unsigned int o = 0; o < n; ++o)
                       for (unsigned int i = 0; i < at.n; ++i)
                         if (at.N[i] > least_function)
                           {
                             double &least =
                               all[o].local_element(dim * at.nodes[i]);
                             least = std::min(least, gaps.gap(o, at.nodes[i]));
                           }
                   });
    for (Vector &of_obstacle : all)
      {
        of_obstacle.compress(VectorOperation::min);
        of_obstacle.update_ghost_values();
      }
    return all;
  }

  void
  check_obstacles_of_particles(const std::vector<Point<dim>> &positions,
                               const Obstacles               &obstacles,
                               const MPI_Comm                 comm)
  {
    for (const auto &obstacle : obstacles.list)
      {
        if (obstacle->has_small_sliding())
          throw InputError(obstacle->parameter("Sliding"),
                           "small",
                           "finite with MPM",
                           "particles are where they are: leave it out");
        obstacle->law.check_without_area(obstacle->parameter(""));
      }
    for (const auto &obstacle : obstacles.list)
      {
        double least = 1e300;
        for (const Point<dim> &x : positions)
          least = std::min(least, obstacle->nearest(x, {}, {}).distance);
        least = Utilities::MPI::min(least, comm);
        if (!(least > 0.))
          obstacle->refuse_overlap(
            format("a particle is %.3g m inside it", -least));
      }
  }

  ParticleBodies::ParticleBodies(const Scene          &scene,
                                 const BackgroundMesh &mesh,
                                 const Space          &space)
    : scene(scene)
    , space(space)
    , index_of(space.n_local_nodes(), numbers::invalid_unsigned_int)
    , layer_of(space.n_local_nodes(), 0)
  {
    size = 1e300;
    for (const auto &cell : mesh.own_cells())
      size = std::min(size, BackgroundMesh::size_of(cell));
    size = Utilities::MPI::min(size, mesh.triangulation().get_communicator());

    // First and other bodies of each contact, by material.
    const auto                                     &list = scene.contacts.list;
    const unsigned int                              n = scene.materials.size();
    std::set<std::pair<unsigned int, unsigned int>> known;
    for (unsigned int k = 0; k < list.size(); ++k)
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          if (const unsigned int first = scene.contacts.body_of(a),
              other                    = scene.contacts.body_of(b);
              list[k]->is_first[a] && list[k]->is_other[b] &&
              known.insert(std::minmax(first, other)).second)
            pairs.push_back({k, first, other});

    std::vector<types::global_dof_index> of_cell;
    for (const auto &cell : mesh.own_cells())
      {
        std::vector<std::vector<unsigned int>> twins(space.nodes_per_cell());
        for (unsigned int layer = 0; layer < mesh.n_layers(); ++layer)
          {
            space.cell_nodes(mesh.cell_in_layer(cell, layer), of_cell);
            for (unsigned int i = 0; i < of_cell.size(); ++i)
              twins[i].push_back(space.local_node(of_cell[i]));
          }
        for (const std::vector<unsigned int> &place : twins)
          if (index_of[place[0]] == numbers::invalid_unsigned_int)
            {
              for (unsigned int layer = 0; layer < place.size(); ++layer)
                {
                  index_of[place[layer]] = nodes.size();
                  layer_of[place[layer]] = layer;
                }
              nodes.push_back(place);
            }
      }
  }

  std::vector<ParticleBodies::SupportParticle>
  ParticleBodies::support_particles(const Pair           &pair,
                                    const MaterialPoints &points,
                                    const Unknowns       &unknowns) const
  {
    std::vector<SupportParticle> particles;
    for_each_point(
      points,
      [&](const unsigned int p,
          const unsigned int /* cell */,
          const PointFunctions &at) {
        const unsigned int layer = layer_of[at.nodes[0]];
        if (layer != pair.first && layer != pair.other)
          return;
        const Point<dim> x = position_of(scene, points, p);
        for (unsigned int i = 0; i < at.n; ++i)
          if (const unsigned int place = index_of[at.nodes[i]];
              at.N[i] > least_function &&
              unknowns.has_mass(dim * nodes[place][pair.first]) &&
              unknowns.has_mass(dim * nodes[place][pair.other]))
            particles.push_back(
              {place,
               layer == pair.first,
               x,
               scene.geometry.size_of_point(x, points.volume[p]) / 2.});
      });
    return particles;
  }

  std::vector<Tensor<1, dim>>
  ParticleBodies::normals(const Pair                         &pair,
                          const std::vector<SupportParticle> &particles) const
  {
    std::vector<Tensor<1, dim>>                         normal(nodes.size());
    std::vector<std::array<std::vector<Point<dim>>, 2>> of_place(nodes.size());
    for (const SupportParticle &particle : particles)
      of_place[particle.position_index][particle.is_first].push_back(
        particle.x);

    // Other ranks have further particles at shared positions. Sent: number of
    // the position, side, and coordinates, in the plane of hull corners only.
    const auto &layout = *space.partitioner();
    const auto  number = [&](const unsigned int place) {
      return layout.local_to_global(dim * nodes[place][pair.first]);
    };
    if (layout.n_mpi_processes() > 1)
      {
        std::vector<double> corners;
        for (unsigned int place = 0; place < nodes.size(); ++place)
          for (const bool is_first : {false, true})
            for (const Point<dim> &x :
                 dim == 2 ? convex_hull(of_place[place][is_first])
                          : of_place[place][is_first])
              {
                corners.insert(corners.end(),
                               {double(number(place)), is_first ? 1. : 0.});
                for (unsigned int d = 0; d < dim; ++d)
                  corners.push_back(x[d]);
              }
        std::map<types::global_dof_index, unsigned int> here;
        for (unsigned int place = 0; place < nodes.size(); ++place)
          {
            here[number(place)] = place;
            of_place[place]     = {};
          }
        for (const auto &of_rank :
             Utilities::MPI::all_gather(layout.get_mpi_communicator(), corners))
          for (std::size_t i = 0; i < of_rank.size(); i += 2 + dim)
            if (const auto at = here.find(types::global_dof_index(of_rank[i]));
                at != here.end())
              {
                Point<dim> x;
                for (unsigned int d = 0; d < dim; ++d)
                  x[d] = of_rank[i + 2 + d];
                of_place[at->second][of_rank[i + 1] > 0.].push_back(x);
              }
      }
    for (unsigned int place = 0; place < nodes.size(); ++place)
      if (!of_place[place][0].empty() && !of_place[place][1].empty())
        normal[place] = way_between(of_place[place][0], of_place[place][1]);
    return normal;
  }

  std::vector<double>
  ParticleBodies::gaps(const Pair                         &pair,
                       const std::vector<SupportParticle> &particles,
                       const std::vector<Tensor<1, dim>>  &normal) const
  {
    // Extent of both sides from the position.
    std::array<Vector, 2> nearest;
    for (Vector &of_side : nearest)
      {
        of_side.reinit(space.partitioner());
        for (unsigned int i = 0; i < space.n_local_nodes(); ++i)
          of_side.local_element(dim * i) = 1e300;
      }
    for (const SupportParticle &particle : particles)
      {
        const unsigned int node  = nodes[particle.position_index][pair.first];
        const double       along = (particle.x - space.node_positions()[node]) *
                             normal[particle.position_index];
        double &least = nearest[particle.is_first].local_element(dim * node);
        least =
          std::min(least, (particle.is_first ? along : -along) - particle.half);
      }
    for (Vector &of_side : nearest)
      {
        of_side.compress(VectorOperation::min);
        of_side.update_ghost_values();
      }
    std::vector<double> gap;
    for (const std::vector<unsigned int> &place : nodes)
      gap.push_back(nearest[0].local_element(dim * place[pair.first]) +
                    nearest[1].local_element(dim * place[pair.first]));
    return gap;
  }

  void
  ParticleBodies::check_start(const MaterialPoints &points,
                              const Unknowns       &unknowns) const
  {
    for (const Pair &pair : pairs)
      {
        std::map<unsigned int, std::array<std::vector<SupportParticle>, 2>>
          of_place;
        for (const SupportParticle &particle :
             support_particles(pair, points, unknowns))
          of_place[particle.position_index][particle.is_first].push_back(
            particle);
        std::string where;
        for (const auto &[place, sides] : of_place)
          for (const SupportParticle &a : sides[0])
            for (const SupportParticle &b : sides[1])
              if (a.x.distance(b.x) < beside * (a.half + b.half))
                where = text_of_place(a.x);
        where =
          text_of_any_rank(space.partitioner()->get_mpi_communicator(), where);
        if (!where.empty())
          throw InputError("Contacts/Names",
                           scene.contacts.list[pair.contact]->name,
                           "bodies that do not overlap at the start",
                           "particles of both are at (" + where +
                             "): move one of the bodies");
      }
  }

  void
  ParticleBodies::check_fixed(const MaterialPoints &points) const
  {
    std::string far;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      if (scene.regions.are_fixed(points.material[p]) &&
          points.displacement[p].norm() > size / 2.)
        far = scene.materials.name(points.material[p]);
    far = text_of_any_rank(space.partitioner()->get_mpi_communicator(), far);
    if (!far.empty())
      throw StepFailure("'" + far +
                        "' has moved by half a cell, and its points stay: what "
                        "touches it would lose it\n  remedy:  let its points "
                        "move (leave out 'Materials/" +
                        far + "/Points'), or take larger cells");
  }

  std::vector<FacingNode>
  ParticleBodies::find(const MaterialPoints &points,
                       const Unknowns       &unknowns) const
  {
    check_fixed(points);
    Vector outward(space.partitioner()); // a
    for_each_point(points,
                   [&](const unsigned int p,
                       const unsigned int /* cell */,
                       const PointFunctions &at) {
                     for (unsigned int i = 0; i < at.n; ++i)
                       for (unsigned int d = 0; d < dim; ++d)
                         outward.local_element(dim * at.nodes[i] + d) +=
                           points.volume[p] * at.slopes[d][i];
                   });
    outward.compress(VectorOperation::add);
    outward.update_ghost_values();
    std::vector<FacingNode>             found;
    std::map<unsigned int, std::size_t> of_place; // in found
    std::string                         thrice;
    for (const Pair &pair : pairs)
      {
        const std::vector<SupportParticle> particles =
          support_particles(pair, points, unknowns);
        std::vector<Tensor<1, dim>> normal = normals(pair, particles);
        for (unsigned int place = 0; place < nodes.size(); ++place)
          if (normal[place].norm_square() == 0.)
            normal[place] = value_at(outward, nodes[place][pair.other]) -
                            value_at(outward, nodes[place][pair.first]);
        for (Tensor<1, dim> &n : normal)
          if (n.norm_square() > 0.)
            n /= n.norm();
        const std::vector<double> gap = gaps(pair, particles, normal);

        for (unsigned int place = 0; place < nodes.size(); ++place)
          {
            if (!(gap[place] < 1e200) || normal[place].norm_square() == 0.)
              continue;
            const unsigned int node  = nodes[place][pair.first],
                               other = nodes[place][pair.other];
            const Tensor<1, dim> &n  = normal[place];
            FacingNode            facing;
            facing.gap           = std::max(gap[place], 0.);
            facing.node.node     = node;
            facing.node.obstacle = scene.obstacles.list.size() + pair.contact;
            facing.node.normal   = n;
            facing.node.partners = {{other, 1.}};
            facing.node.is_twin  = true;
            facing.node.length =
              std::max(0.,
                       std::min(-(value_at(outward, node) * n),
                                value_at(outward, other) * n));
            const auto [at, is_new] = of_place.emplace(place, found.size());
            if (is_new)
              {
                found.push_back(facing);
                continue;
              }
            FacingNode &before = found[at->second];
            if (std::max(before.gap, facing.gap) <= closed_gap * size)
              thrice =
                format("three bodies touch at (%s)",
                       text_of_place(space.node_positions()[node]).c_str());
            if (facing.gap < before.gap)
              before = facing;
          }
      }
    thrice =
      text_of_any_rank(space.partitioner()->get_mpi_communicator(), thrice);
    if (!thrice.empty())
      throw StepFailure(thrice + "\n  remedy:  let two of them be one body, or "
                                 "make cells smaller");
    return found;
  }
} // namespace geocone::GEOCONE_DIM
