// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/points/soil_part.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Relative size of gaps between loaded facets over a cell that counts as
     *  zero. */
    constexpr double negligible_gap = 1e-6;

    /** Slope up to which the mean level of a loaded side is taken at the edge of
     *  another one: an error of this part of the traction. */
    constexpr double small_slope = 0.02;

    /** Part of a cell's box on the soil's side of the limits that intersect it
     *  or lie at most one cell away. */
    Corners
    part_within(const BoundingBox<dim>       &box,
                const std::vector<SoilLimit> &limits)
    {
      auto [lower, upper] = box.get_boundary_points();
      for (const SoilLimit &limit : limits)
        {
          bool acts = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double size = box.side_length(d);
              acts =
                acts && (d == limit.axis
                           ? limit.level > box.lower_bound(d) - size &&
                               limit.level < box.upper_bound(d) + size
                           : limit.extent.lower_bound(d) <
                                 box.lower_bound(d) + negligible_part * size &&
                               limit.extent.upper_bound(d) >
                                 box.upper_bound(d) - negligible_part * size);
            }
          if (!acts)
            continue;
          const double level = std::clamp(limit.level,
                                          box.lower_bound(limit.axis),
                                          box.upper_bound(limit.axis));
          if (limit.soil_is_below)
            upper[limit.axis] = std::min(upper[limit.axis], level);
          else
            lower[limit.axis] = std::max(lower[limit.axis], level);
        }
      return {lower, upper};
    }

    /** Area of a box normal to an axis; in two dimensions a length. */
    double
    cross_section(const Corners &box, const unsigned int axis)
    {
      double product = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          product *= std::max(0., box.second[d] - box.first[d]);
      return product;
    }

    /** Axis to which an area is nearly normal. */
    unsigned int
    main_axis(const Tensor<1, dim> &area)
    {
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(area[d]) > std::abs(area[axis]))
          axis = d;
      return axis;
    }
  } // namespace

  LoadedFacet::LoadedFacet(const SidePart &part)
    : LoadedFacet(part, main_axis(area_of(part)))
  {}

  bool
  LoadedFacet::is_near(const BoundingBox<dim> &cell,
                       const unsigned int      along) const
  {
    bool near = true;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double margin =
          (d == along ? 1. : -negligible_part) * cell.side_length(d);
        near = near && extent.lower_bound(d) < cell.upper_bound(d) + margin &&
               extent.upper_bound(d) > cell.lower_bound(d) - margin;
      }
    return near;
  }

  bool
  LoadedFacet::is_nearly_normal_to_axis() const
  {
    Tensor<1, dim> across = area_of(part);
    const double   size   = across.norm();
    across[axis]          = 0.;
    return across.norm() < small_slope * size;
  }

  double
  SoilPart::volume() const
  {
    if (top.empty())
      return cross_section(box, 0) * std::max(0., box.second[0] - box.first[0]);
    double sum = 0.;
    for (const LoadedFacet &facet : top)
      sum += facet.projected_area() * height(facet, facet.part.middle());
    return sum;
  }

  std::vector<std::pair<Point<dim>, double>>
  SoilPart::quadrature(const unsigned int n) const
  {
    std::vector<std::pair<Point<dim>, double>> points;
    if (top.empty())
      {
        const QGauss<dim> rule(n);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point<dim> x;
            for (unsigned int d = 0; d < dim; ++d)
              x[d] = box.first[d] +
                     (box.second[d] - box.first[d]) * rule.point(q)[d];
            points.push_back({x, rule.weight(q) * volume()});
          }
        return points;
      }
    const Quadrature<dim - 1> across = rule_of_facets();
    const QGauss<1>           along(n + 1);
    for (const LoadedFacet &facet : top)
      for (unsigned int q = 0; q < across.size(); ++q)
        {
          Point<dim>   x       = facet.part.at(across.point(q));
          const double top_end = x[facet.axis], h = height(facet, x);
          for (unsigned int k = 0; k < along.size(); ++k)
            {
              x[facet.axis] =
                top_end + (facet.soil_is_below ? -h : h) * along.point(k)[0];
              points.push_back({x,
                                facet.projected_area() * h * across.weight(q) *
                                  along.weight(k)});
            }
        }
    return points;
  }

  namespace
  {
    /** Parts of facets in the column of a box along their axis, limited to the
     *  box. */
    std::vector<LoadedFacet>
    over_box(const Corners                  &box,
             const unsigned int              axis,
             const std::vector<LoadedFacet> &facets)
    {
      std::vector<SideOfPlane> column;
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          {
            column.push_back({box.first, Point<dim>::unit_vector(d)});
            column.push_back({box.second, -Point<dim>::unit_vector(d)});
          }
      const double         from = box.first[axis], to = box.second[axis];
      const Tensor<1, dim> up = Point<dim>::unit_vector(axis);
      const std::vector<std::vector<SideOfPlane>> layers = {
        {{box.first, -up}},
        {{box.first, up}, {box.second, -up}},
        {{box.second, up}}};
      std::vector<LoadedFacet> result;
      const auto               add = [&](SidePart piece) {
        for (Point<dim> &corner : piece.corners)
          corner[axis] = std::clamp(corner[axis], from, to);
        if (std::abs(area_of(piece)[axis]) > 0.)
          result.emplace_back(piece, axis);
      };
      for (const LoadedFacet &facet : facets)
        for (const SidePart &piece : pieces_between(column, facet.part))
          {
            const BoundingBox<dim> extent(piece.corners);
            if (!(extent.side_length(axis) > negligible_part * (to - from)))
              add(piece);
            else // below, inside and above the box
              for (const std::vector<SideOfPlane> &layer : layers)
                for (const SidePart &rest : pieces_between(layer, piece))
                  add(rest);
          }
      return result;
    }

    double
    projected_area(const std::vector<LoadedFacet> &facets)
    {
      double sum = 0.;
      for (const LoadedFacet &facet : facets)
        sum += facet.projected_area();
      return sum;
    }

    /** Whether facets cover the cross-section of a box up to a part of it. */
    bool
    covers(const std::vector<LoadedFacet> &facets,
           const Corners                  &box,
           const unsigned int              axis,
           const double                    gap)
    {
      const double size = cross_section(box, axis);
      return std::abs(projected_area(facets) - size) < gap * size;
    }

    /** Part of a box up to the loaded facets that lie over it along an axis, if
     *  they cover its cross-section and have the soil on the same side. With the
     *  axis chosen for all of them, columns of the box neither overlap nor leave
     *  gaps, whatever their slopes. */
    std::optional<SoilPart>
    cut_along(const unsigned int              axis,
              const BoundingBox<dim>         &cell,
              const Corners                  &box,
              const std::vector<LoadedFacet> &loaded)
    {
      std::vector<LoadedFacet> near;
      for (const LoadedFacet &facet : loaded)
        if (facet.is_near(cell, axis))
          near.emplace_back(facet.part, axis);
      SoilPart                                cut{box};
      const double                            size = cell.side_length(axis);
      std::array<std::vector<LoadedFacet>, 2> tops; // by side of the soil
      std::array<bool, 2>                     limits = {};
      for (const LoadedFacet &facet : over_box(box, axis, near))
        {
          const bool below = facet.soil_is_below;
          tops[below].push_back(facet);
          if (cut.height(facet, facet.part.middle()) <
              box.second[axis] - box.first[axis] - negligible_part * size)
            limits[below] = true;
        }
      if (limits[0] && limits[1])
        return std::nullopt; // a thin body
      // Of a side beyond the box nothing remains but its soil in all of it.
      if (!tops[0].empty() && !tops[1].empty())
        tops[limits[1] ? 0 : 1].clear();
      cut.top = tops[0].empty() ? tops[1] : tops[0];
      if (!covers(cut.top, box, axis, negligible_gap))
        return std::nullopt;
      return cut;
    }

    /** Part of a box at a convex corner of loaded sides nearly normal to the
     *  axes: the box up to their mean levels. */
    std::optional<SoilPart>
    cut_at_corner(const BoundingBox<dim>         &cell,
                  const Corners                  &box,
                  const std::vector<LoadedFacet> &loaded)
    {
      std::array<std::vector<LoadedFacet>, dim> near; // by axis
      for (const LoadedFacet &facet : loaded)
        if (facet.is_near(cell, facet.axis))
          {
            if (!facet.is_nearly_normal_to_axis())
              return std::nullopt;
            near[facet.axis].push_back(facet);
          }
      SoilPart cut{box};
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const std::vector<LoadedFacet> tops = over_box(box, axis, near[axis]);
          if (tops.empty())
            continue;
          const bool below = tops[0].soil_is_below;
          double     level = 0.;
          for (const LoadedFacet &facet : tops)
            level += facet.projected_area() / projected_area(tops) *
                     facet.part.middle()[axis];
          for (const LoadedFacet &facet : tops)
            if (facet.soil_is_below != below ||
                std::abs(facet.part.middle()[axis] - level) >
                  small_slope * cell.side_length(axis))
              return std::nullopt; // a thin body, or a step
          (below ? cut.box.second : cut.box.first)[axis] = level;
        }
      // Facets that end at a re-entrant corner do not cover the box.
      for (unsigned int axis = 0; axis < dim; ++axis)
        if (!near[axis].empty() &&
            !covers(
              over_box(cut.box, axis, near[axis]), cut.box, axis, small_slope))
          return std::nullopt;
      return cut;
    }

    /** Limits the soil part of a cell to the loaded sides near it, where it is
     *  known exactly from them. */
    void
    cut_at_loaded_sides(const BoundingBox<dim>         &cell,
                        const std::vector<LoadedFacet> &loaded,
                        SoilPart                       &part)
    {
      std::vector<LoadedFacet> near;
      Tensor<1, dim>           area; // without signs
      for (const LoadedFacet &facet : loaded)
        {
          bool is_near = false;
          for (unsigned int d = 0; d < dim; ++d)
            is_near = is_near || facet.is_near(cell, d);
          if (!is_near)
            continue;
          near.push_back(facet);
          const Tensor<1, dim> of_facet = area_of(facet.part);
          for (unsigned int d = 0; d < dim; ++d)
            area[d] += std::abs(of_facet[d]);
        }
      if (near.empty())
        return;
      std::array<unsigned int, dim> axes;
      std::iota(axes.begin(), axes.end(), 0);
      std::stable_sort(axes.begin(),
                       axes.end(),
                       [&](const unsigned int a, const unsigned int b) {
                         return area[a] > area[b];
                       });
      for (const unsigned int axis : axes)
        if (const auto cut = cut_along(axis, cell, part.box, near))
          {
            part = *cut;
            return;
          }
      if (const auto cut = cut_at_corner(cell, part.box, near))
        part = *cut;
    }
  } // namespace

  SoilPart
  soil_part(const BoundingBox<dim> &cell, const KnownBoundary &boundary)
  {
    SoilPart part{part_within(cell, boundary.limits)};
    if (!boundary.loaded.empty())
      cut_at_loaded_sides(cell, boundary.loaded, part);
    return part;
  }
} // namespace geocone::GEOCONE_DIM
