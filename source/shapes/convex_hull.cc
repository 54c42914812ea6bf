// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/shapes/convex_hull.h>

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Twice the area of a triangle, positive if counterclockwise. */
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
    // Lower hull from left to right, then upper hull and back.
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

  namespace
  {
    /** Differences of points of two sets, at most dim + 1. */
    using Simplex = std::vector<Tensor<1, dim>>;

    /** Removes the corners that are not needed for the point of a simplex
     *  nearest to the origin. @return that point */
    Tensor<1, dim>
    reduce(Simplex &simplex)
    {
      Tensor<1, dim> nearest;
      Simplex        needed;
      double         least = std::numeric_limits<double>::infinity();
      for (unsigned int subset = 1; subset < 1u << simplex.size(); ++subset)
        {
          Simplex corners;
          for (unsigned int i = 0; i < simplex.size(); ++i)
            if (subset & (1u << i))
              corners.push_back(simplex[i]);
          // Minimum of |p_0 + sum_i t_i (p_i - p_0)|.
          const unsigned int                          n = corners.size() - 1;
          Eigen::Matrix<double, dim, -1, 0, dim, dim> edges(dim, n);
          Eigen::Matrix<double, dim, 1>               start;
          for (unsigned int d = 0; d < dim; ++d)
            {
              start[d] = corners[0][d];
              for (unsigned int i = 0; i < n; ++i)
                edges(d, i) = corners[i + 1][d] - corners[0][d];
            }
          Eigen::Matrix<double, -1, 1, 0, dim, 1> t(n);
          if (n > 0)
            {
              const auto factors = edges.colPivHouseholderQr();
              if (factors.rank() < n)
                continue;
              t = factors.solve(-start);
            }
          if (n > 0 && (t.minCoeff() < 0. || t.sum() > 1.))
            continue; // beyond a face, another subset
          const Eigen::Matrix<double, dim, 1> point = start + edges * t;
          if (point.norm() < least)
            {
              least  = point.norm();
              needed = corners;
              for (unsigned int d = 0; d < dim; ++d)
                nearest[d] = point[d];
            }
        }
      simplex = needed;
      return nearest;
    }

    /** Farthest point of a set in a direction. */
    const Point<dim> &
    farthest(const std::vector<Point<dim>> &points, const Tensor<1, dim> &along)
    {
      return *std::max_element(points.begin(),
                               points.end(),
                               [&](const Point<dim> &a, const Point<dim> &b) {
                                 return a * along < b * along;
                               });
    }
  } // namespace

  Tensor<1, dim>
  way_between(const std::vector<Point<dim>> &from,
              const std::vector<Point<dim>> &to)
  {
    if (from.empty() || to.empty())
      return {};
    constexpr double       rounding = 1e-12;
    constexpr unsigned int most     = 100;
    Tensor<1, dim>         way      = to[0] - from[0];
    Simplex                simplex  = {way};
    double                 size     = 0.; // of the vectors subtracted
    for (const auto *points : {&from, &to})
      for (const Point<dim> &x : *points)
        size = std::max(size, x.distance(from[0]));
    for (unsigned int step = 0; step < most && way.norm() > rounding * size;
         ++step)
      {
        const Tensor<1, dim> next = farthest(to, -way) - farthest(from, way);
        // No difference is nearer to the origin along the way.
        if (way * (way - next) <= rounding * (way * way))
          return way / way.norm();
        simplex.push_back(next);
        const Tensor<1, dim> before = way;
        way                         = reduce(simplex);
        if (way.norm() >= before.norm())
          return before / before.norm();
      }
    return way.norm() > rounding * size ? way / way.norm() : Tensor<1, dim>();
  }
} // namespace geocone::GEOCONE_DIM
