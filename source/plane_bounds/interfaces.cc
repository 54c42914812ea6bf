// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/plane_bounds/interfaces.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    std::vector<Interface::Face>
    faces_of(const Obstacle &obstacle)
    {
      const double mu = obstacle.law.friction, c = obstacle.law.adhesion,
                   t = obstacle.law.tension;
      if (mu == 0. && obstacle.law.never_opens())
        return {{0., c > 0. ? c : 1., true, c > 0.}};
      std::vector<Interface::Face> faces;
      if (mu > 0. || c > 0.)
        faces.push_back({mu, c, mu > 0., true});
      if (mu == 0. || mu * t < c) // otherwise implied by the apex of the cone
        faces.push_back({1., t, true, false});
      return faces;
    }

    /** Distances of both ends of an edge and of places in it from an obstacle. Obstacles are
     *  convex, so that they touch a part of the edge that has an end in it, or is inside. */
    std::vector<double>
    distances(const Obstacle       &obstacle,
              const Point<dim>     &a,
              const Point<dim>     &b,
              const Tensor<1, dim> &into_body)
    {
      const auto from = [&](const Point<dim> &x) {
        return obstacle.nearest(x, {}, into_body).distance;
      };
      std::vector<double> all = {from(a), from(b)};
      for (const double part : {1e-3,
                                0.02,
                                0.1,
                                0.2,
                                0.3,
                                0.4,
                                0.5,
                                0.6,
                                0.7,
                                0.8,
                                0.9,
                                0.98,
                                0.999})
        all.push_back(from(Point<dim>(a + part * (b - a))));
      return all;
    }
  } // namespace

  bool
  is_along_axis(const Tensor<1, dim> &normal)
  {
    return std::min(std::abs(normal[0]), std::abs(normal[1])) < 1e-9;
  }

  std::vector<Interface>
  interfaces(const Scene &scene, const Triangles &triangles)
  {
    std::vector<Interface> all;
    const auto normal_into_body = [&](const Triangles::HeldEdge &held) {
      const Tensor<1, dim> g =
        triangles.gradients(held.cell)[held.opposite_vertex];
      return g / g.norm();
    };
    for (const auto &condition : scene.dirichlet.list)
      if (condition->normal)
        for (const auto &held : triangles.held_edges(*condition))
          if (const auto n = normal_into_body(held); !is_along_axis(n))
            all.push_back({held, n, -1, {{0., 1., true, false}}});

    for (unsigned int o = 0; o < scene.obstacles.list.size(); ++o)
      {
        const Obstacle &obstacle = *scene.obstacles.list[o];
        bool            touches  = false;
        for (const auto &held : triangles.outer_edges())
          {
            const auto       &ends = triangles.edges[held.edge].vertices;
            const Point<dim> &a    = triangles.vertices[ends[0]],
                             &b    = triangles.vertices[ends[1]];
            const double         tolerance = 1e-6 * a.distance(b);
            const Tensor<1, dim> normal    = normal_into_body(held);
            const auto           found     = distances(obstacle, a, b, normal);
            const std::string    where     = format(
              "the edge from (%g, %g) to (%g, %g)", a[0], a[1], b[0], b[1]);
            if (*std::min_element(found.begin(), found.end()) < -tolerance)
              throw InputError(obstacle.parameter("Shape"),
                               obstacle.name,
                               "outside the body at the start",
                               where + " is in it: move it, or the body");
            const auto n_touching = [&](const unsigned int first,
                                        const unsigned int end) {
              return std::count_if(
                found.begin() + first,
                found.begin() + end,
                [&](const double d) { return d < tolerance; });
            };
            const unsigned int n = found.size(), n_ends = n_touching(0, 2),
                               n_inside = n_touching(2, n);
            if (n_ends + n_inside == n)
              {
                all.push_back({held, normal, int(o), faces_of(obstacle)});
                touches = true;
              }
            else if (n_inside > 0 || n_ends == 2)
              throw InputError(
                obstacle.parameter("Shape"),
                obstacle.name,
                "a side that ends at vertices of the mesh",
                where +
                  " touches it in part, but a bound needs the exact part; "
                  "add the ends of that side to 'Mesh/Grading points'");
          }
        if (!touches)
          throw InputError(obstacle.parameter("Shape"),
                           obstacle.name,
                           "an obstacle that touches an edge of the body with "
                           "'Analysis/Kind' other than steps",
                           "bounds are those of the body as it is: let them "
                           "touch along a straight side, or leave it out");
      }
    return all;
  }
} // namespace geocone::GEOCONE_DIM
