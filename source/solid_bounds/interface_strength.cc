// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/solid_bounds/interface_strength.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Bound of the rounding errors of tractions and jumps. */
    constexpr double rounding = 1e-14;

    constexpr double infinite = std::numeric_limits<double>::infinity();
  } // namespace

  InterfaceStrength::InterfaceStrength(const InterfaceLaw &law,
                                       const double        unit)
    : friction(law.friction)
    , adhesion(law.adhesion / unit)
    , tension(law.never_opens() ? infinite : law.tension / unit)
  {}

  bool
  InterfaceStrength::is_closed() const
  {
    return friction == 0. && !std::isfinite(tension);
  }

  namespace
  {
    /** Normal traction at which a strength |r_t| <= c - mu r_n vanishes. */
    double
    apex(const double cohesion, const double friction)
    {
      return friction > 0. ? cohesion / friction : infinite;
    }
  } // namespace

  bool
  InterfaceStrength::is_cut() const
  {
    return !is_smooth() && tension < apex(adhesion, friction);
  }

  bool
  InterfaceStrength::is_weaker_than(const Soil &soil) const
  {
    return friction <= soil.friction && adhesion <= soil.cohesion &&
           std::min(tension, apex(adhesion, friction)) <=
             apex(soil.cohesion, soil.friction);
  }

  SpatialStrength::Flow
  InterfaceStrength::flow(const double               u_n,
                          const double               u_t,
                          const std::optional<Soil> &soil) const
  {
    std::vector<Soil> lines = {{adhesion, friction}};
    if (soil)
      lines.push_back(*soil);
    double least = infinite, end = tension; // slope of a line, normal traction
    for (const Soil &line : lines)
      {
        least = std::min(least, line.friction);
        end   = std::min(end, apex(line.cohesion, line.friction));
      }
    const auto power_at = [&](const double normal) {
      double shear = infinite;
      for (const Soil &line : lines)
        shear = std::min(shear, line.cohesion - line.friction * normal);
      return normal * u_n + std::max(shear, 0.) * u_t;
    };
    SpatialStrength::Flow flow;
    if (!std::isfinite(end))
      {
        flow.constrained = std::abs(u_n);
        flow.dissipation = power_at(0.);
        return flow;
      }
    flow.miss        = least * u_t - u_n + rounding * std::hypot(u_n, u_t);
    flow.dissipation = power_at(end);
    if (soil && soil->friction != friction)
      flow.dissipation = std::max(
        flow.dissipation,
        power_at(std::min(
          (adhesion - soil->cohesion) / (friction - soil->friction), end)));
    return flow;
  }

  void
  InterfaceStrength::check(const Tensor<1, dim> &traction,
                           const Tensor<1, dim> &normal,
                           const double          norm,
                           StressCheck          &check) const
  {
    const double r_n   = traction * normal,
                 r_t   = (traction - r_n * normal).norm();
    const auto compare = [&](const double demand, const double strength) {
      const double excess = demand + (norm > 0. ? rounding * norm : 0.);
      const double used   = strength > 0. ? excess / strength
                            : excess > 0. ? 1. + excess / norm
                                          : 0.;
      check.add(used, strength > 0. ? strength : norm, norm);
      // Without strength a part of the tractions is not nearer to its cone.
      check.is_dead = check.is_dead || (strength == 0. && used > 1.);
    };
    if (is_smooth())
      check.add_error(r_t);
    else
      compare(r_t + friction * r_n, adhesion);
    if (std::isfinite(tension))
      compare(r_n, tension);
  }

  namespace
  {
    /** @throws InputError for a motion that no load of the body measures */
    void
    check_motion(const Obstacle &obstacle)
    {
      const std::string remedy =
        "the bounded load is the reaction to one translation";
      for (unsigned int k = 0; k < n_motions; ++k)
        {
          const std::string name =
            k < dim ? std::string("Velocity ") + "xyz"[k]
                    : "Angular velocity " + axis_of_rotation(k - dim);
          if (obstacle.is_free(k))
            throw InputError(obstacle.parameter(name),
                             "free",
                             "a velocity where loads are bounded in three "
                             "dimensions",
                             remedy + ": push it, or let it rest beside "
                                      "another load");
          if (k >= dim && obstacle.velocity(0.)[k] != 0.)
            throw InputError(obstacle.parameter(name),
                             obstacle.velocity(0.)[k],
                             "0 where loads are bounded in three dimensions",
                             remedy);
        }
    }

    /** Points in a facet and on its edges, by which its contact is found. */
    struct PointsOfFacet
    {
      PointsOfFacet(const Tetrahedra &tetrahedra, const unsigned int facet)
      {
        constexpr unsigned int n = 6; // intervals of an edge
        const auto            &v = tetrahedra.facets[facet].vertices;
        for (unsigned int i = 0; i <= n; ++i)
          for (unsigned int j = 0; i + j <= n; ++j)
            {
              Point<dim>         x;
              const unsigned int parts[] = {i, j, n - i - j};
              for (unsigned int k = 0; k < 3; ++k)
                x += double(parts[k]) / n * tetrahedra.vertices[v[k]];
              all.push_back(x);
              is_inside.push_back(parts[0] * parts[1] * parts[2] > 0);
            }
        shown = all[all.size() / 2];
        // Next to the edges and corners, where contact in part begins.
        constexpr double near = 1e-3;
        for (unsigned int k = 0; k < 3; ++k)
          for (const double part :
               {near, 0.1, 0.3, 0.5, 0.7, 0.9, 1. - 2. * near})
            {
              const Tensor<1, dim> a(tetrahedra.vertices[v[k]]),
                b(tetrahedra.vertices[v[(k + 1) % 3]]),
                c(tetrahedra.vertices[v[(k + 2) % 3]]);
              all.push_back(
                Point<dim>((1. - near - part) * a + part * b + near * c));
              is_inside.push_back(true);
            }
      }

      std::vector<Point<dim>> all;
      std::vector<bool>       is_inside;
      Point<dim>              shown; ///< in messages
    };

    /** Returns whether an obstacle touches a facet. @throws InputError if in part */
    bool
    touches(const Obstacle      &obstacle,
            const Tetrahedra    &tetrahedra,
            const unsigned int   facet,
            const PointsOfFacet &points)
    {
      const double         tolerance = 1e-6 * std::sqrt(tetrahedra.area(facet));
      const Tensor<1, dim> into_body = -tetrahedra.normal(facet);
      const Point<dim>    &x         = points.shown;
      const std::string    where =
        format("the face at (%g, %g, %g)", x[0], x[1], x[2]);
      unsigned int n_touching = 0, n_inside = 0;
      for (unsigned int i = 0; i < points.all.size(); ++i)
        {
          const double distance =
            obstacle.nearest(points.all[i], {}, into_body).distance;
          if (distance < -tolerance)
            throw InputError(obstacle.parameter("Shape"),
                             obstacle.name,
                             "outside the body at the start",
                             where + " is in it: move it, or the body");
          n_touching += distance < tolerance;
          n_inside += distance < tolerance && points.is_inside[i];
        }
      if (n_touching < points.all.size() && n_inside > 0)
        throw InputError(obstacle.parameter("Shape"),
                         obstacle.name,
                         "a side that ends at edges of the mesh",
                         where + " touches it in part, but a bound needs the "
                                 "exact part; add the ends of that side to "
                                 "'Mesh/Grading points'");
      return n_touching == points.all.size();
    }
  } // namespace

  std::vector<int>
  obstacles_of_facets(const Scene &scene, const Tetrahedra &tetrahedra)
  {
    const auto       &list = scene.obstacles.list;
    std::vector<int>  all(tetrahedra.facets.size(), -1);
    std::vector<bool> touches_any(list.size(), false);
    for (const auto &obstacle : list)
      check_motion(*obstacle);
    for (unsigned int f = 0; f < all.size() && !list.empty(); ++f)
      if (tetrahedra.facets[f].cells[1] == Tetrahedra::none)
        {
          const PointsOfFacet points(tetrahedra, f);
          for (unsigned int o = 0; o < list.size(); ++o)
            if (touches(*list[o], tetrahedra, f, points))
              {
                if (all[f] >= 0)
                  throw InputError(list[o]->parameter("Shape"),
                                   list[o]->name,
                                   "one obstacle on a side of the body where "
                                   "loads are bounded",
                                   "it and '" + list[all[f]]->name +
                                     "' touch the same face: move one of them");
                all[f]         = o;
                touches_any[o] = true;
              }
        }
    for (unsigned int o = 0; o < list.size(); ++o)
      if (!touches_any[o])
        throw InputError(list[o]->parameter("Shape"),
                         list[o]->name,
                         "an obstacle that touches a face of the body with "
                         "'Analysis/Kind' other than steps",
                         "bounds are those of the body as it is: let them "
                         "touch along a flat side, or leave it out");
    return all;
  }
} // namespace geocone::GEOCONE_DIM
