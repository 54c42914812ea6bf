// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/scene/small_motion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Whether faces lie on one line oblique to the axes. */
    bool
    is_oblique_line(const VerticesOfFaces &faces)
    {
      if (dim == 3 || faces.empty())
        return false;
      const dealii::Point<dim> &first    = faces[0][0];
      dealii::Point<dim>        farthest = first;
      for (const auto &face : faces)
        for (const auto &x : face)
          if (first.distance(x) > first.distance(farthest))
            farthest = x;
      const auto   line   = farthest - first;
      const double length = line.norm(), rounding = 1e-9 * length;
      for (const auto &face : faces)
        for (const auto &x : face)
          if (std::abs(line[0] * (x - first)[1] - line[1] * (x - first)[0]) >
              rounding * length)
            return false;
      return std::abs(line[0]) > rounding && std::abs(line[1]) > rounding;
    }

    /** Extent of a plane controlled by a condition. */
    enum class Extent
    {
      none,
      some,
      all
    };

    /** Whether an end of the body along an axis is a plane of symmetry: the
     *  normal velocity is zero on all of it, and no other velocity is
     *  prescribed.
     *  @param across number of the axis @param extent_of of the plane */
    bool
    is_symmetric(
      const BoundaryConditions                               &conditions,
      const unsigned int                                      across,
      const std::function<Extent(const BoundaryCondition &)> &extent_of)
    {
      bool is_held = false;
      for (const auto &condition : conditions.list)
        if (const Extent extent = extent_of(*condition); extent != Extent::none)
          {
            for (unsigned int d = 0; d < dim; ++d)
              if (condition->components[d] &&
                  (d != across || !condition->components[d]->is_zero()))
                return false;
            if (condition->tangential ||
                (condition->normal && !condition->normal->is_zero()))
              return false;
            is_held = is_held ||
                      ((condition->components[across] || condition->normal) &&
                       extent == Extent::all);
          }
      return is_held;
    }

    /** Part of the boundary loaded by a condition. */
    struct PushedPart
    {
      dealii::Point<dim> low, high;
      VerticesOfFaces    faces; ///< none for moving sides
      bool               is_upright;

      /** Intersects the part with a box. */
      void
      cut(const std::array<dealii::Point<dim>, 2> &corners)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            low[d]  = std::max(low[d], corners[0][d]);
            high[d] = std::min(high[d], corners[1][d]);
          }
      }

      double
      length() const
      {
        return is_oblique_line(faces)
                 ? low.distance(high)
                 : std::abs(high[is_upright] - low[is_upright]);
      }
    };

    /** An end of the body along an axis. */
    struct EndPlane
    {
      unsigned int along;
      bool         is_first;
      double       place, rounding; ///< (m)
    };

    /** Speed prescribed by a condition at a point; 0 if undefined: the centre
     *  of a part need not be controlled. */
    double
    speed_at(const BoundaryCondition  &condition,
             const dealii::Point<dim> &place,
             const double              t)
    {
      double square = 0.;
      try
        {
          for (const auto &component : condition.components)
            if (component)
              square += std::pow(component->value(place, t), 2);
          for (const auto &along_side :
               {&condition.normal, &condition.tangential})
            if (*along_side)
              square += std::pow((*along_side)->value(place, t), 2);
        }
      catch (const RunError &)
        {
          return 0.;
        }
      return std::sqrt(square);
    }

    /** Search for the part that first moves by a thousandth of its length. */
    class SmallMotion
    {
    public:
      using FacesOf = std::function<VerticesOfFaces(const BoundaryCondition &)>;

      SmallMotion(const Scene                    &scene,
                  const dealii::BoundingBox<dim> &body,
                  const FacesOf                  &faces_of)
        : scene(scene)
        , body(body)
        , faces_of(faces_of)
        , end(scene.loading.duration())
      {}

      /** @return the minimum time, or 0 if nothing is loaded */
      double
      time();

    private:
      /** Greatest speed, sampled at some times of the run. */
      template <typename Velocity>
      double
      greatest(const Velocity &velocity) const
      {
        double                 speed = 0.;
        constexpr unsigned int looks = 64;
        for (unsigned int i = 0; i < looks; ++i)
          speed = std::max(speed, velocity(end * (i + 0.5) / looks));
        return speed;
      }

      void
      add(const double length, const double speed)
      {
        const double time = 1e-3 * length / speed;
        if (speed > 0. && std::isfinite(time) && (least == 0. || time < least))
          least = time;
      }

      /** Part of the boundary moved by a condition, if any. */
      std::optional<PushedPart>
      part_of(const BoundaryCondition &condition) const;

      /** Extent of an end of the body controlled by a condition. */
      Extent
      extent_on(const EndPlane          &plane,
                const BoundaryCondition &condition) const;

      /** Whether a part ends in one plane of symmetry. */
      bool
      ends_in_symmetry(const PushedPart &part) const;

      const Scene                    &scene;
      const dealii::BoundingBox<dim> &body;
      const FacesOf                  &faces_of;
      const double                    end; ///< of the loading (s)
      double                          least = 0.;
    };

    std::optional<PushedPart>
    SmallMotion::part_of(const BoundaryCondition &condition) const
    {
      PushedPart part;
      std::tie(part.low, part.high) = body.get_boundary_points();
      if (!condition.moves_with_body())
        {
          part.faces       = faces_of(condition);
          const auto reach = condition.bounding_box(part.faces);
          if (!reach)
            return {};
          part.cut(*reach);
        }
      else if (const auto box = condition.box_corners())
        part.cut(*box);
      // Vertical sides are as long as the part is high. Sides of a polygon may
      // have the names of those of a box.
      const bool is_box = scene.geometry.shape == Geometry::Shape::box;
      part.is_upright =
        condition.moves_with_body()
          ? is_box && std::any_of(condition.sides.begin(),
                                  condition.sides.end(),
                                  [](const std::string &side) {
                                    return side == "left" || side == "right";
                                  })
          : part.high[1] - part.low[1] > part.high[0] - part.low[0];
      return part;
    }

    Extent
    SmallMotion::extent_on(const EndPlane          &plane,
                           const BoundaryCondition &condition) const
    {
      if (condition.moves_with_body())
        {
          const char *const side = plane.along == 1
                                     ? (plane.is_first ? "bottom" : "top")
                                     : (plane.is_first ? "left" : "right");
          const bool is_box      = scene.geometry.shape == Geometry::Shape::box;
          return !condition.is_on_side(is_box ? side : "all") ? Extent::none
                 : condition.wide_box() || condition.has_formula()
                   ? Extent::some
                   : Extent::all;
        }
      auto       faces   = faces_of(condition);
      const auto is_away = [&](const dealii::Point<dim> &x) {
        return std::abs(x[plane.along] - plane.place) > plane.rounding;
      };
      faces.erase(std::remove_if(faces.begin(),
                                 faces.end(),
                                 [&](const auto &face) {
                                   return std::any_of(
                                     face.begin(), face.end(), is_away);
                                 }),
                  faces.end());
      const auto held = condition.bounding_box(faces);
      if (!held)
        return Extent::none;
      for (const auto &face : faces)
        for (const auto &x : face)
          for (unsigned int d = 0; d < dim; ++d)
            if (x[d] < (*held)[0][d] - plane.rounding ||
                x[d] > (*held)[1][d] + plane.rounding)
              return Extent::some;
      return Extent::all;
    }

    bool
    SmallMotion::ends_in_symmetry(const PushedPart &part) const
    {
      const auto [left, right]     = body.get_boundary_points();
      const unsigned int along     = part.is_upright ? 1 : 0;
      const double       rounding  = 1e-9 * (right[along] - left[along]);
      const bool         ends_left = part.low[along] <= left[along] + rounding,
                 ends_right = part.high[along] >= right[along] - rounding;
      const EndPlane plane  = {
         along, ends_left, ends_left ? left[along] : right[along], rounding};
      return ends_left != ends_right && scene.gravity.at(end)[along] == 0. &&
             !scene.geometry.is_axisymmetric() &&
             is_symmetric(
               scene.dirichlet, along, [&](const BoundaryCondition &other) {
                 return extent_on(plane, other);
               });
    }

    double
    SmallMotion::time()
    {
      double width_of_body = body.side_length(0);
      for (unsigned int d = 1; d < dim; ++d)
        width_of_body = std::min(width_of_body, body.side_length(d));
      for (const auto &obstacle : scene.obstacles.list)
        add(std::min(width_of_body, obstacle->width()),
            greatest([&](const double t) {
              return obstacle->velocity(t).centre.norm();
            }));
      for (const auto &condition : scene.dirichlet.list)
        if (const auto part = part_of(*condition))
          {
            double     length = part->length();
            const auto centre =
              dealii::Point<dim>((part->low + part->high) / 2.);
            // A part of a side that ends in a plane of symmetry continues
            // beyond it; in axisymmetry the radius is used, otherwise loads
            // would be one per cent too low.
            if (ends_in_symmetry(*part))
              length *= 2.;
            add(length, greatest([&](const double t) {
                  return speed_at(*condition, centre, t);
                }));
          }
      return least;
    }
  } // namespace

  double
  time_of_small_motion(const Scene                    &scene,
                       const dealii::BoundingBox<dim> &mesh,
                       const SmallMotion::FacesOf     &faces_of)
  {
    const Geometry &geometry = scene.geometry;
    if (geometry.shape == Geometry::Shape::discs)
      return 0.;
    const dealii::BoundingBox<dim> body =
      geometry.outline.empty() ? mesh
                               : dealii::BoundingBox<dim>(geometry.outline);
    return SmallMotion(scene, body, faces_of).time();
  }
} // namespace geocone::GEOCONE_DIM
