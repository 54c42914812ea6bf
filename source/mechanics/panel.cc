// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/clipped.h>
#include <geocone/base/exceptions.h>
#include <geocone/mechanics/panel.h>
#include <geocone/scene/edge_normal.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

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

    /** Of a body that is a box in space, rectangles. */
    std::vector<Panel>
    panels_of_box(const BoundaryCondition &condition, const Geometry &geometry)
    {
      geometry.refuse_where("conditions on sides of particles",
                            "they are on sides of a whole box");
      if (geometry.outline.empty())
        throw InputError(condition.parameter("Sides"),
                         Patterns::Tools::to_string(condition.sides),
                         "sides of a body that is a box",
                         "describe the body as one, or set "
                         "Discretisation/Method = FEM; a velocity may also be "
                         "that of an obstacle");
      condition.check_sides(geometry.sides, "sides of the body");
      const auto [lower, upper] = geometry.bounding_box();
      const auto         box    = condition.box_corners();
      std::vector<Panel> panels;
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
            // These, and d, are right-handed.
            std::array<unsigned int, 2> across = {
              {(d + 1) % dim, (d + 2) % dim}};
            if (!is_upper)
              std::swap(across[0], across[1]);
            Panel panel;
            panel.corner = low;
            for (unsigned int k = 0; k + 1 < dim; ++k)
              panel.edges[k][across[k]] = high[across[k]] - low[across[k]];
            panels.push_back(panel);
          }
      refuse_no_part(condition, panels.size());
      return panels;
    }
  } // namespace

  Point<dim>
  Panel::at(const Point<dim - 1> &s) const
  {
    Point<dim> x = corner;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      x += s[k] * edges[k];
    return x;
  }

  Tensor<1, dim>
  Panel::area() const
  {
    if (dim == 2)
      return edge_normal(corner, Point<dim>(corner + edges[0]));
    return cross_product_3d(edges[0], edges[dim - 2]);
  }

  std::vector<Point<dim>>
  Panel::corners() const
  {
    std::vector<Point<dim>> all;
    for (const unsigned int i : GeometryInfo<dim - 1>::vertex_indices())
      all.push_back(at(GeometryInfo<dim - 1>::unit_cell_vertex(i)));
    return all;
  }

  std::array<Point<dim>, dim>
  Panel::ends() const
  {
    std::array<Point<dim>, dim> ends;
    ends[0] = corner;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      ends[k + 1] = corner + edges[k];
    return ends;
  }

  void
  Panel::span(const std::array<Point<dim>, dim> &ends)
  {
    corner = ends[0];
    for (unsigned int k = 0; k + 1 < dim; ++k)
      edges[k] = ends[k + 1] - corner;
  }

  std::vector<Panel>
  Panel::parts(const std::array<unsigned int, dim - 1> &n) const
  {
    std::vector<Panel> all = {*this};
    for (unsigned int k = 0; k + 1 < dim; ++k)
      {
        std::vector<Panel> divided;
        for (const Panel &panel : all)
          for (unsigned int i = 0; i < n[k]; ++i)
            {
              Panel &part = divided.emplace_back(panel);
              part.edges[k] /= n[k];
              part.corner += double(i) * part.edges[k];
            }
        all = divided;
      }
    return all;
  }

  std::vector<Panel>
  panels_of_body(const BoundaryCondition &condition, const Geometry &geometry)
  {
    if (dim == 3)
      return panels_of_box(condition, geometry);
    std::vector<Panel> panels;
    for (const auto &line : lines_of_body(condition, geometry))
      panels.push_back({line.a, {{line.b - line.a}}});
    return panels;
  }

  std::vector<BoundaryPoint>
  points_on_panel(const BackgroundMesh &mesh,
                  const Space          &space,
                  const Panel          &panel)
  {
    const std::vector<Point<dim>> x = panel.corners();
    if (dim == 2)
      return points_on_line(mesh, space, x[0], x[1]);
    std::vector<BoundaryPoint> points;
    for_each_point_of_triangles(
      mesh,
      space,
      {{{x[0], x[1], x[3]}}, {{x[0], x[3], x[2]}}},
      [&](const std::size_t, const BoundaryPoint &point) {
        points.push_back(point);
        points.back().weight /= 2.;
      });
    return points;
  }

  std::vector<double>
  for_each_point_of_triangles(
    const BackgroundMesh             &mesh,
    const Space                      &space,
    const std::vector<SpaceTriangle> &triangles,
    const std::function<void(const std::size_t, const BoundaryPoint &)> &f)
  {
    const QWitherdenVincentSimplex<2> rule(4);
    std::vector<double>               parts(triangles.size(), 0.);
    // What of a triangle may be in which cell, by boxes.
    std::vector<BoundingBox<dim>> boxes;
    std::vector<Outline>          outlines;
    for (const auto &[a, b, c] : triangles)
      {
        // A shift that decides for the body where it is on a border of cells.
        const Tensor<1, dim> area = cross_product_3d(b - a, c - a) / 2.,
                             back = -1e-9 / std::sqrt(area.norm()) * area;
        outlines.push_back(
          {Point<dim>(a + back), Point<dim>(b + back), Point<dim>(c + back)});
        boxes.emplace_back(outlines.back());
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
                    f(t, point);
                  }
              }
          }
      }
    return parts;
  }
} // namespace geocone
