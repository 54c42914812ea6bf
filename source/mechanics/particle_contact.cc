// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mechanics/particle_contact.h>
#include <geocone/mechanics/point_functions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** Functions that are smaller at a particle do not count as moved by it. */
    constexpr double least_share = 1e-12;
  } // namespace

  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Obstacles                &obstacles,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space)
  {
    std::vector<Vector> all(obstacles.list.size());
    for (unsigned int o = 0; o < all.size(); ++o)
      {
        all[o].reinit(space.partitioner());
        for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
          all[o].local_element(dim * node) = 1e300;
        for_each_point(points,
                       [&](const unsigned int p,
                           const unsigned int /* cell */,
                           const PointFunctions &at) {
                         const double half = length_of(points.weight[p]) / 2.;
                         const double gap =
                           obstacles.list[o]
                             ->nearest(points.position[p], moved[o], {})
                             .distance -
                           half;
                         for (unsigned int i = 0; i < at.n; ++i)
                           if (at.N[i] > least_share)
                             {
                               double &least =
                                 all[o].local_element(dim * at.nodes[i]);
                               least = std::min(least, gap);
                             }
                       });
        all[o].compress(VectorOperation::min);
        all[o].update_ghost_values();
      }
    return all;
  }

  void
  check_particles_outside(const MaterialPoints &points,
                          const Obstacles      &obstacles,
                          const MPI_Comm        comm)
  {
    for (const auto &obstacle : obstacles.list)
      {
        double least = 1e300;
        for (const Point<dim> &x : points.position)
          least = std::min(least, obstacle->nearest(x, {}, {}).distance);
        least = Utilities::MPI::min(least, comm);
        if (!(least > 0.))
          obstacle->refuse_overlap(
            format("a particle is %.3g m inside it", -least));
      }
  }

  namespace
  {
    /** lambda: planes are as steep as this lets them be. */
    constexpr double steepness = 1e-4;

    /** Steps of Newton's method, and the longest, of n over the size of a cell. */
    constexpr unsigned int most_steps   = 40;
    constexpr double       longest_step = 4.;
  } // namespace

  ParticleBodies::ParticleBodies(const Scene          &scene,
                                 const BackgroundMesh &mesh,
                                 const Space          &space)
    : scene(scene)
    , space(space)
    , place_of(space.n_local_nodes(), numbers::invalid_unsigned_int)
    , layer_of(space.n_local_nodes(), 0)
  {
    size = 1e300;
    for (const auto &cell : mesh.own_cells())
      size = std::min(size, BackgroundMesh::size_of(cell));
    size = Utilities::MPI::min(size, mesh.triangulation().get_communicator());

    // By material which body is one side of a contact, which the other.
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
            space.cell_nodes(mesh.twin(cell, layer), of_cell);
            for (unsigned int i = 0; i < of_cell.size(); ++i)
              twins[i].push_back(space.local_node(of_cell[i]));
          }
        for (const std::vector<unsigned int> &place : twins)
          if (place_of[place[0]] == numbers::invalid_unsigned_int)
            {
              for (unsigned int layer = 0; layer < place.size(); ++layer)
                {
                  place_of[place[layer]] = nodes.size();
                  layer_of[place[layer]] = layer;
                }
              nodes.push_back(place);
            }
      }
  }

  std::vector<ParticleBodies::Share>
  ParticleBodies::shares_of(const Pair              &pair,
                            const MaterialPoints    &points,
                            const std::vector<bool> &is_shared) const
  {
    std::vector<Share> shares;
    for_each_point(points,
                   [&](const unsigned int p,
                       const unsigned int /* cell */,
                       const PointFunctions &at) {
                     const unsigned int layer = layer_of[at.nodes[0]];
                     if (layer != pair.first && layer != pair.other)
                       return;
                     for (unsigned int i = 0; i < at.n; ++i)
                       if (const unsigned int place = place_of[at.nodes[i]];
                           is_shared[place] && at.N[i] > least_share)
                         shares.push_back({p,
                                           place,
                                           layer == pair.first ? 1. : -1.,
                                           points.weight[p] * at.N[i]});
                   });
    return shares;
  }

  void
  ParticleBodies::sum(const Pair &pair, Eigen::MatrixXd &rows) const
  {
    // By the vectors of the space, dim numbers of a node at a time.
    for (unsigned int c = 0; c < rows.rows(); c += dim)
      {
        Vector             x(space.partitioner());
        const unsigned int n = std::min<unsigned int>(dim, rows.rows() - c);
        for (unsigned int place = 0; place < nodes.size(); ++place)
          for (unsigned int d = 0; d < n; ++d)
            x.local_element(dim * nodes[place][pair.first] + d) =
              rows(c + d, place);
        x.compress(VectorOperation::add);
        x.update_ghost_values();
        for (unsigned int place = 0; place < nodes.size(); ++place)
          for (unsigned int d = 0; d < n; ++d)
            rows(c + d, place) =
              x.local_element(dim * nodes[place][pair.first] + d);
      }
  }

  Eigen::Matrix<double, dim + 1, 1>
  ParticleBodies::reach(const Share          &share,
                        const MaterialPoints &points) const
  {
    const unsigned int p = share.point;
    Tensor<1, dim>     x =
      points.position[p] - space.node_positions()[nodes[share.place][0]];
    // What stays in the mesh has moved for those that it touches.
    if (scene.regions.are_fixed(points.material[p]))
      x += points.displacement[p];
    Eigen::Matrix<double, dim + 1, 1> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = x[d] / size;
    result[dim] = 1.;
    return result;
  }

  ParticleBodies::Planes
  ParticleBodies::part(const Pair           &pair,
                       const MaterialPoints &points,
                       std::vector<Share>   &shares) const
  {
    constexpr unsigned int m       = dim + 1;
    const auto             n_cols  = nodes.size();
    Eigen::MatrixXd        weights = Eigen::MatrixXd::Zero(2, n_cols);
    for (const Share &share : shares)
      weights(share.side > 0. ? 0 : 1, share.place) += share.weight;
    sum(pair, weights);
    for (Share &share : shares)
      share.weight /= weights(share.side > 0. ? 0 : 1, share.place);

    Planes planes(n_cols, Eigen::Matrix<double, m, 1>::Zero());
    for (unsigned int step = 0; step < most_steps; ++step)
      {
        // The slope, and the upper triangle of the curvature.
        Eigen::MatrixXd sums =
          Eigen::MatrixXd::Zero(m + m * (m + 1) / 2, n_cols);
        for (const Share &share : shares)
          {
            const auto   x = reach(share, points);
            const double doubt =
              1. / (1. + std::exp(share.side * planes[share.place].dot(x)));
            auto         own = sums.col(share.place);
            unsigned int k   = m;
            for (unsigned int i = 0; i < m; ++i)
              {
                own[i] -= share.side * share.weight * doubt * x[i];
                for (unsigned int j = i; j < m; ++j)
                  own[k++] += share.weight * doubt * (1. - doubt) * x[i] * x[j];
              }
          }
        sum(pair, sums);
        double largest = 0.;
        for (unsigned int place = 0; place < n_cols; ++place)
          {
            if (!(weights(0, place) > 0.) || !(weights(1, place) > 0.))
              continue;
            Eigen::Matrix<double, m, 1> slope = sums.col(place).head(m);
            Eigen::Matrix<double, m, m> curvature;
            unsigned int                k = m;
            for (unsigned int i = 0; i < m; ++i)
              for (unsigned int j = i; j < m; ++j)
                curvature(i, j) = curvature(j, i) = sums(k++, place);
            for (unsigned int d = 0; d < m; ++d)
              {
                slope[d] += steepness * planes[place][d];
                curvature(d, d) += steepness;
              }
            Eigen::Matrix<double, m, 1> change = curvature.ldlt().solve(slope);
            change *= std::min(1., longest_step / change.norm());
            planes[place] -= change;
            largest = std::max(largest, change.norm());
          }
        if (Utilities::MPI::max(
              largest, space.partitioner()->get_mpi_communicator()) < 1e-10)
          break;
      }
    return planes;
  }

  std::vector<FacingNode>
  ParticleBodies::find(const MaterialPoints &points,
                       const Unknowns       &unknowns) const
  {
    const MPI_Comm          comm = space.partitioner()->get_mpi_communicator();
    std::vector<FacingNode> found;
    std::vector<unsigned int> of_place(nodes.size(),
                                       numbers::invalid_unsigned_int);
    std::string               twice;
    Vector                    outward(space.partitioner()); // int N_i n dA
    for_each_point(points,
                   [&](const unsigned int p,
                       const unsigned int /* cell */,
                       const PointFunctions &at) {
                     for (unsigned int i = 0; i < at.n; ++i)
                       for (unsigned int d = 0; d < dim; ++d)
                         outward.local_element(dim * at.nodes[i] + d) +=
                           points.weight[p] * at.slopes[d][i];
                   });
    outward.compress(VectorOperation::add);
    outward.update_ghost_values();
    const auto outward_at = [&](const unsigned int node) {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = outward.local_element(dim * node + d);
      return result;
    };

    for (const Pair &pair : pairs)
      {
        std::vector<bool> is_shared(nodes.size());
        for (unsigned int place = 0; place < nodes.size(); ++place)
          is_shared[place] =
            unknowns.has_mass(dim * nodes[place][pair.first]) &&
            unknowns.has_mass(dim * nodes[place][pair.other]);
        std::vector<Share> shares = shares_of(pair, points, is_shared);
        const Planes       planes = part(pair, points, shares);

        // How far both reach along the normal, from the place.
        std::array<Vector, 2> nearest;
        for (Vector &of_side : nearest)
          {
            of_side.reinit(space.partitioner());
            for (unsigned int i = 0; i < space.n_local_nodes(); ++i)
              of_side.local_element(dim * i) = 1e300;
          }
        for (const Share &share : shares)
          {
            const auto  &plane = planes[share.place];
            const double along =
              size * plane.template head<dim>().normalized().dot(
                       reach(share, points).template head<dim>());
            double &least = nearest[share.side > 0. ? 0 : 1].local_element(
              dim * nodes[share.place][pair.first]);
            least = std::min(least,
                             share.side * along -
                               length_of(points.weight[share.point]) / 2.);
          }
        for (Vector &of_side : nearest)
          {
            of_side.compress(VectorOperation::min);
            of_side.update_ghost_values();
          }

        const InterfaceLaw &law = scene.contacts.list[pair.contact]->law;
        for (unsigned int place = 0; place < nodes.size(); ++place)
          {
            const unsigned int node  = nodes[place][pair.first],
                               other = nodes[place][pair.other];
            const double gap         = nearest[0].local_element(dim * node) +
                               nearest[1].local_element(dim * node);
            if (!is_shared[place] || !(gap < 1e200))
              continue;
            FacingNode facing;
            facing.gap           = std::max(gap, 0.);
            facing.node.node     = node;
            facing.node.obstacle = scene.obstacles.list.size() + pair.contact;
            for (unsigned int d = 0; d < dim; ++d)
              facing.node.normal[d] = planes[place][d];
            facing.node.normal /= facing.node.normal.norm();
            facing.node.partners = {{other, 1.}};
            facing.node.length =
              std::max(0.,
                       std::min(-(outward_at(node) * facing.node.normal),
                                outward_at(other) * facing.node.normal));
            facing.node.friction = law.friction;
            facing.node.adhesion = law.adhesion * facing.node.length;
            facing.node.rebounds = law.restitution > 0.;
            if (of_place[place] == numbers::invalid_unsigned_int)
              {
                of_place[place] = found.size();
                found.push_back(facing);
                continue;
              }
            FacingNode &before = found[of_place[place]];
            if (std::max(before.gap, facing.gap) <= 1e-9 * size)
              twice =
                format("three bodies touch at (%s)",
                       text_of_place(space.node_positions()[node]).c_str());
            if (facing.gap < before.gap)
              before = facing;
          }
      }
    twice = text_of_any_rank(comm, twice);
    if (!twice.empty())
      throw StepFailure(twice + "\n  remedy:  let two of them be one body, or "
                                "make cells smaller");
    return found;
  }
} // namespace geocone
