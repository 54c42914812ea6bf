// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/points/consistent_integration.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Filled fractions of the volume of the cells around a vertex, and of each
     *  of them, from which the vertex is in the body. At a flat surface half of
     *  them are full and the others to two fifths. Single cells of a body that is
     *  sheared a lot may be less than half full. */
    constexpr double least_fill_of_patch = 0.7, least_fill_of_cell = 0.1;

    /** Soil fraction of a cell up to which it need not be filled. */
    constexpr double least_part = 0.1;

    /** Integrals for the corrections, over a part of a cell. */
    struct CellIntegrals
    {
      double                      volume = 0.;
      std::vector<Tensor<1, dim>> gradient; ///< of grad N_i
      std::vector<double>         hoop;     ///< of N_i/r, around an axis

      /** Adds the integrals of another cell, for the nodes shared with this
       *  one. */
      void
      add(const CellIntegrals                        &other,
          const std::vector<types::global_dof_index> &nodes_of_other,
          const std::vector<types::global_dof_index> &nodes)
      {
        volume += other.volume;
        for (unsigned int j = 0; j < nodes_of_other.size(); ++j)
          if (const auto found =
                std::find(nodes.begin(), nodes.end(), nodes_of_other[j]);
              found != nodes.end())
            {
              gradient[found - nodes.begin()] += other.gradient[j];
              if (!hoop.empty())
                hoop[found - nodes.begin()] += other.hoop[j];
            }
      }
    };

    CellIntegrals
    integrate(const BackgroundMesh &mesh,
              const Space          &space,
              const Space::Cell    &cell,
              const SoilPart       &part)
    {
      const unsigned int          n   = space.nodes_per_cell();
      const BoundingBox<dim>      box = cell->bounding_box();
      std::vector<double>         values(n);
      std::vector<Tensor<1, dim>> unit_gradient(n);
      CellIntegrals               sum;
      sum.gradient.resize(n);
      sum.hoop.resize(mesh.is_axisymmetric() ? n : 0);
      for (const auto &[x, size] : part.quadrature(
             space.degree() / 2 + 1 + (mesh.is_axisymmetric() ? 1 : 0)))
        {
          Point<dim> unit;
          for (unsigned int d = 0; d < dim; ++d)
            unit[d] = (x[d] - box.lower_bound(d)) / box.side_length(d);
          const double weight = size * mesh.measure(x);
          space.evaluate(cell, unit, values.data(), unit_gradient.data());
          const Tensor<2, dim> inverse = mesh.inverse_jacobian(cell, unit);
          sum.volume += weight;
          for (unsigned int i = 0; i < n; ++i)
            sum.gradient[i] += weight * (unit_gradient[i] * inverse);
          for (unsigned int i = 0; i < sum.hoop.size(); ++i)
            sum.hoop[i] += weight * values[i] / x[0];
        }
      return sum;
    }

    double
    volume_of_points(const MaterialPoints &points, const unsigned int cell)
    {
      return std::accumulate(&points.volume[points.first_point[cell]],
                             &points.volume[points.first_point[cell + 1] - 1] +
                               1,
                             0.);
    }

    /** Capacity of a cell with points: the part that can be soil, and the
     *  fraction of it filled by the volumes of its points. */
    struct Room
    {
      SoilPart part;
      double   share;  ///< of the cell
      double   volume; ///< of the part
      double   filled; ///< volume of the points over this
    };

    std::vector<Room>
    rooms_of_cells(const BackgroundMesh &mesh,
                   const KnownBoundary  &boundary,
                   const MaterialPoints &points)
    {
      std::vector<Room> rooms;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const BoundingBox<dim> box  = points.cells[c]->bounding_box();
          const SoilPart         part   = soil_part(box, boundary);
          double                 volume = 0.;
          for (const auto &[x, size] : part.quadrature(1))
            volume += size * mesh.measure(x); // which is linear
          rooms.push_back({part,
                           part.volume() / box.volume(),
                           volume,
                           volume_of_points(points, c) / volume});
        }
      return rooms;
    }

    /** Filled fractions of all cells of this rank and its ghost cells.
     *  Collective. */
    std::vector<double>
    filled_parts(const BackgroundMesh    &mesh,
                 const std::vector<Room> &rooms,
                 const MaterialPoints    &points)
    {
      const auto                                &tria = mesh.triangulation();
      LinearAlgebra::distributed::Vector<double> filled(
        tria.global_active_cell_index_partitioner().lock());
      for (unsigned int c = 0; c < rooms.size(); ++c)
        filled[points.cells[c]->global_active_cell_index()] = rooms[c].filled;
      filled.update_ghost_values();
      std::vector<double> result(tria.n_active_cells(), 0.);
      for (const Space::Cell &cell : tria.active_cell_iterators())
        if (!cell->is_artificial())
          result[cell->active_cell_index()] =
            filled[cell->global_active_cell_index()];
      return result;
    }

    /** Facets that are not buried: a cell away from them along their normal
     *  points fill less than half of a cell. Collective. */
    std::vector<LoadedFacet>
    free_facets(const BackgroundMesh        &mesh,
                const std::vector<SidePart> &facets,
                const MaterialPoints        &points)
    {
      std::vector<LoadedFacet> loaded(facets.begin(), facets.end()), free;
      std::vector<double>      filled(loaded.size(), 0.); // beyond each
      for (unsigned int c = 0; c < points.n_cells() && !loaded.empty(); ++c)
        {
          const BoundingBox<dim> box = points.cells[c]->bounding_box();
          const double           part = volume_of_points(points, c) /
                              (box.volume() * mesh.measure(box.center()));
          for (std::size_t i = 0; i < loaded.size(); ++i)
            {
              const LoadedFacet &facet = loaded[i];
              // Along an axis, diagonal facets through vertices would see the
              // cells that they cut.
              const Tensor<1, dim> area = area_of(facet.part),
                                   out  = box.side_length(facet.axis) /
                                         area.norm() * area;
              if (box.point_inside(facet.part.middle() + out))
                filled[i] = std::max(filled[i], part);
            }
        }
      sum_over_ranks(filled, mesh.triangulation().get_communicator());
      for (std::size_t i = 0; i < loaded.size(); ++i)
        if (filled[i] < 0.5)
          free.push_back(loaded[i]);
      return free;
    }

    /** Whether the cells around a vertex that can contain soil are filled. */
    std::vector<bool>
    surrounded_vertices(const BackgroundMesh      &mesh,
                        const KnownBoundary       &boundary,
                        const std::vector<double> &filled)
    {
      const auto         &tria = mesh.triangulation();
      std::vector<bool>   result(tria.n_vertices(), true);
      std::vector<double> available(tria.n_vertices(), 0.),
        taken(tria.n_vertices(), 0.);
      for (const Space::Cell &cell : tria.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const BoundingBox<dim> box  = cell->bounding_box();
            const double           soil =
                           soil_part(box, boundary).volume() / box.volume(),
                         part = filled[cell->active_cell_index()];
            if (!(soil > least_part))
              continue;
            for (const unsigned int v : cell->vertex_indices())
              {
                const unsigned int vertex = cell->vertex_index(v);
                available[vertex] += soil * box.volume();
                taken[vertex] += part * soil * box.volume();
                if (!(part > least_fill_of_cell))
                  result[vertex] = false;
              }
          }
      for (unsigned int vertex = 0; vertex < result.size(); ++vertex)
        result[vertex] =
          result[vertex] &&
          taken[vertex] >= least_fill_of_patch * available[vertex];
      return result;
    }

    /** The adjacent cell, if a boundary leaves a sliver without points in
     *  it. */
    std::optional<Space::Cell>
    sliver_beside(const Space::Cell         &cell,
                  const KnownBoundary       &boundary,
                  const std::vector<double> &filled)
    {
      std::array<bool, 2 *dim> is_limited = {};
      for (const SoilLimit &limit : boundary.limits)
        is_limited[2 * limit.axis + limit.soil_is_below] = true;
      for (const LoadedFacet &facet : boundary.loaded)
        is_limited[2 * facet.axis + facet.soil_is_below] = true;
      for (unsigned int face = 0; face < 2 * dim; ++face)
        {
          if (!is_limited[face] || cell->at_boundary(face))
            continue;
          const Space::Cell other = cell->neighbor(face);
          if (other->is_artificial() || filled[other->active_cell_index()] > 0.)
            continue;
          const BoundingBox<dim> box  = other->bounding_box();
          const double part = soil_part(box, boundary).volume() / box.volume();
          if (part > negligible_part && part < 1. - negligible_part)
            return other;
        }
      return std::nullopt;
    }

    /** Scales the weights of the points of a cell and shifts their gradients,
     *  so that sums over the points equal the integrals. */
    void
    match_integrals(const CellIntegrals &exact,
                    const unsigned int   cell,
                    const double         volume_of_points,
                    MaterialPoints      &points)
    {
      const unsigned int first    = points.first_point[cell],
                         n_points = points.first_point[cell + 1] - first,
                         n        = points.n_nodes;
      double *const weight        = &points.weight[first];
      for (unsigned int q = 0; q < n_points; ++q)
        weight[q] *= exact.volume / volume_of_points;
      const auto shift =
        [&](const auto &integral, double *values, const std::size_t stride) {
          for (unsigned int i = 0; i < n; ++i)
            {
              double defect = integral(i);
              for (unsigned int q = 0; q < n_points; ++q)
                defect -= weight[q] * values[q * stride + i];
              for (unsigned int q = 0; q < n_points; ++q)
                values[q * stride + i] += defect / exact.volume;
            }
        };
      for (unsigned int d = 0; d < dim; ++d)
        shift([&](const unsigned int i) { return exact.gradient[i][d]; },
              &points.gradients[(std::size_t(first) * dim + d) * n],
              dim * n);
      if (!points.hoop.empty())
        shift([&](const unsigned int i) { return exact.hoop[i]; },
              &points.hoop[std::size_t(first) * n],
              n);
    }
  } // namespace

  void
  make_consistent(const BackgroundMesh &mesh,
                  const Space          &space,
                  const SoilBoundary   &sides,
                  MaterialPoints       &points)
  {
    const KnownBoundary boundary{sides.limits,
                                 free_facets(mesh, sides.loaded, points)};
    points.weight.assign(points.volume.begin(), points.volume.end());
    const std::vector<Room>   rooms  = rooms_of_cells(mesh, boundary, points);
    const std::vector<double> filled = filled_parts(mesh, rooms, points);
    const std::vector<bool>   is_surrounded =
      surrounded_vertices(mesh, boundary, filled);
    std::vector<types::global_dof_index> nodes, nodes_beside;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const Space::Cell  cell(points.cells[c]);
        const Room        &room  = rooms[c];
        const unsigned int first = points.first_point[c],
                           last  = points.first_point[c + 1];
        if (room.share < negligible_part)
          {
            // Points beyond a loaded side would leave functions without
            // stiffness: it moves with the mean of the soil, not with points.
            if (soil_part(points.cells[c]->bounding_box(),
                          {boundary.limits, {}})
                  .volume() > 0.)
              continue;
            std::fill(&points.weight[first], &points.weight[last - 1] + 1, 0.);
            continue;
          }
        const auto vertices = cell->vertex_indices();
        const bool is_inside =
          std::all_of(vertices.begin(), vertices.end(), [&](const auto v) {
            return is_surrounded[cell->vertex_index(v)];
          });
        if (room.share > 1. - negligible_part && !is_inside &&
            !(std::abs(room.filled - 1.) < 0.03))
          continue;
        CellIntegrals exact = integrate(mesh, space, cell, room.part);
        if (const auto beside = sliver_beside(cell, boundary, filled))
          {
            space.cell_nodes(cell, nodes);
            space.cell_nodes(*beside, nodes_beside);
            exact.add(integrate(mesh,
                                space,
                                *beside,
                                soil_part((*beside)->bounding_box(), boundary)),
                      nodes_beside,
                      nodes);
          }
        match_integrals(exact, c, room.filled * room.volume, points);
      }
  }
} // namespace geocone::GEOCONE_DIM
