// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/mechanics/moving_boundary.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** Keeps of a + t (b - a) what lies on the side of a line with c + t d >= 0. */
    void
    clip(const double c, const double d, double &from, double &to)
    {
      if (d == 0.)
        {
          if (c < 0.)
            to = from - 1.;
        }
      else if (d > 0.)
        from = std::max(from, -c / d);
      else
        to = std::min(to, -c / d);
    }

    /** To the left of a direction. */
    Tensor<1, dim>
    left_of(const Tensor<1, dim> &x)
    {
      return Tensor<1, dim>({-x[1], x[0]});
    }

    /** The vertices of a cell. */
    std::vector<Point<dim>>
    counterclockwise(const TriaAccessor<dim, dim, dim> &cell)
    {
      std::vector<Point<dim>> around = {cell.vertex(0), cell.vertex(1)};
      if (cell.n_vertices() == 4)
        around.push_back(cell.vertex(3));
      around.push_back(cell.vertex(2));
      return around;
    }
  } // namespace

  std::vector<BoundaryPoint>
  points_on_line(const BackgroundMesh &mesh,
                 const Space          &space,
                 const Point<dim>     &a,
                 const Point<dim>     &b)
  {
    const QGauss<1>      rule(5);
    const Tensor<1, dim> along = b - a;
    // A shift that decides for a side where the line is a border of cells.
    const Point<dim>           start = a + 1e-9 * left_of(along);
    std::vector<BoundaryPoint> points;
    for (const auto &cell : mesh.own_cells())
      {
        double                        from = 0., to = 1.;
        const std::vector<Point<dim>> around = counterclockwise(*cell);
        for (unsigned int i = 0; i < around.size() && from < to; ++i)
          {
            const Point<dim>    &v = around[i];
            const Tensor<1, dim> into =
              left_of(around[(i + 1) % around.size()] - v);
            clip((start - v) * into, along * into, from, to);
          }
        if (!(to - from > 1e-12))
          continue;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            BoundaryPoint point;
            const double  t = from + (to - from) * rule.point(q)[0];
            point.position  = start + t * along;
            point.weight    = (to - from) * rule.weight(q);
            point.values.resize(space.nodes_per_cell());
            space.cell_nodes(cell, point.nodes);
            space.evaluate(cell,
                           mesh.unit_point(cell, point.position).value(),
                           point.values.data(),
                           nullptr);
            points.push_back(point);
          }
      }
    return points;
  }

  void
  refuse_no_part(const BoundaryCondition &condition, const std::size_t n_parts)
  {
    if (n_parts == 0)
      throw InputError(condition.parameter("Box"),
                       condition.part(),
                       "a box that holds a part of the sides of the body",
                       "check the sides and the box");
  }

  std::vector<MovingBoundary::Line>
  lines_of_body(const BoundaryCondition &condition, const Geometry &geometry)
  {
    if (geometry.outline.empty())
      throw InputError(
        condition.parameter("Sides"),
        Patterns::Tools::to_string(condition.sides),
        "sides of a body that is a box or a polygon",
        "describe the body as one of them; velocities may also be "
        "imposed on nodes of the background mesh");
    // Outlines may run either way.
    double area = 0.;
    for (std::size_t i = 0; i < geometry.outline.size(); ++i)
      {
        const Point<dim> &v = geometry.outline[i],
                         &w =
                           geometry.outline[(i + 1) % geometry.outline.size()];
        area += v[0] * w[1] - w[0] * v[1];
      }

    condition.check_sides(geometry.sides, "sides of the body");
    std::vector<MovingBoundary::Line> lines;
    for (const auto &[name, id] : geometry.sides)
      if (condition.is_on_side(name))
        {
          auto [a, b] = geometry.side_ends(id);
          if (area < 0.)
            std::swap(a, b);
          double from = 0., to = 1.;
          if (const auto box = condition.box_corners())
            for (unsigned int c = 0; c < dim; ++c)
              {
                const double tolerance = 1e-9 * a.distance(b);
                clip(a[c] - (*box)[0][c] + tolerance, b[c] - a[c], from, to);
                clip((*box)[1][c] - a[c] + tolerance, a[c] - b[c], from, to);
              }
          const Tensor<1, dim> along = b - a;
          if (to > from)
            lines.push_back(
              {a + from * along, a + to * along, (to - from) * along.norm()});
        }
    refuse_no_part(condition, lines.size());
    return lines;
  }

  MovingBoundary::MovingBoundary(const BoundaryCondition &condition,
                                 const Geometry          &geometry,
                                 const double             longest)
  {
    for (const Line &line : lines_of_body(condition, geometry))
      {
        const unsigned int n =
          longest > 0. ? std::ceil(line.length / longest - 1e-9) : 1;
        const Tensor<1, dim> part = (line.b - line.a) / n;
        for (unsigned int i = 0; i < n; ++i)
          lines.push_back(
            {line.a + i * part, line.a + (i + 1.) * part, line.length / n});
      }
  }
} // namespace geocone
