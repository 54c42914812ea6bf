// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/scene/convex_hull.h>
#include <geocone/scene/geometry.h>

#include <algorithm>
#include <limits>

namespace geocone
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Twice the area of a triangle, > 0 where it goes round anticlockwise. */
    double
    area(const Point<dim> &a, const Point<dim> &b, const Point<dim> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
  } // namespace

  std::vector<Point<dim>>
  convex_hull(std::vector<Point<dim>> points)
  {
    const auto before = [](const Point<dim> &a, const Point<dim> &b) {
      return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
    };
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3)
      return points;
    std::vector<Point<dim>> hull;
    // Below from left to right, then above and back.
    for (unsigned int half = 0; half < 2; ++half)
      {
        const std::size_t first = hull.size();
        for (const Point<dim> &next : points)
          {
            while (hull.size() >= first + 2 &&
                   area(hull[hull.size() - 2], hull.back(), next) <= 0.)
              hull.pop_back();
            hull.push_back(next);
          }
        hull.pop_back(); // the other half begins with it
        std::reverse(points.begin(), points.end());
      }
    return hull;
  }

  Tensor<1, dim>
  way_between(const std::vector<Point<dim>> &from,
              const std::vector<Point<dim>> &to)
  {
    const std::vector<Point<dim>> a = convex_hull(from), b = convex_hull(to);
    Tensor<1, dim>                shortest;
    double     least = std::numeric_limits<double>::infinity();
    const auto look  = [&](const std::vector<Point<dim>> &corners,
                          const std::vector<Point<dim>> &edges,
                          const double                   sign) {
      for (const Point<dim> &x : corners)
        for (std::size_t i = 0; i < edges.size(); ++i)
          {
            const Tensor<1, dim> way =
              sign * (x - nearest_on_segment(
                            x, edges[i], edges[(i + 1) % edges.size()]));
            if (way.norm() < least)
              {
                least    = way.norm();
                shortest = way;
              }
          }
    };
    look(b, a, 1.);
    look(a, b, -1.);
    if (a.empty() || b.empty() || !(least > 0.))
      return {};
    // Between hulls that meet it is a way between their borders, which parts nothing.
    double end = -std::numeric_limits<double>::infinity(), begin = -end;
    for (const Point<dim> &x : a)
      end = std::max(end, shortest * x);
    for (const Point<dim> &x : b)
      begin = std::min(begin, shortest * x);
    return begin - end > 0.5 * least * least ? shortest / least
                                             : Tensor<1, dim>();
  }
} // namespace geocone
