// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/geometry/soil_columns.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    Point<dim>
    in_plane(const double x, const double y)
    {
      Point<dim> p;
      p[0] = x;
      p[1] = y;
      return p;
    }

    /** Removes values that differ by less than a tolerance from the one
     *  before. */
    void
    sort_distinct(std::vector<double> &values, const double tolerance)
    {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(),
                               values.end(),
                               [&](const double a, const double b) {
                                 return b - a < tolerance;
                               }),
                   values.end());
    }

    /** Smallest difference of stresses and of their gradients, relative to the
     *  largest ones, that is not rounding. */
    constexpr double least_jump = 1e-7;
  } // namespace

  SoilColumns::SoilColumns(const Geometry            &geometry,
                           const Regions             &regions,
                           const std::vector<double> &unit_weights,
                           const std::string         &parameter,
                           const double               value,
                           const std::string         &remedy)
    : unit_weights(unit_weights)
    , parameter(parameter)
    , remedy(remedy)
    , value(value)
  {
    using Shape = Geometry::Shape;
    if ((geometry.shape != Shape::box && geometry.shape != Shape::polygon) ||
        geometry.is_part_by_formula())
      refuse("0 with a body " +
             (geometry.is_part_by_formula()
                ? std::string("restricted by 'Geometry/Where'")
                : "of 'Geometry/Shape' = " + geometry.shape.word()) +
             ": its ground surface is not known as a polygon");
    rounding = geometry.rounding();
    if (dim == 3)
      {
        add_layers_of_box(geometry, regions);
        return;
      }

    std::vector<Segment> segments;
    const auto           add = [&](const Polygon &loop, const bool is_of_body) {
      for (std::size_t i = 0; i < loop.size(); ++i)
        {
          const Point<dim> &a = loop[i], &b = loop[(i + 1) % loop.size()];
          segments.push_back(
            {a[0] < b[0] ? a : b, a[0] < b[0] ? b : a, is_of_body});
        }
    };
    for (const Polygon &loop : geometry.loops())
      add(loop, true);
    for (const Polygon &region : regions.polygons())
      add(region, false);

    const auto [low, high] = geometry.bounding_box();
    std::vector<double> x;
    for (std::size_t i = 0; i < segments.size(); ++i)
      {
        const Point<dim>    &a = segments[i].left, &c = segments[i].right;
        const Tensor<1, dim> u = c - a;
        x.insert(x.end(), {a[0], c[0]});
        for (std::size_t k = 0; k < i; ++k)
          {
            const Tensor<1, dim> v = segments[k].right - segments[k].left,
                                 w = segments[k].left - a;
            const double turn      = u[0] * v[1] - u[1] * v[0];
            if (std::abs(turn) < 1e-12 * u.norm() * v.norm())
              continue;
            const double s = (w[0] * v[1] - w[1] * v[0]) / turn,
                         t = (w[0] * u[1] - w[1] * u[0]) / turn;
            if (s > 0. && s < 1. && t > 0. && t < 1.)
              x.push_back(a[0] + s * u[0]);
          }
      }
    x.erase(std::remove_if(
              x.begin(),
              x.end(),
              [&](const double at) { return at < low[0] || at > high[0]; }),
            x.end());
    sort_distinct(x, rounding);
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      add_strip(x[i], x[i + 1], segments, regions);
    check_continuity();
  }

  void
  SoilColumns::add_strip(const double                left,
                         const double                right,
                         const std::vector<Segment> &segments,
                         const Regions              &regions)
  {
    struct Side
    {
      Linear y;
      bool   is_of_body;
    };
    const double      middle = (left + right) / 2.;
    std::vector<Side> sides;
    for (const Segment &one : segments)
      if (one.left[0] < middle && one.right[0] > middle)
        {
          const auto y = [&](const double x) {
            return one.left[1] + (x - one.left[0]) /
                                   (one.right[0] - one.left[0]) *
                                   (one.right[1] - one.left[1]);
          };
          sides.push_back({{y(left), y(right)}, one.is_of_body});
        }
    const auto centre = [](const Linear &y) { return (y.left + y.right) / 2.; };
    std::stable_sort(
      sides.begin(), sides.end(), [&](const Side &a, const Side &b) {
        return centre(a.y) > centre(b.y);
      });
    // The ground and the base, in order: more of them are overhangs and holes.
    std::vector<std::size_t> of_body;
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (sides[i].is_of_body)
        of_body.push_back(i);
    if (of_body.size() != 2)
      refuse(format("0 where the body has an overhang or a hole, here at x = "
                    "%g m: the vertical stress jumps below it",
                    middle));
    Strip strip = {left, right, {}, sides[of_body[1]].y};
    for (std::size_t i = of_body[0]; i < of_body[1]; ++i)
      {
        const double above = centre(sides[i].y), below = centre(sides[i + 1].y);
        if (above - below < rounding)
          continue;
        const double weight = unit_weights[regions.material_at(
          in_plane(middle, (above + below) / 2.))];
        if (strip.layers.empty())
          strip.layers.push_back({sides[of_body[0]].y, {0., 0.}, weight});
        else if (weight != strip.layers.back().weight)
          {
            const Layer  &last = strip.layers.back();
            const Linear &top  = sides[i].y;
            strip.layers.push_back(
              {top,
               {last.stress.left + last.weight * (last.top.left - top.left),
                last.stress.right + last.weight * (last.top.right - top.right)},
               weight});
          }
      }
    if (!strip.layers.empty())
      strips.push_back(strip);
  }

  void
  SoilColumns::add_layers_of_box(const Geometry &geometry,
                                 const Regions  &regions)
  {
    const auto [low, high] = geometry.bounding_box();
    const bool is_alike    = std::all_of(
      unit_weights.begin(), unit_weights.end(), [&](const double weight) {
        return weight == unit_weights[0];
      });
    std::vector<double> y = {low[1], high[1]};
    for (const Polygon &region : regions.polygons())
      {
        const bool is_inside = region[0][1] < high[1] && region[1][1] > low[1];
        for (const unsigned int d : {0u, dim - 1})
          if (is_inside && !is_alike &&
              (region[0][d] > low[d] + rounding ||
               region[1][d] < high[d] - rounding))
            refuse("0 with regions of different weight that are not layers as "
                   "wide as the body: the vertical stress jumps below their "
                   "sides");
        for (const Point<dim> &corner : region)
          if (corner[1] > low[1] && corner[1] < high[1])
            y.push_back(corner[1]);
      }
    sort_distinct(y, rounding);
    Point<dim> place  = low + (high - low) / 2.;
    Strip      strip  = {low[0], high[0], {}, {low[1], low[1]}};
    double     stress = 0.;
    for (std::size_t i = y.size() - 1; i-- > 0;)
      {
        place[1]            = (y[i] + y[i + 1]) / 2.;
        const double weight = unit_weights[regions.material_at(place)];
        if (strip.layers.empty() || weight != strip.layers.back().weight)
          strip.layers.push_back(
            {{y[i + 1], y[i + 1]}, {stress, stress}, weight});
        stress += weight * (y[i + 1] - y[i]);
      }
    strips.push_back(strip);
  }

  const SoilColumns::Layer *
  SoilColumns::Strip::layer(const double x, const double y) const
  {
    const Layer *found = nullptr;
    for (const Layer &one : layers)
      if (y < at(one.top, x))
        found = &one;
    return found;
  }

  double
  SoilColumns::Strip::stress(const double x, const double y) const
  {
    const Layer *const one = layer(x, y);
    return one == nullptr
             ? 0.
             : at(one->stress, x) + one->weight * (at(one->top, x) - y);
  }

  const SoilColumns::Strip &
  SoilColumns::strip(const double x) const
  {
    const auto next = std::lower_bound(
      strips.begin(), strips.end(), x, [](const Strip &one, const double at) {
        return one.right < at;
      });
    return next == strips.end() ? strips.back() : *next;
  }

  double
  SoilColumns::stress(const Point<dim> &x) const
  {
    const Strip &here = strip(x[0]);
    return here.stress(std::clamp(x[0], here.left, here.right), x[1]);
  }

  Tensor<1, dim>
  SoilColumns::gradient(const Point<dim> &x) const
  {
    const Strip       &here = strip(x[0]);
    const Layer *const one =
      here.layer(std::clamp(x[0], here.left, here.right), x[1]);
    Tensor<1, dim> g;
    if (one != nullptr)
      {
        g[0] = here.slope_of_stress(*one);
        g[1] = -one->weight;
      }
    return g;
  }

  void
  SoilColumns::check_continuity() const
  {
    double largest = 0.;
    for (const Strip &one : strips)
      largest = std::max({largest,
                          one.stress(one.left, one.bottom.left),
                          one.stress(one.right, one.bottom.right)});
    for (std::size_t i = 0; i + 1 < strips.size(); ++i)
      {
        const Strip &a = strips[i], &b = strips[i + 1];
        const double x = a.right, low = std::max(a.bottom.right, b.bottom.left);
        std::vector<double> y = {low};
        for (const Layer &layer : a.layers)
          y.push_back(layer.top.right);
        for (const Layer &layer : b.layers)
          y.push_back(layer.top.left);
        const double top =
          std::min(a.layers[0].top.right, b.layers[0].top.left);
        if (top - low < rounding)
          continue;
        for (const double level : y)
          if (level >= low && level <= top)
            {
              const double above = a.stress(x, level),
                           other = b.stress(x, level);
              if (std::abs(above - other) > least_jump * largest)
                throw InputError(
                  parameter,
                  value,
                  format("0 where the vertical stress jumps, at (%g, %g) from "
                         "%g to %g Pa: below a step of the ground or beside an "
                         "upright interface of soils of different weight",
                         x,
                         level,
                         above,
                         other),
                  "incline the step or the interface over a small distance, "
                  "or " +
                    remedy);
            }
      }
  }

  bool
  SoilColumns::are_level() const
  {
    for (const Strip &one : strips)
      for (const Layer &layer : one.layers)
        if (std::abs(one.slope_of_stress(layer)) > least_jump * layer.weight)
          return false;
    return true;
  }

  std::vector<std::array<Point<dim>, 2>>
  SoilColumns::lines() const
  {
    std::vector<std::array<Point<dim>, 2>> all;
    for (std::size_t i = 0; i + 1 < strips.size(); ++i)
      add_lines_between(strips[i], strips[i + 1], all);
    if (dim == 3)
      for (std::size_t i = 1; i < strips[0].layers.size(); ++i)
        {
          const double y      = strips[0].layers[i].top.left,
                       beyond = 0.1 * (strips[0].right - strips[0].left);
          all.push_back({{in_plane(strips[0].left - beyond, y),
                          in_plane(strips[0].right + beyond, y)}});
        }
    return all;
  }

  void
  SoilColumns::add_lines_between(
    const Strip                            &left,
    const Strip                            &right,
    std::vector<std::array<Point<dim>, 2>> &all) const
  {
    const double x   = left.right,
                 low = std::max(left.bottom.right, right.bottom.left),
                 top =
                   std::min(left.layers[0].top.right, right.layers[0].top.left);
    std::vector<double> y = {low, top};
    for (const Layer &layer : left.layers)
      y.push_back(layer.top.right);
    for (const Layer &layer : right.layers)
      y.push_back(layer.top.left);
    sort_distinct(y, rounding);
    const double largest =
      *std::max_element(unit_weights.begin(), unit_weights.end());
    bool continues = false;
    for (std::size_t i = 0; i + 1 < y.size(); ++i)
      {
        const double       middle = (y[i] + y[i + 1]) / 2.;
        const Layer *const a      = left.layer(x, middle), *const b =
                                                        right.layer(x, middle);
        const bool is_inside =
          y[i] > low - rounding && y[i + 1] < top + rounding;
        const bool jumps =
          is_inside && a != nullptr && b != nullptr &&
          std::abs(left.slope_of_stress(*a) - right.slope_of_stress(*b)) >
            least_jump * largest;
        if (jumps && continues)
          all.back()[1] = in_plane(x, y[i + 1]);
        else if (jumps)
          all.push_back({{in_plane(x, y[i]), in_plane(x, y[i + 1])}});
        continues = jumps;
      }
  }

  void
  SoilColumns::refuse(const std::string &allowed) const
  {
    throw InputError(parameter, value, allowed, remedy);
  }
} // namespace geocone::GEOCONE_DIM
