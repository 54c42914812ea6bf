// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_bounds.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/limit_analysis/fans_of_jumps.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    constexpr double pi = dealii::numbers::PI;

    /** End of a boundary edge at a vertex. */
    struct EndAtVertex
    {
      double direction; ///< angle of the edge away from the vertex
      bool   is_held;   ///< by a prescribed velocity, or beside an obstacle
      Tensor<1, dim> normal; ///< outwards
      Tensor<1, dim> traction;

      double
      pressure() const
      {
        return -(traction * normal);
      }
      double
      shear() const
      {
        return normal[0] * traction[1] - normal[1] * traction[0];
      }
    };

    /** Vertex of the outline: the body lies to the left of the edge `after` and to the
     *  right of `before`, both seen from the vertex. */
    struct OutlineVertex
    {
      EndAtVertex after, before;

      /** The interior angle. */
      double
      angle() const
      {
        const double turn = before.direction - after.direction;
        return turn > 0. ? turn : turn + 2. * pi;
      }
    };

    /** Boundary condition at an end of an edge of the outline. */
    struct EndCondition
    {
      bool           is_held = false;
      Tensor<1, dim> traction; ///< scaled units
    };

    /** Returns the function of an outer edge and its end that yields the condition there. */
    std::function<EndCondition(unsigned int, unsigned int)>
    conditions_of(const BoundScene &bound, const double load)
    {
      if (bound.is_axisymmetric())
        return [body = AxisymmetricScene(bound), load](const unsigned int edge,
                                                       const unsigned int end) {
          const AxisymmetricScene::Edge &of = body.edges[edge];
          // Stresses do not turn at the axis.
          return EndCondition{
            of.is_on_axis() || of.condition.holds(0) || of.condition.holds(1),
            of.traction[end].dead + load * of.traction[end].live};
        };
      return [problem = lower_problem(bound), &bound, load](
               const unsigned int edge, const unsigned int end) {
        const Triangles &triangles = bound.triangles;
        const double     half =
          triangles.edge_length(edge) / (2. * bound.units.length);
        const unsigned int first =
          dim * (triangles.cells.size() + 2 * edge + end);
        EndCondition condition;
        for (unsigned int d = 0; d < dim; ++d)
          {
            condition.is_held =
              condition.is_held || (problem.is_prescribed[first + d] &&
                                    !problem.has_no_force[first + d]);
            condition.traction[d] =
              (problem.dead[first + d] + load * problem.live[first + d]) / half;
          }
        return condition;
      };
    }

    /** Returns the strength at a vertex of a triangle as that of plane strain. */
    PointCone
    plane_cone(const BoundScene  &bound,
               const unsigned int cell,
               const unsigned int i)
    {
      const Triangles &triangles = bound.triangles;
      if (!bound.is_axisymmetric())
        return bound.cone_at(BoundSide::lower, cell, i);
      const Point<dim>      &x   = triangles.vertices[triangles.cells[cell][i]];
      const SpatialStrength &one = bound.strengths[triangles.material[cell]];
      const double           mu  = one.face_friction(),
                   cos_phi       = 1. / std::sqrt(1. + mu * mu);
      return {mu * cos_phi,
              sqrt2 * cos_phi * one.face_cohesion_per_k() * one.k_at(x)};
    }

    class LoadedOutline
    {
    public:
      LoadedOutline(const BoundScene &bound, const double load)
        : bound(bound)
        , triangles(bound.triangles)
        , borders(triangles.edges_between_materials())
      {
        const auto             condition = conditions_of(bound, load);
        std::set<unsigned int> slides;
        for (const Interface &interface : bound.interfaces)
          slides.insert(interface.held.edge);
        lines = borders;
        for (const PlasticBars::BarEdge &bar : bound.bars.edges)
          {
            // A structure on the outline carries tractions as an obstacle does; others
            // turn the stresses at its ends.
            slides.insert(bar.edge);
            lines.push_back(triangles.edges[bar.edge].vertices);
            borders.push_back(triangles.edges[bar.edge].vertices);
          }
        std::map<unsigned int, std::vector<EndAtVertex>> ends;
        for (const auto &outer : triangles.outer_edges())
          {
            const auto  &two = triangles.edges[outer.edge].vertices;
            lines.push_back(two);
            const Tensor<1, dim> g =
              triangles.gradients(outer.cell)[outer.opposite_vertex];
            for (unsigned int end = 0; end < 2; ++end)
              {
                const Tensor<1, dim> along = triangles.vertices[two[1 - end]] -
                                             triangles.vertices[two[end]];
                const EndCondition here = condition(outer.edge, end);
                const EndAtVertex  one  = {std::atan2(along[1], along[0]),
                                           here.is_held ||
                                             slides.count(outer.edge) > 0,
                                           -1. * g / g.norm(),
                                           here.traction};
                largest = std::max(largest, one.traction.norm());
                ends[two[end]].push_back(one);
              }
          }
        for (const auto &[vertex, two] : ends)
          if (two.size() == 2) // parts that touch in a point have more
            {
              // The body is to the left of the edge whose normal is to its right.
              const Tensor<1, dim> &n = two[0].normal;
              const bool is_before    = n[0] * std::sin(two[0].direction) -
                                       n[1] * std::cos(two[0].direction) <
                                     0.;
              vertices[vertex] = {two[is_before ? 1 : 0],
                                  two[is_before ? 0 : 1]};
            }
      }

      std::vector<Fan>
      fans(const double tolerance) const
      {
        std::vector<Fan> all;
        for (const auto &[v, vertex] : vertices)
          if (jumps(vertex))
            if (Fan fan = fan_at(v, vertex, tolerance); fan.rays.size() > 2)
              all.push_back(fan);
        return all;
      }

    private:
      /** Jump of the tractions at a vertex, which no continuous stress has; 0 where a side
       *  is held, or too narrow for stresses to turn. */
      static double
      jump(const OutlineVertex &vertex)
      {
        const auto &a = vertex.after, &b = vertex.before;
        if (a.is_held || b.is_held || vertex.angle() < pi / 1.8)
          return 0.;
        return std::max(
          {std::abs(a.pressure() - b.pressure()),
           std::abs(a.shear() - b.shear()),
           std::abs(a.traction * b.normal - b.traction * a.normal)});
      }

      bool
      jumps(const OutlineVertex &vertex) const
      {
        return jump(vertex) > 1e-6 * largest;
      }

      /** Whether conditions change at a vertex, or the outline turns. */
      bool
      is_feature(const OutlineVertex &vertex) const
      {
        return std::abs(vertex.angle() - pi) > 1e-3 ||
               vertex.after.is_held != vertex.before.is_held || jumps(vertex);
      }

      /** Distance to the nearest feature of the body that is not at the vertex. */
      double
      reach(const unsigned int v) const
      {
        const Point<dim> &x     = triangles.vertices[v];
        double            least = std::numeric_limits<double>::max();
        for (const auto &[other, vertex] : vertices)
          if (other != v && is_feature(vertex))
            least = std::min(least, x.distance(triangles.vertices[other]));
        // Lines that do not end in the vertex or point to it.
        const auto take = [&](const std::array<unsigned int, 2> &edge) {
          const Point<dim> &a    = triangles.vertices[edge[0]],
                           &b    = triangles.vertices[edge[1]];
          const Tensor<1, dim> t = b - a, to = x - a;
          if (std::abs(t[0] * to[1] - t[1] * to[0]) >
              1e-6 * t.norm() * std::max(to.norm(), t.norm()))
            least = std::min(least, distance_to_segment(x, a, b));
        };
        for (const auto &edge : lines)
          take(edge);
        return least;
      }

      /** The pressure that a continuous turn of stresses carries beside a smaller one.
       *  @param k c cos(phi) */
      static double
      greatest_pressure(const double smaller,
                        const double turn,
                        const double a,
                        const double k)
      {
        if (a < 1e-6)
          return smaller + 2. * k * (1. + turn);
        return (smaller + k / a) * (1. + a) / (1. - a) *
                 std::exp(2. * turn * std::tan(std::asin(a))) -
               k / a;
      }

      Fan
      fan_at(const unsigned int   v,
             const OutlineVertex &vertex,
             const double         tolerance) const
      {
        Fan fan;
        fan.apex         = triangles.vertices[v];
        fan.radius       = 0.3 * reach(v);
        fan.inner_radius = fan.radius / 16.;
        // The weakest soil of the triangles there.
        double                 a = 1., k = std::numeric_limits<double>::max();
        std::set<unsigned int> materials;
        for (unsigned int c = 0; c < triangles.cells.size(); ++c)
          for (unsigned int i = 0; i < 3; ++i)
            if (triangles.cells[c][i] == v)
              {
                const PointCone cone = plane_cone(bound, c, i);
                a = std::min(a, cone.a);
                k                    = std::min(k,
                             cone.k * std::min(cone.ellipse.compression,
                                               cone.ellipse.shear));
                materials.insert(triangles.material[c]);
              }
        const double after   = vertex.after.pressure(),
                     before  = vertex.before.pressure(),
                     smaller = std::min(after, before);
        const bool is_sheared =
          std::abs(vertex.after.shear()) + std::abs(vertex.before.shear()) >
          1e-6 * largest;
        const bool   turns_all = is_sheared || materials.size() > 1 || k <= 0.;
        const double angle = vertex.angle(), turn = angle - pi / 2.;
        // Few triangles carry a small part of what a continuous turn does, as the jump at a
        // bend of a loaded side.
        const double greatest = greatest_pressure(smaller, turn, a, k / sqrt2);
        if (jump(vertex) < 0.4 * (greatest - smaller))
          return fan;
        const double used = std::max(after, before) / greatest;
        const double wanted =
          turns_all ? 1. - tolerance : std::min(1.2 * used, 1. - tolerance);
        unsigned int n = std::max(3., std::ceil(turn / (pi / 6.)));
        while (n < most_rays && part_carried(n, turn, a) < wanted)
          ++n;

        // From the side with the greater pressure.
        std::vector<double> from_side = {0.};
        const double        delta     = turn / n;
        if (turns_all)
          {
            const unsigned int parts =
              std::min<unsigned int>(std::ceil(angle / delta), 2 * most_rays);
            for (unsigned int i = 1; i < parts; ++i)
              from_side.push_back(i * angle / parts);
          }
        else
          {
            const double rho   = std::asin(a * std::cos(delta));
            const double first = pi / 4. + rho / 2. + delta / 2.,
                         last  = first + (n - 1) * delta;
            add_growing(from_side, first, 0., delta);
            for (unsigned int i = 0; i < n; ++i)
              from_side.push_back(first + i * delta);
            add_growing(from_side, last, angle, delta);
          }
        from_side.push_back(angle);
        std::sort(from_side.begin(), from_side.end());
        for (const double ray : from_side)
          fan.rays.push_back(after >= before
                               ? vertex.after.direction + ray
                               : vertex.after.direction + angle - ray);
        std::sort(fan.rays.begin(), fan.rays.end());
        take_borders(v, fan);
        return fan;
      }

      /** Adds rays from one of the turn towards a side, at growing angles. */
      static void
      add_growing(std::vector<double> &rays,
                  const double         from,
                  const double         side,
                  const double         delta)
      {
        constexpr double ratio = 1.6, widest = pi / 6.;
        const double     sign = side > from ? 1. : -1.;
        double step = std::min(ratio * delta, widest), ray = from + sign * step;
        while (sign * (side - ray) > 0.5 * step)
          {
            rays.push_back(ray);
            step = std::min(ratio * step, widest);
            ray += sign * step;
          }
      }

      /** Adds rays along borders of materials, in place of those that are near. */
      void
      take_borders(const unsigned int v, Fan &fan) const
      {
        const std::vector<double> rays = fan.rays;
        std::vector<bool>         is_near(rays.size(), false);
        std::vector<double>       added;
        for (const auto &edge : borders)
          for (unsigned int end = 0; end < 2; ++end)
            if (edge[end] == v)
              {
                const Tensor<1, dim> t =
                  triangles.vertices[edge[1 - end]] - fan.apex;
                double ray = std::atan2(t[1], t[0]);
                while (ray < rays.front())
                  ray += 2. * pi;
                const unsigned int i =
                  std::upper_bound(rays.begin(), rays.end(), ray) -
                  rays.begin();
                if (i == 0 || i == rays.size())
                  continue;
                added.push_back(ray);
                const double width = rays[i] - rays[i - 1];
                if (ray - rays[i - 1] < width / 3.)
                  is_near[i - 1] = true;
                else if (rays[i] - ray < width / 3.)
                  is_near[i] = true;
              }
        is_near.front() = is_near.back() = false; // the outline
        fan.rays                         = added;
        for (std::size_t i = 0; i < rays.size(); ++i)
          if (!is_near[i])
            fan.rays.push_back(rays[i]);
        std::sort(fan.rays.begin(), fan.rays.end());
      }

      static constexpr unsigned int most_rays = 48;

      const BoundScene                     &bound;
      const Triangles                      &triangles;
      double                                largest = 0.; ///< traction
      std::map<unsigned int, OutlineVertex> vertices;

      std::vector<std::array<unsigned int, 2>>
        borders, ///< edges between materials
        lines;   ///< these and the outline
    };
  } // namespace

  double
  part_carried(const unsigned int n, const double turn, const double sin_phi)
  {
    const double delta = turn / n;
    if (sin_phi < 1e-6)
      return (1. + n * std::sin(delta)) / (1. + turn);
    const double rho    = std::asin(sin_phi * std::cos(delta)),
                 K      = (1. + sin_phi) / (1. - sin_phi),
                 growth = std::cos(delta - rho) / std::cos(delta + rho),
                 exact  = std::exp(2. * turn * std::tan(std::asin(sin_phi)));
    return (K * std::pow(growth, n) - 1.) / (K * exact - 1.);
  }

  std::vector<Fan>
  fans_of_jumps(const BoundScene &bound,
                const double      load,
                const double      tolerance)
  {
    return LoadedOutline(bound, load).fans(tolerance);
  }
} // namespace geocone::GEOCONE_DIM
