// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/functions/simplex_field.h>

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
    /** Relative distance up to which points beside a cell belong to it. */
    constexpr double rounding = 1e-6;

    constexpr unsigned int n_corners = dim + 1;
  } // namespace

  std::array<Tensor<1, dim>, dim + 1>
  barycentric_gradients(const std::array<Point<dim>, dim + 1> &corners)
  {
    std::array<Tensor<1, dim>, dim + 1> g;
    const auto edge = [&](const unsigned int from, const unsigned int to) {
      return corners[to % n_corners] - corners[from % n_corners];
    };
    if constexpr (dim == 2)
      {
        const Tensor<1, dim> a = edge(0, 1), b = edge(0, 2);
        const double         twice_area = a[0] * b[1] - a[1] * b[0];
        for (unsigned int i = 0; i < n_corners; ++i)
          {
            const Tensor<1, dim> opposite = edge(i + 1, i + 2);
            g[i][0]                       = -opposite[1] / twice_area;
            g[i][1]                       = opposite[0] / twice_area;
          }
      }
    else
      for (unsigned int i = 0; i < n_corners; ++i)
        {
          const Tensor<1, dim> n =
            cross_product_3d(edge(i + 1, i + 2), edge(i + 1, i + 3));
          g[i] = n / (n * edge(i + 1, i));
        }
    return g;
  }

  SimplexField::SimplexField(std::vector<Point<dim>> vertices_of_mesh,
                             std::vector<Cell>       cells_of_mesh,
                             std::vector<double>     values_at_vertices)
    : SimplexField(std::move(vertices_of_mesh),
                   std::move(cells_of_mesh),
                   1,
                   {},
                   std::move(values_at_vertices))
  {}

  SimplexField::SimplexField(std::vector<Point<dim>> vertices_of_mesh,
                             std::vector<Cell>       cells_of_mesh,
                             const unsigned int      degree,
                             std::vector<std::vector<unsigned int>> nodes,
                             std::vector<double> values_at_nodes)
    : vertices(std::move(vertices_of_mesh))
    , cells(std::move(cells_of_mesh))
    , shape(degree)
    , nodes(std::move(nodes))
    , values(std::move(values_at_nodes))
  {
    std::array<double, dim> upper;
    corner.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
    for (const Point<dim> &x : vertices)
      for (unsigned int d = 0; d < dim; ++d)
        {
          corner[d] = std::min(corner[d], x[d]);
          upper[d]  = std::max(upper[d], x[d]);
        }
    // About a box per cell.
    double volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= upper[d] - corner[d];
    volume /= cells.size();
    const double edge       = dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
    unsigned int n_all      = 1;
    const double most_boxes = dim == 2 ? 1e4 : 300.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n_boxes[d] = std::clamp((upper[d] - corner[d]) / edge, 1., most_boxes);
        size[d]    = (upper[d] - corner[d]) / n_boxes[d];
        n_all *= n_boxes[d];
      }
    start.assign(n_all + 1, 0);
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

  template <typename Function>
  void
  SimplexField::for_boxes_of(const Cell &cell, const Function &f) const
  {
    std::array<double, dim> low, high;
    for (unsigned int d = 0; d < dim; ++d)
      {
        low[d]  = std::numeric_limits<double>::max();
        high[d] = std::numeric_limits<double>::lowest();
        for (const unsigned int v : cell)
          {
            low[d]  = std::min(low[d], vertices[v][d]);
            high[d] = std::max(high[d], vertices[v][d]);
          }
        const double margin = rounding * (high[d] - low[d]);
        low[d] -= margin;
        high[d] += margin;
      }
    const Box first = box_at(low), last = box_at(high);
    Box       box = first;
    for (bool is_in = true; is_in;)
      {
        f(number_of(box));
        is_in = false;
        for (unsigned int d = 0; d < dim && !is_in; ++d)
          {
            is_in  = box[d] < last[d];
            box[d] = is_in ? box[d] + 1 : first[d];
          }
      }
  }

  SimplexField::Box
  SimplexField::box_at(const std::array<double, dim> &x) const
  {
    Box box;
    for (unsigned int d = 0; d < dim; ++d)
      box[d] = static_cast<unsigned int>(
        std::clamp((x[d] - corner[d]) / size[d], 0., n_boxes[d] - 1.));
    return box;
  }

  unsigned int
  SimplexField::number_of(const Box &box) const
  {
    unsigned int number = 0;
    for (unsigned int d = dim; d-- > 0;)
      number = number * n_boxes[d] + box[d];
    return number;
  }

  std::array<Tensor<1, dim>, dim + 1>
  SimplexField::gradients(const unsigned int cell) const
  {
    std::array<Point<dim>, n_corners> corners;
    for (unsigned int i = 0; i < n_corners; ++i)
      corners[i] = vertices[cells[cell][i]];
    return barycentric_gradients(corners);
  }

  std::optional<SimplexField::At>
  SimplexField::locate(const Point<dim> &x) const
  {
    std::array<double, dim> at_x;
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (!std::isfinite(x[d]))
          return std::nullopt;
        at_x[d] = x[d];
      }
    const unsigned int number  = number_of(box_at(at_x));
    double             nearest = -rounding;
    std::optional<At>  found;
    for (unsigned int k = start[number]; k < start[number + 1]; ++k)
      {
        At         at{in_box[k], {}};
        const auto g     = gradients(at.cell);
        double     least = std::numeric_limits<double>::max();
        for (unsigned int i = 0; i < n_corners; ++i)
          {
            // Zero on the opposite side.
            const Point<dim> &on =
              vertices[cells[at.cell][(i + 1) % n_corners]];
            at.barycentric[i] = g[i] * (x - on);
            least             = std::min(least, at.barycentric[i]);
          }
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
  SimplexField::value(const Point<dim> &x) const
  {
    double     sum = 0.;
    const auto at  = locate(x);
    if (shape.degree() == 1)
      for (unsigned int i = 0; i < n_corners && at; ++i)
        sum += at->barycentric[i] * at_node(at->cell, i);
    else
      for (unsigned int i = 0; i < shape.nodes().size() && at; ++i)
        sum += shape.value(i, at->barycentric) * at_node(at->cell, i);
    return sum;
  }

  Tensor<1, dim>
  SimplexField::gradient(const Point<dim> &x) const
  {
    Tensor<1, dim> sum;
    if (const auto at = locate(x))
      {
        const auto g = gradients(at->cell);
        if (shape.degree() == 1)
          for (unsigned int i = 0; i < n_corners; ++i)
            sum += at_node(at->cell, i) * g[i];
        else
          for (unsigned int i = 0; i < shape.nodes().size(); ++i)
            {
              const auto dN = shape.derivatives(i, at->barycentric);
              for (unsigned int d = 0; d < n_corners; ++d)
                sum += at_node(at->cell, i) * dN[d] * g[d];
            }
      }
    return sum;
  }
} // namespace geocone::GEOCONE_DIM
