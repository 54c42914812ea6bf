// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mesh/cell_search.h>
#include <geocone/points/observed_points.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const char *const parameter = "Observation/Points";

    /** Whether a is nearer to x than b; points at equal distances, up to
     *  rounding, are ordered by their positions, the same on all ranks. */
    bool
    is_nearer(const Point<dim> &a, const Point<dim> &b, const Point<dim> &x)
    {
      const double to_a = a.distance(x), to_b = b.distance(x);
      const double rounding = 1e-9 * (to_a + to_b);
      if (std::abs(to_a - to_b) > rounding)
        return to_a < to_b;
      for (unsigned int d = 0; d + 1 < dim; ++d)
        if (std::abs(a[d] - b[d]) > rounding)
          return a[d] < b[d];
      return a[dim - 1] < b[dim - 1];
    }
  } // namespace

  void
  ObservedPoints::prepare_field(const Scene          &scene,
                                const BackgroundMesh &mesh,
                                const Space          &space)
  {
    comm = mesh.triangulation().get_communicator();
    const std::vector<Point<dim>> &places = scene.observation.points;
    in_cell.resize(places.size());
    const CellSearch                     cells(mesh);
    std::vector<types::global_dof_index> nodes;
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        const auto place = cells.find(places[i]);
        if (!Utilities::MPI::logical_or(place.has_value(), comm))
          throw InputError(parameter,
                           text_of_place(places[i]),
                           "places in the body, here in a cell of the mesh",
                           "move the point into the body");
        if (!place || !place->cell->is_locally_owned())
          continue;
        in_cell[i].position = places[i];
        in_cell[i].cell     = place->cell->active_cell_index();
        space.cell_nodes(place->cell, nodes);
        in_cell[i].values.resize(nodes.size());
        space.evaluate(
          place->cell, place->unit, in_cell[i].values.data(), nullptr);
        for (const types::global_dof_index node : nodes)
          in_cell[i].nodes.push_back(space.local_node(node));
      }
  }

  void
  ObservedPoints::prepare_points(const Scene          &scene,
                                 const MaterialPoints &points,
                                 const MPI_Comm        communicator)
  {
    comm = communicator;
    std::vector<std::optional<Candidate>> own;
    for (const Point<dim> &x : scene.observation.points)
      {
        own.emplace_back();
        for (unsigned int p = 0; p < points.n_points(); ++p)
          if (!own.back() ||
              is_nearer(points.position[p], own.back()->position, x))
            own.back() = {points.position[p], points.volume[p], points.id[p]};
      }
    choose(scene, own);
  }

  void
  ObservedPoints::prepare_points(const Scene                    &scene,
                                 const std::vector<PointArrays> &groups,
                                 const MPI_Comm                  communicator)
  {
    comm = communicator;
    std::vector<std::optional<Candidate>> own;
    for (const Point<dim> &x : scene.observation.points)
      {
        own.emplace_back();
        for (const PointArrays &group : groups)
          for (unsigned int p = 0; p < group.n_points(); ++p)
            if (!own.back() ||
                is_nearer(group.position.of(p), own.back()->position, x))
              own.back() = {group.position.of(p), group.volume[p], group.id[p]};
      }
    choose(scene, own);
  }

  void
  ObservedPoints::choose(const Scene                                 &scene,
                         const std::vector<std::optional<Candidate>> &own)
  {
    for (unsigned int i = 0; i < own.size(); ++i)
      {
        const Point<dim> &x = scene.observation.points[i];
        // Position, volume, id
        std::vector<double> mine;
        if (own[i])
          {
            for (unsigned int d = 0; d < dim; ++d)
              mine.push_back(own[i]->position[d]);
            mine.push_back(own[i]->volume);
            mine.push_back(own[i]->id);
          }
        std::optional<Candidate> nearest;
        for (const auto &other : Utilities::MPI::all_gather(comm, mine))
          if (!other.empty())
            {
              Candidate candidate;
              for (unsigned int d = 0; d < dim; ++d)
                candidate.position[d] = other[d];
              candidate.volume = other[dim];
              candidate.id     = other[dim + 1];
              if (!nearest ||
                  is_nearer(candidate.position, nearest->position, x))
                nearest = candidate;
            }
        // Points of a regular layout are within 0.71 of their size of any
        // position in the body; those at its boundary or in slender cells can
        // be farther away.
        const double size =
          nearest
            ? scene.geometry.size_of_point(nearest->position, nearest->volume)
            : 0.;
        if (!nearest || nearest->position.distance(x) > 1.5 * size)
          throw InputError(parameter,
                           text_of_place(x),
                           "places in the body, near to a material point",
                           "move the point into the body" +
                             (nearest ? "; the nearest material point is at " +
                                          text_of_place(nearest->position)
                                      : std::string()));
        id.push_back(nearest->id);
      }
  }

  std::vector<double>
  ObservedPoints::gather_values(std::vector<double> &sums) const
  {
    sum_over_ranks(sums, comm);
    const std::size_t   n = sums.size() / 2;
    std::vector<double> result(n, std::numeric_limits<double>::quiet_NaN());
    for (unsigned int i = 0; i < n; ++i)
      if (sums[n + i] > 0.)
        result[i] = sums[i];
    return result;
  }

  std::vector<Tensor<1, dim>>
  ObservedPoints::gather(std::vector<double> &sums) const
  {
    sum_over_ranks(sums, comm);
    std::vector<Tensor<1, dim>> result(sums.size() / (dim + 1));
    for (unsigned int i = 0; i < result.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        result[i][d] = sums[(dim + 1) * i + dim] > 0.
                         ? sums[(dim + 1) * i + d]
                         : std::numeric_limits<double>::quiet_NaN();
    return result;
  }

  std::vector<Tensor<1, dim>>
  ObservedPoints::displacements(const MaterialPoints &points,
                                const Vector         &nodal) const
  {
    if (in_cell.empty() && id.empty())
      return {};
    std::vector<double> sums((dim + 1) * std::max(in_cell.size(), id.size()),
                             0.);
    if (!in_cell.empty())
      {
        Vector displacement = nodal;
        displacement.update_ghost_values();
        for (unsigned int i = 0; i < in_cell.size(); ++i)
          if (!in_cell[i].nodes.empty())
            {
              sums[(dim + 1) * i + dim] = 1.;
              for (unsigned int k = 0; k < in_cell[i].nodes.size(); ++k)
                for (unsigned int d = 0; d < dim; ++d)
                  sums[(dim + 1) * i + d] +=
                    in_cell[i].values[k] *
                    displacement.local_element(dim * in_cell[i].nodes[k] + d);
            }
      }
    else
      for (unsigned int p = 0; p < points.n_points(); ++p)
        for (unsigned int i = 0; i < id.size(); ++i)
          if (points.id[p] == id[i])
            {
              sums[(dim + 1) * i + dim] = 1.;
              for (unsigned int d = 0; d < dim; ++d)
                sums[(dim + 1) * i + d] = points.displacement[p][d];
            }
    return gather(sums);
  }

  std::vector<double>
  ObservedPoints::pressures(const MaterialPoints &points) const
  {
    const unsigned int  n = std::max(in_cell.size(), id.size());
    std::vector<double> sums(2 * n, 0.); // pressures, and their number
    const auto          take = [&](const unsigned int i, const unsigned int p) {
      sums[i]     = points.excess_pressure(p);
      sums[n + i] = 1.;
    };
    for (unsigned int c = 0; c < points.n_cells() && !in_cell.empty(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        if (points.cells[c]->active_cell_index() == in_cell[i].cell)
          {
            unsigned int nearest = points.first_point[c];
            for (unsigned int p = nearest; p < points.first_point[c + 1]; ++p)
              if (is_nearer(points.position[p],
                            points.position[nearest],
                            in_cell[i].position))
                nearest = p;
            take(i, nearest);
          }
    for (unsigned int p = 0; p < points.n_points() && in_cell.empty(); ++p)
      for (unsigned int i = 0; i < n; ++i)
        if (points.id[p] == id[i])
          take(i, p);
    return gather_values(sums);
  }

  std::vector<double>
  ObservedPoints::pressures(
    const std::vector<PointArrays> &groups,
    const std::function<double(const PointArrays &, const unsigned int)>
      &excess_pressure) const
  {
    std::vector<double> sums(2 * id.size(), 0.);
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        for (unsigned int i = 0; i < id.size(); ++i)
          if (group.id[p] == id[i] && group.mass[p] > 0.)
            {
              sums[i]             = excess_pressure(group, p);
              sums[id.size() + i] = 1.;
            }
    return gather_values(sums);
  }

  std::vector<Tensor<1, dim>>
  ObservedPoints::displacements(const std::vector<PointArrays> &groups) const
  {
    if (id.empty())
      return {};
    std::vector<double> sums((dim + 1) * id.size(), 0.);
    for (const PointArrays &group : groups)
      for (unsigned int p = 0; p < group.n_points(); ++p)
        for (unsigned int i = 0; i < id.size(); ++i)
          if (group.id[p] == id[i] && group.mass[p] > 0.)
            {
              sums[(dim + 1) * i + dim] = 1.;
              for (unsigned int d = 0; d < dim; ++d)
                sums[(dim + 1) * i + d] =
                  group.position[d][p] - group.start[d][p];
            }
    return gather(sums);
  }
} // namespace geocone::GEOCONE_DIM
