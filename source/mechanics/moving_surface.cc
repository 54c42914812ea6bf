// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/clipped.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/mechanics/moving_surface.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    using Outline = std::vector<Point<dim>>;

    double
    area_of_triangle(const Point<dim> &a,
                     const Point<dim> &b,
                     const Point<dim> &c)
    {
      return cross_product_3d(b - a, c - a).norm() / 2.;
    }

    /** The planes of a cell: a place on each, and the way into the cell. */
    std::vector<std::pair<Point<dim>, Tensor<1, dim>>>
    planes_of(const BackgroundMesh::Cell &cell)
    {
      std::vector<std::pair<Point<dim>, Tensor<1, dim>>> planes;
      const Point<dim> middle = cell->center();
      for (const unsigned int f : cell->face_indices())
        {
          const auto           face = cell->face(f);
          const Point<dim>     on   = face->vertex(0);
          const Tensor<1, dim> into =
            cross_product_3d(face->vertex(1) - on, face->vertex(2) - on);
          planes.push_back({on, (middle - on) * into < 0. ? -into : into});
        }
      return planes;
    }
  } // namespace

  MovingSurface::MovingSurface(const BoundaryCondition &condition,
                               const Geometry          &geometry,
                               const double             longest)
  {
    geometry.refuse_where("tractions on sides of particles",
                          "they are on sides of a whole box");
    if (geometry.outline.empty())
      throw InputError(condition.parameter("Sides"),
                       Patterns::Tools::to_string(condition.sides),
                       "sides of a body that is a box",
                       "describe the body as one, or set "
                       "Discretisation/Method = FEM");
    std::string known = "all";
    for (const auto &side : geometry.sides)
      known += ", " + side.first;
    for (const std::string &name : condition.sides)
      if (name != "all" && geometry.sides.count(name) == 0)
        throw InputError(condition.parameter("Sides"),
                         name,
                         known + " (sides of the body)",
                         "choose some of them");
    const auto [lower, upper] = geometry.bounding_box();
    const auto box            = condition.box_corners();
    for (unsigned int d = 0; d < dim; ++d)
      for (const bool is_upper : {false, true})
        {
          if (!condition.is_on_side(side_of_box[d][is_upper]))
            continue;
          // A rectangle across d, or its part in the box.
          Point<dim> low = lower, high = upper;
          low[d] = high[d] = (is_upper ? upper : lower)[d];
          bool is_there    = true;
          for (unsigned int c = 0; c < dim && box; ++c)
            {
              const double tolerance = 1e-9 * lower.distance(upper);
              if (c == d)
                is_there = is_there && low[c] >= (*box)[0][c] - tolerance &&
                           low[c] <= (*box)[1][c] + tolerance;
              else
                {
                  low[c]   = std::max(low[c], (*box)[0][c]);
                  high[c]  = std::min(high[c], (*box)[1][c]);
                  is_there = is_there && high[c] > low[c];
                }
            }
          if (!is_there)
            continue;
          const unsigned int a = (d + 1) % dim, b = (d + 2) % dim;
          const auto         parts_of = [&](const unsigned int c) {
            return std::max(static_cast<unsigned int>(
                              std::ceil((high[c] - low[c]) / longest - 1e-9)),
                            1U);
          };
          const unsigned int n_a = parts_of(a), n_b = parts_of(b);
          const double       area =
            (high[a] - low[a]) / n_a * (high[b] - low[b]) / n_b / 2.;
          const unsigned int first = places.size();
          for (unsigned int j = 0; j <= n_b; ++j)
            for (unsigned int i = 0; i <= n_a; ++i)
              {
                Point<dim> x = low;
                x[a] += (high[a] - low[a]) * i / n_a;
                x[b] += (high[b] - low[b]) * j / n_b;
                places.push_back(x);
              }
          for (unsigned int j = 0; j < n_b; ++j)
            for (unsigned int i = 0; i < n_a; ++i)
              {
                const unsigned int p = first + j * (n_a + 1) + i,
                                   q = p + n_a + 1;
                // a, b and d are right-handed.
                std::array<unsigned int, 3> one = {{p, p + 1, q + 1}},
                                            two = {{p, q + 1, q}};
                if (!is_upper)
                  {
                    std::swap(one[1], one[2]);
                    std::swap(two[1], two[2]);
                  }
                triangles.push_back({one, area});
                triangles.push_back({two, area});
              }
        }
    if (triangles.empty())
      throw InputError(condition.parameter("Box"),
                       condition.part(),
                       "a box that holds a part of the sides of the body",
                       "check the sides and the box");
  }

  Tensor<1, dim>
  MovingSurface::area_of(const Triangle &triangle) const
  {
    const Point<dim> &a = places[triangle.corners[0]];
    return cross_product_3d(places[triangle.corners[1]] - a,
                            places[triangle.corners[2]] - a) /
           2.;
  }

  std::vector<double>
  MovingSurface::for_each_point(
    const BackgroundMesh                                               &mesh,
    const Space                                                        &space,
    const std::function<void(const Triangle &, const BoundaryPoint &)> &f) const
  {
    const QWitherdenVincentSimplex<2> rule(4);
    std::vector<double>               parts(triangles.size(), 0.);
    // What of a triangle may be in which cell, by boxes.
    std::vector<BoundingBox<dim>> boxes;
    std::vector<Outline>          outlines;
    for (const Triangle &triangle : triangles)
      {
        // A shift that decides for the body where it is on a border of cells.
        const Tensor<1, dim> area = area_of(triangle);
        const double         size = std::sqrt(area.norm());
        Outline              outline;
        for (const unsigned int corner : triangle.corners)
          outline.push_back(Point<dim>(places[corner] - 1e-9 / size * area));
        boxes.emplace_back(outline);
        outlines.push_back(outline);
      }
    BoundaryPoint point;
    for (const auto &cell : mesh.own_cells())
      {
        const auto box = cell->bounding_box();
        std::vector<std::pair<Point<dim>, Tensor<1, dim>>> planes;
        for (std::size_t t = 0; t < triangles.size(); ++t)
          {
            bool meets = true;
            for (unsigned int d = 0; d < dim; ++d)
              meets = meets && boxes[t].lower_bound(d) <= box.upper_bound(d) &&
                      boxes[t].upper_bound(d) >= box.lower_bound(d);
            if (!meets)
              continue;
            if (planes.empty())
              {
                planes = planes_of(cell);
                space.cell_nodes(cell, point.nodes);
              }
            Outline rest = outlines[t];
            for (const auto &[on, into] : planes)
              rest = clipped(rest, on, into);
            const double whole =
              area_of_triangle(outlines[t][0], outlines[t][1], outlines[t][2]);
            for (std::size_t i = 2; i < rest.size(); ++i)
              {
                const double share =
                  area_of_triangle(rest[0], rest[i - 1], rest[i]) / whole;
                if (share < 1e-12)
                  continue;
                parts[t] += share;
                for (unsigned int q = 0; q < rule.size(); ++q)
                  {
                    point.position =
                      rest[0] + rule.point(q)[0] * (rest[i - 1] - rest[0]) +
                      rule.point(q)[1] * (rest[i] - rest[0]);
                    point.weight    = 2. * rule.weight(q) * share;
                    const auto unit = mesh.unit_point(cell, point.position);
                    if (!unit)
                      continue;
                    point.values.resize(space.nodes_per_cell());
                    space.evaluate(cell, *unit, point.values.data(), nullptr);
                    f(triangles[t], point);
                  }
              }
          }
      }
    return parts;
  }

  void
  MovingSurface::move(const BackgroundMesh &mesh,
                      const Space          &space,
                      const Vector         &v,
                      const double          h)
  {
    // A place in the body by each corner, towards the middles of its triangles.
    std::vector<Tensor<1, dim>> inward(places.size());
    for (const Triangle &triangle : triangles)
      {
        const Tensor<1, dim> area = area_of(triangle);
        Point<dim>           middle;
        for (const unsigned int corner : triangle.corners)
          middle += places[corner] / 3.;
        for (const unsigned int corner : triangle.corners)
          inward[corner] += 1e-6 * (middle - places[corner]) -
                            1e-9 / std::sqrt(area.norm()) * area;
      }
    // The velocity there, and how many cells of all ranks know it.
    constexpr unsigned int               n_sums = dim + 1;
    std::vector<double>                  sums(n_sums * places.size(), 0.);
    std::vector<types::global_dof_index> nodes;
    std::vector<double>                  N(space.nodes_per_cell());
    for (const auto &cell : mesh.own_cells())
      {
        const auto box = cell->bounding_box();
        for (std::size_t k = 0; k < places.size(); ++k)
          {
            const Point<dim> x = places[k] + inward[k];
            if (!box.point_inside(x, 1e-6))
              continue;
            const auto unit = mesh.unit_point(cell, x);
            if (!unit)
              continue;
            space.cell_nodes(cell, nodes);
            space.evaluate(cell, *unit, N.data(), nullptr);
            double *const own = &sums[n_sums * k];
            own[dim] += 1.;
            for (unsigned int i = 0; i < nodes.size(); ++i)
              for (unsigned int d = 0; d < dim; ++d)
                own[d] +=
                  N[i] * v.local_element(dim * space.local_node(nodes[i]) + d);
          }
      }
    sum_over_ranks(sums, v.get_mpi_communicator());
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const double *own = &sums[n_sums * k];
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (own[dim] > 0.)
              places[k][d] += h * own[d] / own[dim];
            if (!mesh.grid()[d].empty())
              places[k][d] = std::clamp(
                places[k][d], mesh.grid()[d].front(), mesh.grid()[d].back());
          }
      }
  }
} // namespace geocone
