// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/shapes/edge_normal.h>
#include <geocone/shapes/obstacle_shape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Directions with a smaller difference are equal. */
    constexpr double same_direction = 1e-9;

    /** A unit vector normal to a unit vector. */
    dealii::Tensor<1, dim>
    some_normal_to(const dealii::Tensor<1, dim> &axis)
    {
      unsigned int least = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(axis[d]) < std::abs(axis[least]))
          least = d;
      dealii::Tensor<1, dim> across;
      across[least] = 1.;
      across -= (across * axis) * axis;
      return across / across.norm();
    }
  } // namespace

  HalfSpace::HalfSpace(const Point &place, const Vector &normal)
    : place(place)
    , normal(normal)
  {}

  ObstacleShape::Nearest
  HalfSpace::nearest(const Point &x, const Vector &, const Cover &) const
  {
    return {(x - place) * normal, normal};
  }

  double
  HalfSpace::width() const
  {
    return infinity;
  }

  double
  HalfSpace::extent(const Vector &n) const
  {
    return (n - normal).norm() < same_direction ? place * normal : infinity;
  }

  Ball::Ball(const Point &centre, const double radius)
    : middle(centre)
    , radius(radius)
  {}

  ObstacleShape::Nearest
  Ball::nearest(const Point &x, const Vector &, const Cover &) const
  {
    const Vector from = x - middle;
    const double r    = from.norm();
    return {r - radius, r > 0. ? from / r : Vector(Point::unit_vector(1))};
  }

  double
  Ball::extent(const Vector &n) const
  {
    return middle * n + radius;
  }

  Cylinder::Cylinder(const Point  &middle,
                     const Vector &axis,
                     const double  radius,
                     const double  height)
    : middle(middle)
    , axis(axis)
    , radius(radius)
    , half_height(height / 2.)
  {}

  ObstacleShape::Nearest
  Cylinder::nearest(const Point  &x,
                    const Vector &approach,
                    const Cover  &cover) const
  {
    const double along       = (x - middle) * axis;
    const Vector across      = (x - middle) - along * axis;
    const double r           = across.norm();
    const Vector radial      = r > 0. ? across / r : some_normal_to(axis),
                 end         = along < 0. ? -axis : axis;
    const double beyond_end  = std::abs(along) - half_height,
                 beyond_side = r - radius, tolerance = 1e-9 * width();
    if (beyond_end > tolerance && beyond_side > tolerance)
      {
        const Vector from = beyond_end * end + beyond_side * radial;
        return {from.norm(), from / from.norm(), true};
      }
    // The nearer of the uncovered parts of end and lateral surface.
    const auto is_bare = [&](const Vector &n, const Vector &to_foot) {
      const double inset =
        std::min(cover.margin, std::min(radius, half_height));
      return !cover.covers ||
             !cover.covers(Point(middle + to_foot + cover.margin * n -
                                 (n == end ? inset * radial : inset * end)));
    };
    const bool end_is_bare =
                 is_bare(end, half_height * end + std::min(r, radius) * radial),
               side_is_bare =
                 is_bare(radial,
                         radius * radial +
                           std::clamp(along, -half_height, half_height) * axis);
    if (!end_is_bare && !side_is_bare)
      return {infinity, end};
    bool at_end = beyond_end > beyond_side;
    if (std::abs(beyond_end - beyond_side) < tolerance)
      at_end = end * approach > radial * approach;
    if (end_is_bare && (at_end || !side_is_bare))
      return {beyond_end, end};
    return {beyond_side, radial};
  }

  double
  Cylinder::width() const
  {
    return 2. * std::hypot(radius, half_height);
  }

  double
  Cylinder::extent(const Vector &n) const
  {
    const double along = n * axis;
    return middle * n + std::abs(along) * half_height +
           radius * (n - along * axis).norm();
  }

  std::vector<ObstacleShape::Point>
  Cylinder::corners() const
  {
    std::vector<Point> places;
    if constexpr (dim == 3)
      {
        constexpr unsigned int n = 48;
        const Vector a = some_normal_to(axis), b = cross_product_3d(axis, a);
        for (unsigned int i = 0; i < n; ++i)
          for (const double side : {-1., 1.})
            places.emplace_back(middle + side * half_height * axis +
                                radius * (std::cos(2. * pi * i / n) * a +
                                          std::sin(2. * pi * i / n) * b));
      }
    return places;
  }

  Polytope::Polytope(const std::vector<Point> &vertices, bool &valid)
    : vertices(vertices)
  {
    valid = dim == 2 ? make_sides_of_polygon() : make_sides_of_polyhedron();
  }

  void
  Polytope::add_side(const std::vector<Point> &around, const Vector &normal)
  {
    Side side{normal, {}, {}};
    for (const Point &vertex : around)
      side.middle += vertex / double(around.size());
    if constexpr (dim == 2)
      {
        const Vector along =
          (around[1] - around[0]) / around[0].distance(around[1]);
        side.ends = {{around[0], around[0], -along},
                     {around[1], around[1], along}};
      }
    else
      for (std::size_t i = 0; i < around.size(); ++i)
        {
          const Point &a = around[i], &b = around[(i + 1) % around.size()];
          const Vector across = cross_product_3d(b - a, normal);
          side.ends.push_back({a, b, across / across.norm()});
        }
    sides.push_back(side);
  }

  bool
  Polytope::make_sides_of_polygon()
  {
    const std::size_t n = vertices.size();
    if (n < 3)
      return false;
    for (std::size_t i = 0; i < n; ++i)
      {
        const Point &a = vertices[i], &b = vertices[(i + 1) % n],
                    &c = vertices[(i + 2) % n];
        const Vector N = edge_normal(a, b);
        if (!(N * (c - b) < 0.))
          return false;
        add_side({a, b}, N / N.norm());
      }
    return true;
  }

  bool
  Polytope::make_sides_of_polyhedron()
  {
    if constexpr (dim == 3)
      {
        // The plane of any three vertices with all others on one side.
        const double                    tolerance = 1e-9 * width();
        const std::size_t               n         = vertices.size();
        std::set<std::set<std::size_t>> known;
        std::set<std::size_t>           used;
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = i + 1; j < n; ++j)
            for (std::size_t k = j + 1; k < n; ++k)
              {
                Vector N = cross_product_3d(vertices[j] - vertices[i],
                                            vertices[k] - vertices[i]);
                if (!(N.norm() > tolerance * width()))
                  continue;
                N /= N.norm();
                double                least = 0., most = 0.;
                std::set<std::size_t> in_plane;
                for (std::size_t l = 0; l < n; ++l)
                  {
                    const double above = (vertices[l] - vertices[i]) * N;
                    least              = std::min(least, above);
                    most               = std::max(most, above);
                    if (std::abs(above) <= tolerance)
                      in_plane.insert(l);
                  }
                if (std::min(most, -least) > tolerance ||
                    std::max(most, -least) <= tolerance ||
                    !known.insert(in_plane).second)
                  continue;
                if (most > tolerance)
                  N *= -1.;
                // Counterclockwise about the midpoint.
                std::vector<Point> around;
                Point              middle;
                for (const std::size_t l : in_plane)
                  {
                    around.push_back(vertices[l]);
                    middle += vertices[l] / double(in_plane.size());
                    used.insert(l);
                  }
                const Vector x = (around[0] - middle) /
                                 around[0].distance(middle),
                             y   = cross_product_3d(N, x);
                const auto angle = [&](const Point &p) {
                  return std::atan2((p - middle) * y, (p - middle) * x);
                };
                std::sort(around.begin(),
                          around.end(),
                          [&](const Point &a, const Point &b) {
                            return angle(a) < angle(b);
                          });
                add_side(around, N);
              }
        return sides.size() > 3 && used.size() == n;
      }
    return false;
  }

  ObstacleShape::Point
  Polytope::End::nearest(const Point &x) const
  {
    const Vector edge = b - a;
    if (edge.norm_square() == 0.)
      return a;
    return Point(a + std::clamp(((x - a) * edge) / edge.norm_square(), 0., 1.) *
                       edge);
  }

  ObstacleShape::Point
  Polytope::Side::nearest(const Point &x,
                          const double tolerance,
                          bool        &is_end) const
  {
    Point  foot(x - ((x - middle) * normal) * normal), best = foot;
    double least  = infinity;
    bool   inside = true;
    for (const End &end : ends)
      if (end.beyond(foot) > 0.)
        {
          inside          = false;
          const Point  at = end.nearest(foot);
          const double d  = at.distance(foot);
          if (d < least)
            {
              least = d;
              best  = at;
            }
        }
    is_end = !inside && least > tolerance;
    return best;
  }

  ObstacleShape::Point
  Polytope::Side::inset(const Point &p, const double by) const
  {
    Point at = p;
    for (const End &end : ends)
      if (const double past = end.beyond(at) + by; past > 0.)
        at -= past * end.outward;
    for (const End &end : ends)
      if (end.beyond(at) > -by / 2.) // the side is narrower
        return middle;
    return at;
  }

  double
  Polytope::Side::way_to_bare(const Point &from, const Cover &cover) const
  {
    double least = infinity;
    for (const End &end : ends)
      if (const Point at_end = end.nearest(from); !is_covered(at_end, cover))
        {
          Point covered = from, bare = at_end;
          while (bare.distance(covered) > cover.margin / 2.)
            {
              const Point middle_of(covered + (bare - covered) / 2.);
              (is_covered(middle_of, cover) ? covered : bare) = middle_of;
            }
          least = std::min(least, bare.distance(from));
        }
    return least;
  }

  ObstacleShape::Nearest
  Polytope::nearest(const Point  &x,
                    const Vector &approach,
                    const Cover  &cover) const
  {
    // Inside and on the boundary, the nearest side; outside, a side or an end.
    const double tolerance = 1e-9 * width();
    double       outmost   = -infinity;
    Nearest      best{-infinity, {}}, border{infinity, {}};
    for (const Side &side : sides)
      {
        double distance = (x - side.middle) * side.normal;
        outmost         = std::max(outmost, distance);
        bool        is_end;
        const Point foot = side.nearest(x, tolerance, is_end);
        if (cover.covers && side.is_covered(foot, cover))
          {
            // Deep inside, points are pushed out through the uncovered part of
            // the side.
            if (distance > -cover.margin)
              continue;
            distance = -std::hypot(distance, side.way_to_bare(foot, cover));
            if (std::isinf(distance))
              continue;
          }
        if (distance > best.distance + tolerance ||
            (distance > best.distance - tolerance &&
             side.normal * approach > best.normal * approach))
          best = {distance, side.normal};
        const Vector from = x - foot;
        if (from.norm() < border.distance)
          border = {from.norm(), from, is_end};
      }
    if (outmost > tolerance)
      {
        if (std::isfinite(border.distance))
          border.normal /= border.distance;
        return border;
      }
    if (std::isinf(best.distance))
      best.distance = infinity;
    return best;
  }

  ObstacleShape::Point
  Polytope::centre() const
  {
    Point mean;
    for (const Point &vertex : vertices)
      mean += vertex / double(vertices.size());
    return mean;
  }

  double
  Polytope::width() const
  {
    double widest = 0.;
    for (const Point &a : vertices)
      for (const Point &b : vertices)
        widest = std::max(widest, a.distance(b));
    return widest;
  }

  double
  Polytope::extent(const Vector &n) const
  {
    double most = -infinity;
    for (const Point &vertex : vertices)
      most = std::max(most, vertex * n);
    return most;
  }

  std::vector<ObstacleShape::Vector>
  Polytope::side_normals() const
  {
    std::vector<Vector> normals;
    for (const Side &side : sides)
      normals.push_back(side.normal);
    return normals;
  }

  std::vector<ObstacleShape::Vector>
  Polytope::edge_directions() const
  {
    std::vector<Vector> directions;
    if (dim == 3)
      for (const Side &side : sides)
        for (const End &end : side.ends)
          directions.push_back((end.b - end.a) / end.a.distance(end.b));
    return directions;
  }

  std::vector<ObstacleShape::Triangle>
  HalfSpace::triangles(const Point &body, const double size) const
  {
    const Point foot(body - ((body - place) * normal) * normal);
    Vector      a = size * some_normal_to(normal), b;
    if constexpr (dim == 3)
      b = dealii::cross_product_3d(normal, a);
    else
      b = -size / 20. * normal; // a strip behind the line
    const Point first(dim == 3 ? foot - b : foot), last(foot + b);
    return {{{Point(first - a), Point(first + a), Point(last + a)}},
            {{Point(first - a), Point(last + a), Point(last - a)}}};
  }

  std::vector<ObstacleShape::Triangle>
  Ball::triangles(const Point &, const double) const
  {
    constexpr unsigned int n     = dim == 2 ? 64 : 32; // around
    constexpr unsigned int rings = dim == 2 ? 1 : n / 2;
    // A point on the boundary; for a disc, ring 0 is its centre.
    const auto at = [&](const unsigned int i, const unsigned int ring) {
      const double angle = 2. * pi * (i % n) / n;
      Point        x     = middle;
      if constexpr (dim == 2)
        {
          x[0] += ring * radius * std::cos(angle);
          x[1] += ring * radius * std::sin(angle);
        }
      else
        {
          const double latitude = pi * ring / rings,
                       r        = radius * std::sin(latitude);
          x[0] += r * std::cos(angle);
          x[1] -= radius * std::cos(latitude);
          x[2] += r * std::sin(angle);
        }
      return x;
    };
    std::vector<Triangle> all;
    for (unsigned int ring = 0; ring < rings; ++ring)
      for (unsigned int i = 0; i < n; ++i)
        {
          all.push_back({{at(i, ring), at(i, ring + 1), at(i + 1, ring + 1)}});
          if (ring > 0)
            all.push_back(
              {{at(i, ring), at(i + 1, ring + 1), at(i + 1, ring)}});
        }
    return all;
  }

  std::vector<ObstacleShape::Triangle>
  Cylinder::triangles(const Point &, const double) const
  {
    std::vector<Triangle>    all;
    const std::vector<Point> rims = corners(); // of both ends in turn
    for (std::size_t i = 0; i < rims.size(); i += 2)
      {
        const Point &a = rims[i], &b = rims[i + 1],
                    &next_a = rims[(i + 2) % rims.size()],
                    &next_b = rims[(i + 3) % rims.size()];
        all.push_back({{Point(middle - half_height * axis), a, next_a}});
        all.push_back({{Point(middle + half_height * axis), b, next_b}});
        all.push_back({{a, next_a, next_b}});
        all.push_back({{a, next_b, b}});
      }
    return all;
  }

  std::vector<ObstacleShape::Triangle>
  Polytope::triangles(const Point &, const double) const
  {
    std::vector<Triangle> all;
    if constexpr (dim == 2)
      for (std::size_t i = 0; i < vertices.size(); ++i)
        all.push_back(
          {{centre(), vertices[i], vertices[(i + 1) % vertices.size()]}});
    else
      for (const Side &side : sides)
        for (const End &end : side.ends)
          all.push_back({{side.middle, end.a, end.b}});
    return all;
  }
} // namespace geocone::GEOCONE_DIM
