// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/functions/triangle_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Relative distance up to which points beside a triangle belong to it. */
    constexpr double rounding = 1e-6;
  } // namespace

  std::array<Tensor<1, 2>, 3>
  barycentric_gradients(const std::array<Point<dim>, 3> &corners)
  {
    const auto edge = [&](const unsigned int from, const unsigned int to) {
      const Tensor<1, dim> along = corners[to % 3] - corners[from % 3];
      return std::array<double, 2>{{along[0], along[1]}};
    };
    const auto                  a = edge(0, 1), b = edge(0, 2);
    const double                twice_area = a[0] * b[1] - a[1] * b[0];
    std::array<Tensor<1, 2>, 3> g;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const auto opposite = edge(i + 1, i + 2);
        g[i] = Tensor<1, 2>({-opposite[1], opposite[0]}) / twice_area;
      }
    return g;
  }

  TriangleField::TriangleField(std::vector<Point<dim>> vertices_of_mesh,
                               std::vector<Cell>       cells_of_mesh,
                               std::vector<double>     values_at_vertices)
    : vertices(std::move(vertices_of_mesh))
    , cells(std::move(cells_of_mesh))
    , values(std::move(values_at_vertices))
  {
    std::array<double, 2> upper;
    corner.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
    for (const Point<dim> &x : vertices)
      for (unsigned int d = 0; d < 2; ++d)
        {
          corner[d] = std::min(corner[d], x[d]);
          upper[d]  = std::max(upper[d], x[d]);
        }
    // About a box per triangle.
    const double edge =
      std::sqrt((upper[0] - corner[0]) * (upper[1] - corner[1]) / cells.size());
    for (unsigned int d = 0; d < 2; ++d)
      {
        n_boxes[d] = std::clamp((upper[d] - corner[d]) / edge, 1., 1e4);
        size[d]    = (upper[d] - corner[d]) / n_boxes[d];
      }
    const auto for_boxes_of = [&](const Cell &cell, const auto &f) {
      std::array<double, 2> low, high;
      for (unsigned int d = 0; d < 2; ++d)
        {
          std::tie(low[d], high[d]) = std::minmax(
            {vertices[cell[0]][d], vertices[cell[1]][d], vertices[cell[2]][d]});
          const double margin = rounding * (high[d] - low[d]);
          low[d] -= margin;
          high[d] += margin;
        }
      const auto first = box_at(low[0], low[1]),
                 last  = box_at(high[0], high[1]);
      for (unsigned int j = first[1]; j <= last[1]; ++j)
        for (unsigned int i = first[0]; i <= last[0]; ++i)
          f(j * n_boxes[0] + i);
    };
    start.assign(n_boxes[0] * n_boxes[1] + 1, 0);
    for (const Cell &cell : cells)
      for_boxes_of(cell, [&](const unsigned int box) { ++start[box + 1]; });
    for (unsigned int box = 0; box + 1 < start.size(); ++box)
      start[box + 1] += start[box];
    in_box.resize(start.back());
    std::vector<unsigned int> next(start.begin(), start.end() - 1);
    for (unsigned int c = 0; c < cells.size(); ++c)
      for_boxes_of(cells[c],
                   [&](const unsigned int box) { in_box[next[box]++] = c; });
  }

  std::array<unsigned int, 2>
  TriangleField::box_at(const double x, const double y) const
  {
    const auto number = [&](const double at, const unsigned int d) {
      return static_cast<unsigned int>(
        std::clamp((at - corner[d]) / size[d], 0., n_boxes[d] - 1.));
    };
    return {{number(x, 0), number(y, 1)}};
  }

  std::optional<TriangleField::At>
  TriangleField::locate(const Point<dim> &x) const
  {
    if (!std::isfinite(x[0] + x[1]))
      return std::nullopt;
    const auto         box     = box_at(x[0], x[1]);
    const unsigned int number  = box[1] * n_boxes[0] + box[0];
    double             nearest = -rounding;
    std::optional<At>  found;
    for (unsigned int k = start[number]; k < start[number + 1]; ++k)
      {
        At         at{in_box[k], {}};
        const auto g = gradients(at.cell);
        for (unsigned int i = 0; i < 3; ++i)
          {
            // Zero on the opposite side.
            const Point<dim> &on = vertices[cells[at.cell][(i + 1) % 3]];
            at.barycentric[i] =
              g[i][0] * (x[0] - on[0]) + g[i][1] * (x[1] - on[1]);
          }
        const double least =
          std::min({at.barycentric[0], at.barycentric[1], at.barycentric[2]});
        if (least >= 0.)
          return at;
        if (least > nearest)
          {
            nearest = least;
            found   = at;
          }
      }
    return found;
  }

  double
  TriangleField::value(const Point<dim> &x) const
  {
    double     sum = 0.;
    const auto at  = locate(x);
    for (unsigned int i = 0; i < 3 && at; ++i)
      sum += at->barycentric[i] * values[cells[at->cell][i]];
    return sum;
  }

  Tensor<1, dim>
  TriangleField::gradient(const Point<dim> &x) const
  {
    Tensor<1, dim> sum;
    if (const auto at = locate(x))
      {
        const auto g = gradients(at->cell);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int d = 0; d < 2; ++d)
            sum[d] += values[cells[at->cell][i]] * g[i][d];
      }
    return sum;
  }
} // namespace geocone::GEOCONE_DIM
