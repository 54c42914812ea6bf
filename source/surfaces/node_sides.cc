// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/surfaces/node_sides.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Largest difference between the cosines with the obstacle's normal of a
     *  face and of the best facing one: that of 45 degrees, if the latter is
     *  parallel. */
    const double nearly_as_well = 1. - std::sqrt(0.5);
  } // namespace

  NodeSides::NodeSides(const Space &space)
    : space(space)
    , sides(space.n_local_nodes())
  {}

  void
  NodeSides::add(const std::vector<FacePoint> &points)
  {
    Tensor<1, dim>                 normal;
    double                         area = 0.;
    std::map<unsigned int, double> integrals;
    for (const FacePoint &point : points)
      {
        normal += point.weight * point.normal;
        area += point.weight;
        for (unsigned int i = 0; i < point.nodes.size(); ++i)
          integrals[point.nodes[i]] += point.weight * point.values[i];
      }
    normal /= normal.norm();
    for (const auto &[node, integral] : integrals)
      if (std::abs(integral) > 1e-12 * area) // else it is not of this face
        sides[node].push_back({normal, integral});
  }

  void
  NodeSides::exchange()
  {
    const Utilities::MPI::Partitioner &layout = *space.partitioner();

    // Data of a face: the node's first dof, the integral, the normal.
    constexpr unsigned int                      n_numbers = 2 + dim;
    std::map<unsigned int, std::vector<double>> leaving;
    unsigned int                                node = space.n_owned_nodes();
    for (const auto &[rank, n_dofs] : layout.ghost_targets())
      for (unsigned int i = 0; i < n_dofs / dim; ++i, ++node)
        for (const Side &side : sides[node])
          {
            std::vector<double> &numbers = leaving[rank];
            numbers.push_back(layout.local_to_global(dim * node));
            numbers.push_back(side.integral);
            for (unsigned int d = 0; d < dim; ++d)
              numbers.push_back(side.normal[d]);
          }
    for (const auto &[rank, numbers] :
         Utilities::MPI::some_to_some(layout.get_mpi_communicator(), leaving))
      for (std::size_t i = 0; i < numbers.size(); i += n_numbers)
        {
          Side side;
          side.integral = numbers[i + 1];
          for (unsigned int d = 0; d < dim; ++d)
            side.normal[d] = numbers[i + 2 + d];
          sides[layout.global_to_local(
                  static_cast<types::global_dof_index>(numbers[i])) /
                dim]
            .push_back(side);
        }
  }

  double
  NodeSides::facing(const unsigned int node, const Tensor<1, dim> &normal) const
  {
    double best = -std::numeric_limits<double>::infinity(), sum = 0.;
    for (const Side &side : sides[node])
      best = std::max(best, -(side.normal * normal));
    for (const Side &side : sides[node])
      if (-(side.normal * normal) > best - nearly_as_well)
        sum += side.integral;
    return sum;
  }
} // namespace geocone::GEOCONE_DIM
