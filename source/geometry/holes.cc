// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/quoted_names.h>
#include <geocone/geometry/holes.h>
#include <geocone/geometry/side_names.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Utilities::split_string_list;

  namespace
  {
    constexpr const char *parameter   = "Geometry/Holes";
    constexpr const char *forms       = "polygons x, y; x, y; ... or circle(x, "
                                        "y, r) or circle(x, y, r, n), with or "
                                        "without 'name: ', separated by |";
    constexpr unsigned    usual_sides = 48, most_sides = 10000;

    /** Numbers in a text, separated by commas. @throws InputError */
    std::vector<double>
    numbers_in(const std::string &text, const std::string &hole)
    {
      try
        {
          return dealii::Utilities::string_to_double(split_string_list(text));
        }
      catch (const std::exception &)
        {
          throw InputError(
            parameter, hole, forms, "'" + text + "' is no list of numbers");
        }
    }

    /** Circle as a regular polygon. @param hole its text, for messages */
    Polygon
    circle_of(const std::vector<double> &numbers, const std::string &hole)
    {
      const bool has_number = numbers.size() == 4;
      if (numbers.size() != 3 && !has_number)
        throw InputError(parameter,
                         hole,
                         "circle(x, y, r) or circle(x, y, r, n)",
                         "give centre, radius and, if wanted, the number of "
                         "sides");
      const double radius = numbers[2],
                   n      = has_number ? numbers[3] : usual_sides;
      if (!(radius > 0.))
        throw InputError(parameter, hole, "a radius > 0", "give it in m");
      if (!(n >= 3. && n <= most_sides && n == std::floor(n)))
        throw InputError(parameter,
                         hole,
                         format("3 to %u sides of a circle", most_sides),
                         format("%u are usual", usual_sides));
      Polygon circle;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = 2. * pi * i / n;
          Point<dim>   x;
          x[0] = numbers[0] + radius * std::sin(angle);
          x[1] = numbers[1] - radius * std::cos(angle);
          circle.push_back(x);
        }
      return circle;
    }

    Polygon
    polygon_of(const std::string &text)
    {
      constexpr const char *circle = "circle(";
      if (text.rfind(circle, 0) == 0)
        {
          if (text.back() != ')')
            throw InputError(parameter, text, forms, "close the bracket");
          const std::size_t begin = std::string(circle).size();
          return circle_of(
            numbers_in(text.substr(begin, text.size() - begin - 1), text),
            text);
        }
      Polygon polygon;
      for (const std::string &vertex : split_string_list(text, ';'))
        {
          const std::vector<double> numbers = numbers_in(vertex, text);
          if (numbers.size() != dim)
            throw InputError(
              parameter, text, forms, "'" + vertex + "' is no vertex x, y");
          Point<dim> x;
          std::copy(numbers.begin(), numbers.end(), x.begin_raw());
          polygon.push_back(x);
        }
      return polygon;
    }

    /** Hole of the description 'polygon' or 'name: polygon'.
     *  @param number of the hole */
    Hole
    hole_of(const std::string &text, const std::size_t number)
    {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
        return {"hole " + std::to_string(number), polygon_of(text)};
      const std::string name = unquoted(
        {dealii::Utilities::trim(text.substr(0, colon))}, parameter)[0];
      check_side_name(name, parameter, "hole " + std::to_string(number));
      return {name,
              polygon_of(dealii::Utilities::trim(text.substr(colon + 1)))};
    }

    /** Whether a side of one polygon meets one of another. */
    bool
    meet(const Polygon &one, const Polygon &other)
    {
      const double tolerance =
        std::max(resolved_length(one), resolved_length(other));
      for (std::size_t i = 0; i < one.size(); ++i)
        for (std::size_t j = 0; j < other.size(); ++j)
          if (segments_meet(one[i],
                            one[(i + 1) % one.size()],
                            other[j],
                            other[(j + 1) % other.size()],
                            tolerance))
            return true;
      return false;
    }
  } // namespace

  std::vector<Hole>
  holes_of(const std::string &text, const Polygon &outline)
  {
    std::vector<Hole> holes;
    for (const std::string &hole : split_string_list(text, '|'))
      {
        const auto [name, polygon] = hole_of(hole, holes.size());
        check_polygon(polygon, parameter);
        if (meet(polygon, outline))
          throw InputError(parameter,
                           hole,
                           "holes inside the body, apart from its outline",
                           name +
                             " meets the outline: move it, or let the outline "
                             "go around it");
        if (!contains(outline, polygon[0]))
          throw InputError(parameter,
                           hole,
                           "holes inside the body, apart from its outline",
                           name + " lies outside of it");
        for (const Hole &other : holes)
          if (meet(polygon, other.outline) ||
              contains(polygon, other.outline[0]) ||
              contains(other.outline, polygon[0]))
            throw InputError(parameter,
                             hole,
                             "holes apart from each other",
                             other.name + " and " + name +
                               " overlap or touch: move one of them, or make "
                               "them one");
        holes.push_back({name, polygon});
      }
    return holes;
  }
} // namespace geocone::GEOCONE_DIM
