// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/points/consistent_integration.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Fraction of a cell's size that counts as zero. */
    constexpr double negligible_part = 1e-9;

    /** Filled fractions of the volume of the cells around a vertex, and of each
     *  of them, from which the vertex is in the body. At a flat surface half of
     *  them are full and the others to two fifths. Single cells of a body that is
     *  sheared a lot may be less than half full. */
    constexpr double least_fill_of_patch = 0.7, least_fill_of_cell = 0.1;

    /** Soil fraction of a cell up to which it need not be filled. */
    constexpr double least_part = 0.1;

    /** Lower and upper corner of a box. */
    using Corners = std::pair<Point<dim>, Point<dim>>;

    /** Part of a cell's box on the soil's side of the limits that intersect it
     *  or lie at most one cell away. */
    Corners
    soil_part(const BoundingBox<dim> &box, const std::vector<SoilLimit> &limits)
    {
      auto [lower, upper] = box.get_boundary_points();
      for (const SoilLimit &limit : limits)
        {
          bool acts = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double size = box.side_length(d);
              acts =
                acts && (d == limit.axis
                           ? limit.level > box.lower_bound(d) - size &&
                               limit.level < box.upper_bound(d) + size
                           : limit.extent.lower_bound(d) <
                                 box.lower_bound(d) + negligible_part * size &&
                               limit.extent.upper_bound(d) >
                                 box.upper_bound(d) - negligible_part * size);
            }
          if (!acts)
            continue;
          const double level = std::clamp(limit.level,
                                          box.lower_bound(limit.axis),
                                          box.upper_bound(limit.axis));
          if (limit.soil_is_below)
            upper[limit.axis] = std::min(upper[limit.axis], level);
          else
            lower[limit.axis] = std::max(lower[limit.axis], level);
        }
      return {lower, upper};
    }

    /** Fraction of the cell's volume in this part. */
    double
    share(const Corners &part, const BoundingBox<dim> &box)
    {
      double product = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        product *=
          std::max(0., part.second[d] - part.first[d]) / box.side_length(d);
      return product;
    }

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
    integrate(const BackgroundMesh  &mesh,
              const Space           &space,
              const Space::Cell     &cell,
              const Corners         &part,
              const Quadrature<dim> &quadrature)
    {
      const unsigned int          n   = space.nodes_per_cell();
      const BoundingBox<dim>      box = cell->bounding_box();
      std::vector<double>         values(n);
      std::vector<Tensor<1, dim>> unit_gradient(n);
      CellIntegrals               sum;
      sum.gradient.resize(n);
      sum.hoop.resize(mesh.is_axisymmetric() ? n : 0);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          Point<dim> x, unit;
          double     weight = quadrature.weight(q);
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double length = part.second[d] - part.first[d];
              x[d]    = part.first[d] + length * quadrature.point(q)[d];
              unit[d] = (x[d] - box.lower_bound(d)) / box.side_length(d);
              weight *= length;
            }
          weight *= mesh.measure(x);
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

    /** Capacity of a cell with points: the part that can be soil, and the
     *  fraction of it filled by the volumes of its points. */
    struct Room
    {
      Corners part;
      double  share;  ///< of the cell
      double  volume; ///< of the part
      double  filled; ///< volume of the points over this
    };

    std::vector<Room>
    rooms_of_cells(const BackgroundMesh         &mesh,
                   const std::vector<SoilLimit> &limits,
                   const MaterialPoints         &points)
    {
      std::vector<Room> rooms;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const BoundingBox<dim> box  = points.cells[c]->bounding_box();
          const Corners          part = soil_part(box, limits);
          const double           soil = share(part, box);
          // The measure is linear.
          const double volume =
            soil * box.volume() *
            mesh.measure(part.first + (part.second - part.first) / 2.);
          rooms.push_back(
            {part,
             soil,
             volume,
             std::accumulate(&points.volume[points.first_point[c]],
                             &points.volume[points.first_point[c + 1] - 1] + 1,
                             0.) /
               volume});
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

    /** Whether the cells around a vertex that can contain soil are filled. */
    std::vector<bool>
    surrounded_vertices(const BackgroundMesh         &mesh,
                        const std::vector<SoilLimit> &limits,
                        const std::vector<double>    &filled)
    {
      const auto         &tria = mesh.triangulation();
      std::vector<bool>   result(tria.n_vertices(), true);
      std::vector<double> available(tria.n_vertices(), 0.),
        taken(tria.n_vertices(), 0.);
      for (const Space::Cell &cell : tria.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const BoundingBox<dim> box  = cell->bounding_box();
            const double           soil = share(soil_part(box, limits), box),
                         part           = filled[cell->active_cell_index()];
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

    /** The adjacent cell, if a limit leaves a sliver without points in it. */
    std::optional<Space::Cell>
    sliver_beside(const Space::Cell            &cell,
                  const std::vector<SoilLimit> &limits,
                  const std::vector<double>    &filled)
    {
      for (const SoilLimit &limit : limits)
        {
          const unsigned int face =
            2 * limit.axis + (limit.soil_is_below ? 1 : 0);
          if (cell->at_boundary(face))
            continue;
          const Space::Cell other = cell->neighbor(face);
          if (other->is_artificial() || filled[other->active_cell_index()] > 0.)
            continue;
          const BoundingBox<dim> box  = other->bounding_box();
          const double           part = share(soil_part(box, limits), box);
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
  make_consistent(const BackgroundMesh         &mesh,
                  const Space                  &space,
                  const std::vector<SoilLimit> &limits,
                  MaterialPoints               &points)
  {
    points.weight.assign(points.volume.begin(), points.volume.end());
    const std::vector<Room> rooms = rooms_of_cells(mesh, limits, points);
    const std::vector<double> filled = filled_parts(mesh, rooms, points);
    const std::vector<bool>   is_surrounded =
      surrounded_vertices(mesh, limits, filled);
    const QGauss<dim>       quadrature(space.degree() / 2 + 1 +
                                 (mesh.is_axisymmetric() ? 1 : 0));
    std::vector<types::global_dof_index> nodes, nodes_beside;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const Space::Cell  cell(points.cells[c]);
        const Room        &room  = rooms[c];
        const unsigned int first = points.first_point[c],
                           last  = points.first_point[c + 1];
        if (room.share < negligible_part)
          {
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
        CellIntegrals exact =
          integrate(mesh, space, cell, room.part, quadrature);
        if (const auto beside = sliver_beside(cell, limits, filled))
          {
            space.cell_nodes(cell, nodes);
            space.cell_nodes(*beside, nodes_beside);
            exact.add(integrate(mesh,
                                space,
                                *beside,
                                soil_part((*beside)->bounding_box(), limits),
                                quadrature),
                      nodes_beside,
                      nodes);
          }
        match_integrals(exact, c, room.filled * room.volume, points);
      }
  }
} // namespace geocone::GEOCONE_DIM
