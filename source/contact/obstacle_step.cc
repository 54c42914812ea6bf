// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/contact/obstacle_step.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  std::vector<ObstacleBody>
  bodies_of_step(const Scene                    &scene,
                 const std::vector<RigidMotion> &velocity,
                 const double                    driven_at,
                 const double                    loaded_at,
                 const double                    h)
  {
    const auto               &list = scene.obstacles.list;
    std::vector<ObstacleBody> bodies(list.size());
    for (unsigned int o = 0; o < list.size(); ++o)
      {
        const Obstacle &obstacle = *list[o];
        ObstacleBody   &body     = bodies[o];
        body.without_contact     = obstacle.velocity(driven_at);
        RigidMotion force        = obstacle.load(loaded_at);
        force.centre += obstacle.inertia(0) * scene.gravity.at(loaded_at);
        for (unsigned int k = 0; k < RigidMotion::n_components; ++k)
          if (obstacle.is_free(k))
            {
              body.is_free[k]    = true;
              body.inertia[k]    = obstacle.inertia(k) / h;
              body.velocity_n[k] = velocity[o][k];
              body.without_contact[k] =
                velocity[o][k] + force[k] / body.inertia[k];
            }
      }
    return bodies;
  }

  namespace
  {
    /** Diameter of the largest inscribed disc or ball, whose centre is found from that of
     *  the obstacle by steps that are halved: the depth is concave. */
    double
    thickness(const Obstacle &obstacle)
    {
      Point<dim> x     = obstacle.centre();
      const auto depth = [&](const Point<dim> &at) {
        return -obstacle.nearest(at, {}, {}).distance;
      };
      double deepest = depth(x);
      for (double step = std::abs(deepest); step > 1e-3 * std::abs(deepest);
           step /= 2.)
        for (bool again = true; again;)
          {
            again = false;
            for (const double sign : {-1., 1.})
              for (unsigned int d = 0; d < dim; ++d)
                {
                  Point<dim> other = x;
                  other[d] += sign * step;
                  if (const double own = depth(other); own > deepest)
                    {
                      x       = other;
                      deepest = own;
                      again   = true;
                    }
                }
          }
      return 2. * deepest;
    }
  } // namespace

  bool
  is_thinner(const Obstacle &obstacle, const double cell_size)
  {
    return std::isfinite(obstacle.width()) && // a half-space has no thickness
           thickness(obstacle) < (1. - 1e-6) * cell_size;
  }

  void
  refuse_thin(const Obstacle &obstacle, const double cell_size)
  {
    throw InputError("Obstacles/Names",
                     obstacle.name,
                     format("obstacles that are thicker than a cell, %.3g m; "
                            "this one has %.3g m",
                            cell_size,
                            thickness(obstacle)),
                     "make it thicker, or take smaller cells: no node would be "
                     "in it");
  }

  void
  check_start_of_free(const Obstacles &obstacles, const double margin)
  {
    const std::vector<RigidMotion> at_start(obstacles.list.size());
    if (const std::string overlap = obstacles.overlap_of_free(at_start, margin);
        !overlap.empty())
      throw InputError("Obstacles/Names",
                       obstacles.list.front()->name,
                       "free obstacles that do not overlap with others",
                       overlap + ": move it, or make one body of both");
  }

  void
  check_free(const Obstacles                &obstacles,
             const std::vector<RigidMotion> &moved,
             const double                    margin)
  {
    if (const std::string overlap = obstacles.overlap_of_free(moved, margin);
        !overlap.empty())
      throw StepFailure(overlap + "\n  remedy:  end the loading before they "
                                  "meet, or let the soil part them");
  }
} // namespace geocone::GEOCONE_DIM
