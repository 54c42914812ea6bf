// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, soil would enter obstacles, or be held off them. Balls, cylinders and
// polyhedra in any position: whether a place is inside, its distance from the boundary and
// the normal there are compared with what shapes are by definition, by searching along the
// directions in which they reach (the distance of a convex body is the largest over all unit
// vectors n of n.x - max n.y); the gradient of the distance is the normal.

#include <geocone/shapes/obstacle_shape.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace three_obstacle_shape_01
{
  using namespace geocone;
  using Point  = ObstacleShape::Point;
  using Vector = ObstacleShape::Vector;

  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> uniform(-1., 1.);

  Vector
  random_vector(const double size)
  {
    return size *
           Vector({uniform(generator), uniform(generator), uniform(generator)});
  }

  Vector
  random_direction()
  {
    for (;;)
      if (const Vector v = random_vector(1.); v.norm() < 1. && v.norm() > 0.1)
        return v / v.norm();
  }

  /** The largest n.x - extent(n), from the best ones of some directions by smaller and smaller
   *  changes. */
  double
  searched_distance(const ObstacleShape &shape, const Point &x)
  {
    const auto beyond = [&](const Vector &n) {
      return x * n - shape.extent(n);
    };
    std::vector<Vector> starts = shape.side_normals();
    for (unsigned int i = 0; i < 500; ++i)
      starts.push_back(random_direction());
    std::sort(
      starts.begin(), starts.end(), [&](const Vector &a, const Vector &b) {
        return beyond(a) > beyond(b);
      });
    double most = -1e300;
    for (unsigned int s = 0; s < 5; ++s)
      {
        Vector best = starts[s];
        double own  = beyond(best);
        for (double size = 0.2; size > 1e-8; size *= 0.7)
          for (unsigned int i = 0; i < 15; ++i)
            {
              Vector n = best + random_vector(size);
              n /= n.norm();
              if (const double distance = beyond(n); distance > own)
                {
                  own  = distance;
                  best = n;
                }
            }
        most = std::max(most, own);
      }
    return most;
  }

  void
  test()
  {
    unsigned int n_inside = 0, n_outside = 0, n_edges = 0;
    double       worst = 0., worst_slope = 0.;
    for (unsigned int trial = 0; trial < 60; ++trial)
      {
        std::unique_ptr<ObstacleShape> shape;
        const Point                    centre(random_vector(1.));
        if (trial % 3 == 0)
          shape = std::make_unique<Ball>(centre, 0.7);
        else if (trial % 3 == 1)
          shape =
            std::make_unique<Cylinder>(centre, random_direction(), 0.6, 0.9);
        else
          {
            // A block, turned, and a wedge.
            const Vector a = random_direction(), c0 = random_direction();
            Vector       b = cross_product_3d(a, c0);
            b /= b.norm();
            const Vector       c = cross_product_3d(a, b);
            std::vector<Point> vertices;
            for (const double i : {-0.5, 0.5})
              for (const double j : {-0.7, 0.7})
                {
                  vertices.push_back(Point(centre + i * a + j * b));
                  if (trial % 2 == 0 || j > 0.)
                    vertices.push_back(Point(centre + i * a + j * b + 0.8 * c));
                }
            bool valid;
            shape = std::make_unique<Polytope>(vertices, valid);
            if (!valid)
              std::cout << "a convex body is refused" << std::endl;
          }
        for (unsigned int k = 0; k < 20; ++k)
          {
            const Point  x(centre + random_vector(1.4));
            const auto   at       = shape->nearest(x, {}, {});
            const double searched = searched_distance(*shape, x);
            (at.distance < 0. ? n_inside : n_outside) += 1;
            n_edges += at.is_edge;
            // No direction parts them farther, and the normal does just that.
            const double along = x * at.normal - shape->extent(at.normal);
            worst              = std::max(
              {worst, searched - at.distance, std::abs(along - at.distance)});
            // Along the normal the distance grows at one, across it not at all.
            constexpr double h = 1e-6;
            for (const Vector &way : {at.normal, random_direction()})
              {
                const double slope =
                  (shape->nearest(Point(x + h * way), {}, {}).distance -
                   shape->nearest(Point(x - h * way), {}, {}).distance) /
                  (2. * h);
                worst_slope =
                  std::max(worst_slope, std::abs(slope - way * at.normal));
              }
          }
      }
    std::cout << "inside, outside, at edges: "
              << (std::min({n_inside, n_outside, n_edges}) > 50
                    ? "over 50 each"
                    : "too few: " + std::to_string(n_inside) + " " +
                        std::to_string(n_outside) + " " +
                        std::to_string(n_edges))
              << std::endl;
    std::cout << "distances agree to 1e-12: " << (worst < 1e-12 ? "yes" : "no")
              << std::endl;
    std::cout << "normals are their slopes, to 1e-4: "
              << (worst_slope < 1e-4 ? "yes" : "no") << std::endl;
    if (worst >= 1e-12 || worst_slope >= 1e-4)
      std::cout << worst << " " << worst_slope << std::endl;

    bool                     valid;
    const std::vector<Point> flat   = {Point(0., 0., 0.),
                                       Point(1., 0., 0.),
                                       Point(0., 1., 0.),
                                       Point(1., 1., 0.)};
    std::vector<Point>       inside = {Point(0., 0., 0.),
                                       Point(1., 0., 0.),
                                       Point(0., 1., 0.),
                                       Point(0., 0., 1.),
                                       Point(0.2, 0.2, 0.2)};
    Polytope(flat, valid);
    std::cout << "flat: " << (valid ? "taken" : "refused") << std::endl;
    Polytope(inside, valid);
    std::cout << "a vertex inside: " << (valid ? "taken" : "refused")
              << std::endl;
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace three_obstacle_shape_01
