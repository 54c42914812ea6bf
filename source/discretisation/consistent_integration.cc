// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/consistent_integration.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** A part of a cell's size that counts as nothing. */
    constexpr double rounding = 1e-9;

    /** The part of its room by volumes of points from which a cell counts as filled. */
    constexpr double least_fill = 0.4;

    /** The part of a cell up to which it need not be. */
    constexpr double least_part = 0.1;

    /** The part of a cell's box, from lower to upper corner, on the soil's side of the
     *  limits that cross it, or end at most one cell from it. */
    std::pair<Point<dim>, Point<dim>>
    soil_part(const BoundingBox<dim> &box, const std::vector<SoilLimit> &limits)
    {
      auto [lower, upper] = box.get_boundary_points();
      for (const SoilLimit &limit : limits)
        {
          bool acts = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double size = box.side_length(d);
              acts              = acts && (d == limit.axis
                                             ? limit.level > box.lower_bound(d) - size &&
                                    limit.level < box.upper_bound(d) + size
                                             : limit.extent.lower_bound(d) <
                                      box.lower_bound(d) + rounding * size &&
                                    limit.extent.upper_bound(d) >
                                      box.upper_bound(d) - rounding * size);
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

    /** The part of the cell's volume that it is. */
    double
    share(const std::pair<Point<dim>, Point<dim>> &part,
          const BoundingBox<dim>                  &box)
    {
      double product = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        product *=
          std::max(0., part.second[d] - part.first[d]) / box.side_length(d);
      return product;
    }

    /** Integrals of what the corrections need over a part of a cell. */
    struct CellIntegrals
    {
      double                      volume = 0.;
      std::vector<Tensor<1, dim>> gradient; ///< of grad N_i
      std::vector<double>         hoop;     ///< of N_i/r, around an axis

      /** Adds those of another cell, for the nodes that are among those of this one. */
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
    integrate(const BackgroundMesh                    &mesh,
              const Space                             &space,
              const Space::Cell                       &cell,
              const std::pair<Point<dim>, Point<dim>> &part,
              const Quadrature<dim>                   &quadrature)
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

    /** Shifts a row of n functions at the points from first to last, so that its
     *  integral over the points is that over the cell. */
    template <typename Integral>
    void
    shift_to_integral(const double         volume,
                      const Integral      &integral,
                      const double        *weight,
                      double              *values,
                      const std::size_t    stride,
                      const unsigned int   n_points,
                      const unsigned int   n,
                      std::vector<double> &shift)
    {
      shift.resize(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          double sum = integral(i);
          for (unsigned int q = 0; q < n_points; ++q)
            sum -= weight[q] * values[q * stride + i];
          shift[i] = sum / volume;
        }
      for (unsigned int q = 0; q < n_points; ++q)
        for (unsigned int i = 0; i < n; ++i)
          values[q * stride + i] += shift[i];
    }
  } // namespace

  void
  make_consistent(const BackgroundMesh         &mesh,
                  const Space                  &space,
                  const std::vector<SoilLimit> &limits,
                  MaterialPoints               &points)
  {
    const auto &tria = mesh.triangulation();
    points.weight.assign(points.volume.begin(), points.volume.end());

    // Vertices around which all that can hold soil is filled with it.
    std::vector<Space::Cell> filled_cells;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        double volume = 0.;
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          volume += points.volume[p];
        const auto part = soil_part(points.cells[c]->bounding_box(), limits);
        double     room =
          mesh.measure(part.first + (part.second - part.first) / 2.);
        for (unsigned int d = 0; d < dim; ++d)
          room *= part.second[d] - part.first[d];
        if (volume > least_fill * room)
          filled_cells.push_back(points.cells[c]);
      }
    std::vector<bool>       is_surrounded(tria.n_vertices(), true);
    const std::vector<bool> is_filled = mesh.is_among(filled_cells);
    for (const Space::Cell &cell : tria.active_cell_iterators())
      if (!cell->is_artificial() && !is_filled[cell->active_cell_index()])
        if (const BoundingBox<dim> box = cell->bounding_box();
            share(soil_part(box, limits), box) > least_part)
          for (const unsigned int v : cell->vertex_indices())
            is_surrounded[cell->vertex_index(v)] = false;

    // Slivers of soil without points below a limit belong to the cell beside them.
    const std::vector<bool> has_points = mesh.is_among(points.cells);
    const auto              sliver_beside =
      [&](const Space::Cell &cell) -> std::optional<Space::Cell> {
      for (const SoilLimit &limit : limits)
        {
          const unsigned int face =
            2 * limit.axis + (limit.soil_is_below ? 1 : 0);
          if (cell->at_boundary(face))
            continue;
          const Space::Cell other = cell->neighbor(face);
          if (other->is_artificial() || has_points[other->active_cell_index()])
            continue;
          const BoundingBox<dim> box  = other->bounding_box();
          const double           part = share(soil_part(box, limits), box);
          if (part > rounding && part < 1. - rounding)
            return other;
        }
      return std::nullopt;
    };

    const unsigned int                   n = points.n_nodes;
    const QGauss<dim>                    quadrature(space.degree() / 2 + 1 +
                                 (mesh.is_axisymmetric() ? 1 : 0));
    std::vector<types::global_dof_index> nodes, nodes_beside;
    std::vector<double>                  shift;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const Space::Cell  cell(points.cells[c]);
        const unsigned int first    = points.first_point[c],
                           n_points = points.first_point[c + 1] - first;
        const BoundingBox<dim> box  = cell->bounding_box();
        const auto             part = soil_part(box, limits);
        const double           soil = share(part, box);
        if (n_points == 0)
          continue;
        double *const weight = &points.weight[first];
        const double  volume = std::accumulate(weight, weight + n_points, 0.);
        if (soil < rounding)
          {
            std::fill(weight, weight + n_points, 0.);
            continue;
          }
        CellIntegrals exact    = integrate(mesh, space, cell, part, quadrature);
        const auto    vertices = cell->vertex_indices();
        const bool    is_inside =
          std::all_of(vertices.begin(), vertices.end(), [&](const auto v) {
            return is_surrounded[cell->vertex_index(v)];
          });
        const double filled  = volume / exact.volume;
        const bool   is_full = soil < 1. - rounding ||
                             (is_inside && n_points > 1 && filled > 0.3) ||
                             std::abs(filled - 1.) < 0.03;
        if (!is_full)
          continue;
        if (const auto beside = sliver_beside(cell))
          {
            const CellIntegrals more =
              integrate(mesh,
                        space,
                        *beside,
                        soil_part((*beside)->bounding_box(), limits),
                        quadrature);
            space.cell_nodes(cell, nodes);
            space.cell_nodes(*beside, nodes_beside);
            exact.add(more, nodes_beside, nodes);
          }
        for (unsigned int q = 0; q < n_points; ++q)
          weight[q] *= exact.volume / volume;
        for (unsigned int d = 0; d < dim; ++d)
          shift_to_integral(
            exact.volume,
            [&](const unsigned int i) { return exact.gradient[i][d]; },
            weight,
            &points.gradients[(std::size_t(first) * dim + d) * n],
            dim * n,
            n_points,
            n,
            shift);
        if (!points.hoop.empty())
          shift_to_integral(
            exact.volume,
            [&](const unsigned int i) { return exact.hoop[i]; },
            weight,
            &points.hoop[std::size_t(first) * n],
            n,
            n_points,
            n,
            shift);
      }
  }
} // namespace geocone
