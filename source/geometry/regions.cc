// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/geometry/regions.h>

#include <algorithm>
#include <tuple>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    /** Part of the domain below a line, which is extended horizontally at its
     *  ends. */
    Polygon
    part_below(const std::vector<Point<dim>> &line, const Geometry &geometry)
    {
      // For a file only points are tested, at any position.
      double     margin = largest_coordinate;
      Point<dim> lower = line.front(), upper = line.back();
      if (geometry.shape != Geometry::Shape::file)
        {
          std::tie(lower, upper) = geometry.bounding_box();
          margin                 = lower.distance(upper);
        }
      const double left  = std::min(lower[0], line.front()[0]) - margin;
      const double right = std::max(upper[0], line.back()[0]) + margin;
      double       base  = lower[1];
      for (const Point<dim> &x : line)
        base = std::min(base, x[1]);
      base -= margin;
      const auto at = [](const double x, const double y) {
        Point<dim> place;
        place[0] = x;
        place[1] = y;
        return place;
      };
      Polygon part = {at(left, base), at(right, base)};
      part.push_back(at(right, line.back()[1]));
      part.insert(part.end(), line.rbegin(), line.rend());
      part.push_back(at(left, line.front()[1]));
      return part;
    }
  } // namespace

  Regions::Region::Region(const std::string &name)
    : dealii::ParameterAcceptor("/Materials/" + name)
  {
    add_parameter(
      "Region polygon",
      polygon,
      std::string(
        dim == 2 ? "Vertices x, y; x, y; ... [m]"
                 : "Lowest and highest corner x, y, z; x, y, z of a box [m]") +
        " of the region of this material. Empty: the first material fills the "
        "rest of the domain.");
    if (dim == 2)
      add_parameter("Region below",
                    below,
                    "Points x, y; x, y; ... [m] of a line, x ascending: this "
                    "material fills the domain below it. The line is extended "
                    "horizontally; one point is a level. Layers are listed "
                    "from the top: each overrides those before it.");
    add_parameter("Region number",
                  group,
                  "Number or name of the physical surface of the .msh file "
                  "that is the region of this material; -1: none.");
    points.declare(
      *this,
      "Points",
      ". Points of this material with implicit MPM. Fixed: fixed quadrature "
      "points of the background mesh with small strains, as with finite "
      "elements, beside moving materials.");
  }

  void
  Regions::Region::prepare(const Geometry &geometry)
  {
    const std::string section = get_section_name().substr(1);
    if (!polygon.empty())
      check_polygon(polygon, section + "/Region polygon");
    if (!polygon.empty() && !below.empty())
      throw InputError(section + "/Region below",
                       text_of_polygon(below),
                       "empty with a 'Region polygon'",
                       "give one of them");
    for (std::size_t i = 0; i < below.size(); ++i)
      if (!(std::abs(below[i][0]) <= largest_coordinate &&
            std::abs(below[i][1]) <= largest_coordinate &&
            (i == 0 || below[i][0] > below[i - 1][0])))
        throw InputError(section + "/Region below",
                         text_of_polygon(below),
                         "points whose x ascends",
                         "list them from left to right; for a part with "
                         "overhangs give a 'Region polygon'");
    outline = below.empty() ? polygon : part_below(below, geometry);
    if (has_group() && geometry.shape != Geometry::Shape::file)
      throw InputError(section + "/Region number",
                       group,
                       "-1, unless the domain comes from a .msh file",
                       dim == 2 ? "give a 'Region polygon' or 'Region below'"
                                : "give a 'Region polygon'");
  }

  Regions::Regions(const std::vector<std::string> &materials)
  {
    for (const std::string &name : materials)
      regions.push_back(std::make_unique<Region>(name));
  }

  void
  Regions::prepare(const Geometry          &geometry,
                   const std::vector<bool> &may_be_empty_)
  {
    empty_ones = may_be_empty_;
    for (std::size_t i = 0; i < regions.size(); ++i)
      {
        Region &region = *regions[i];
        region.prepare(geometry);
        if (region.outline.empty() && !region.has_group() && !may_be_empty(i))
          throw InputError(region.get_section_name().substr(1) +
                             "/Region polygon",
                           "",
                           "a polygon (or a region number) for every material "
                           "but the first",
                           "say where this material is");
      }
  }

  void
  Regions::refuse_fixed(const std::string &method) const
  {
    for (const auto &region : regions)
      if (region->points == Points::fixed)
        throw InputError(
          region->get_section_name().substr(1) + "/Points",
          "fixed",
          "moving with " + method,
          "set Discretisation/Method = MPM, or move all of them");
  }

  std::vector<Polygon>
  Regions::polygons() const
  {
    std::vector<Polygon> all;
    for (const auto &region : regions)
      if (!region->outline.empty())
        all.push_back(region->outline);
    return all;
  }

  bool
  Regions::have_groups() const
  {
    return std::any_of(regions.begin(), regions.end(), [](const auto &region) {
      return region->has_group();
    });
  }

  void
  Regions::check_groups(const std::map<int, std::string> &groups) const
  {
    const char *const kind = dim == 2 ? "surfaces" : "volumes";
    for (const auto &region : regions)
      {
        std::string known;
        bool        found = !region->has_group();
        for (const auto &[number, name] : groups)
          {
            found = found || region->is_group(number, name);
            known += (known.empty() ? "" : ", ") + std::to_string(number);
            if (!name.empty())
              known += " ('" + name + "')";
          }
        if (!found)
          throw InputError(
            region->get_section_name().substr(1) + "/Region number",
            region->group,
            known.empty() ? std::string("-1: the file has no physical ") + kind
                          : std::string("the physical ") + kind + " " + known,
            known.empty() ? "make them in gmsh, or give a 'Region polygon'"
                          : "choose one of them by its number or name");
      }
  }

  unsigned int
  Regions::material_at(const Point<dim> &x) const
  {
    return material_at(x, -1, "");
  }

  unsigned int
  Regions::material_at(const Point<dim>  &x,
                       const int          group,
                       const std::string &name) const
  {
    for (std::size_t i = regions.size(); i-- > 1;)
      if (regions[i]->is_group(group, name) ||
          (!regions[i]->outline.empty() && contains(regions[i]->outline, x)))
        return i;
    return 0;
  }
} // namespace geocone::GEOCONE_DIM
