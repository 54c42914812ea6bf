// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/lexicographic.h>
#include <geocone/base/log.h>
#include <geocone/base/quoted_names.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/functions/formula.h>
#include <geocone/geometry/geometry.h>
#include <geocone/geometry/holes.h>
#include <geocone/geometry/side_names.h>

#include <deal.II/base/bounding_box.h>

#include <filesystem>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    const UsedWhere used_geometry[] = {
      {"Geometry/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Geometry/Box", "Geometry/Shape", {"box"}},
      {"Geometry/Polygon", "Geometry/Shape", {"polygon"}},
      {"Geometry/Side names", "Geometry/Shape", {"polygon"}},
      {"Geometry/Holes", "Geometry/Shape", {"box", "polygon"}},
      {"Geometry/Centres", "Geometry/Shape", {"discs"}},
      {"Geometry/Radii", "Geometry/Shape", {"discs"}},
      {"Geometry/File", "Geometry/Shape", {"file"}}};
  } // namespace

  namespace
  {
    double
    cross(const Point<dim> &o, const Point<dim> &a, const Point<dim> &b)
    {
      return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }

    /** Whether these are the lowest and the highest corner of a box. */
    bool
    is_box(const std::vector<Point<dim>> &corners)
    {
      bool ok = corners.size() == 2;
      for (unsigned int c = 0; c < dim && ok; ++c)
        ok = corners[0][c] < corners[1][c];
      return ok;
    }

    /** Declares the names of the sides of a polygon and the holes of a plane
     *  body. */
    void
    declare_names_and_holes(dealii::ParameterAcceptor &geometry,
                            std::vector<std::string>  &side_names,
                            std::string               &holes)
    {
      geometry.add_parameter(
        "Side names",
        side_names,
        "Names of the sides of the polygon for 'Sides' of conditions, instead "
        "of their numbers: one for each side, in the order of the vertices, "
        "comma-separated, e.g. base, right, crest, slope, left. A side whose "
        "number stands in its place has no other name. Empty: numbers.");
      geometry.add_parameter(
        "Holes",
        holes,
        "Holes of the box or polygon, separated by |: polygons x, y; x, y; "
        "... [m] or circle(x, y, r), circle(x, y, r, n) with n sides (48) and "
        "their vertices on the circle. 'hole 0', 'hole 1', ... are all sides "
        "of one for 'Sides' of conditions, or the name before it: tunnel: "
        "circle(0, -5, 2). The numbers of their sides follow those of the "
        "outline, in the order of the holes. For FEM and bounds with an "
        "unstructured mesh, and for particles.");
    }
  } // namespace

  bool
  segments_meet(const Point<dim> &a,
                const Point<dim> &b,
                const Point<dim> &c,
                const Point<dim> &d,
                const double      tolerance)
  {
    if (distance_to_segment(a, c, d) < tolerance ||
        distance_to_segment(b, c, d) < tolerance ||
        distance_to_segment(c, a, b) < tolerance ||
        distance_to_segment(d, a, b) < tolerance)
      return true;
    return cross(a, b, c) * cross(a, b, d) < 0. &&
           cross(c, d, a) * cross(c, d, b) < 0.;
  }

  double
  signed_area(const Polygon &polygon)
  {
    double area = 0.;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      area +=
        cross(polygon[0], polygon[i], polygon[(i + 1) % polygon.size()]) / 2.;
    return area;
  }

  std::string
  text_of_polygon(const Polygon &polygon)
  {
    std::string all;
    for (const Point<dim> &x : polygon)
      all += (all.empty() ? "" : "; ") + text_of_place(x);
    return all;
  }

  Polygon
  outline_of_box(const Point<dim> &lower, const Point<dim> &upper)
  {
    if (dim == 3)
      return {lower, upper};
    Point<dim> right = lower, left = upper;
    right[0] = upper[0];
    left[0]  = lower[0];
    return {lower, right, upper, left};
  }

  std::map<std::string, dealii::types::boundary_id>
  sides_of_box()
  {
    std::map<std::string, dealii::types::boundary_id> sides = {
      {"bottom", 0}, {"right", 1}, {"top", 2}, {"left", 3}};
    if (dim == 3)
      {
        sides["back"]  = 4;
        sides["front"] = 5;
      }
    return sides;
  }

  bool
  contains(const Polygon &polygon, const Point<dim> &x)
  {
    if (dim == 3)
      {
        for (unsigned int c = 0; c < dim; ++c)
          if (x[c] < polygon[0][c] || x[c] > polygon[1][c])
            return false;
        return true;
      }
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
      {
        const Point<dim> &a = polygon[i], &b = polygon[j];
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
          inside = !inside;
      }
    return inside;
  }

  Point<dim>
  nearest_on_segment(const Point<dim> &x,
                     const Point<dim> &a,
                     const Point<dim> &b)
  {
    const dealii::Tensor<1, dim> side = b - a;
    const double                 s =
      std::max(0., std::min(1., (x - a) * side / side.norm_square()));
    return a + s * side;
  }

  double
  distance_to_segment(const Point<dim> &x,
                      const Point<dim> &a,
                      const Point<dim> &b)
  {
    return x.distance(nearest_on_segment(x, a, b));
  }

  double
  resolved_length(const std::vector<Point<dim>> &points)
  {
    double largest = 0.;
    for (const Point<dim> &x : points)
      for (unsigned int c = 0; c < dim; ++c)
        largest = std::max(largest, std::abs(x[c]));
    return std::max(smallest_size, smallest_relative_size * largest);
  }

  void
  check_coordinates(const std::vector<Point<dim>> &points,
                    const std::string             &parameter)
  {
    for (const Point<dim> &x : points)
      for (unsigned int c = 0; c < dim; ++c)
        if (!(std::abs(x[c]) <= largest_coordinate))
          throw InputError(parameter,
                           text_of_polygon(points),
                           format("coordinates up to %g m", largest_coordinate),
                           "give them in m, from an origin near the body");
    for (unsigned int c = 0; c < dim; ++c)
      {
        const auto [low, high] = std::minmax_element(
          points.begin(), points.end(), [&](const auto &a, const auto &b) {
            return a[c] < b[c];
          });
        if ((*high)[c] - (*low)[c] < resolved_length(points))
          throw InputError(
            parameter,
            text_of_polygon(points),
            format("an extent of %g m or more along ",
                   resolved_length(points)) +
              coordinates + ", at these coordinates",
            "put the origin near the body: numbers of 16 digits hold no small "
            "body far away");
      }
  }

  void
  check_polygon(const Polygon &polygon, const std::string &parameter)
  {
    if (dim == 3)
      {
        if (!is_box(polygon))
          throw InputError(parameter,
                           text_of_polygon(polygon),
                           "the lowest and the highest corner x, y, z; x, y, z "
                           "of a box in three dimensions",
                           "e.g. 0, -2, 0; 3, -1, 3");
        return check_coordinates(polygon, parameter);
      }
    const std::size_t n = polygon.size();
    const std::string allowed =
      "three or more vertices x, y; x, y; ... of a polygon whose sides do not "
      "meet";
    if (n < 3)
      throw InputError(
        parameter, text_of_polygon(polygon), allowed, "give its vertices");
    check_coordinates(polygon, parameter);
    double size = 0.;
    for (const Point<dim> &x : polygon)
      size = std::max(size, (x - polygon[0]).norm());
    for (std::size_t i = 0; i < n; ++i)
      {
        if (polygon[i].distance(polygon[(i + 1) % n]) <
            std::max(1e-9 * size, resolved_length(polygon)))
          throw InputError(parameter,
                           text_of_polygon(polygon),
                           allowed,
                           "vertex " + std::to_string(i) +
                             " and the next one are the same");
        for (std::size_t j = i + 2; j < n; ++j)
          if ((i != 0 || j != n - 1) && segments_meet(polygon[i],
                                                      polygon[i + 1],
                                                      polygon[j],
                                                      polygon[(j + 1) % n],
                                                      1e-9 * size))
            throw InputError(parameter,
                             text_of_polygon(polygon),
                             allowed,
                             "it intersects itself: the sides " +
                               std::to_string(i) + " and " + std::to_string(j) +
                               " meet; check the order of the vertices");
      }
    if (std::abs(signed_area(polygon)) < 1e-9 * size * size)
      throw InputError(parameter,
                       text_of_polygon(polygon),
                       allowed,
                       "the vertices lie on one line");
  }

  Geometry::Geometry(const ParameterFile &parameter_file)
    : dealii::ParameterAcceptor("/Geometry")
    , folder_of_parameters(parameter_file.folder())
  {
    dealii::Point<dim> lower, upper, corner;
    for (unsigned int c = 0; c < dim; ++c)
      {
        lower[c] = c == 1 ? -2. : -1.;
        upper[c] = c == 1 ? 0. : 1.;
      }
    box               = {lower, upper};
    corner[0]         = 1.;
    polygon           = {dealii::Point<dim>(), corner, corner};
    polygon.back()[1] = 1.;
    shape.declare(*this,
                  "Shape",
                  dim == 2 ? ". Discs: MPM only."
                           : ". Discs are balls, MPM only.");
    symmetry.declare(*this,
                     "Symmetry",
                     ". Axisymmetric: x >= 0 is the radius and y the axis; "
                     "forces are those of the full circumference (N). For FEM "
                     "and MPM, with laws of the full stress tensor.");
    add_parameter("Dimension",
                  dimension,
                  "Dimension of the scene, 2 or 3. 3: points have coordinates "
                  "x, y, z (y upwards), polygons of regions are boxes given by "
                  "two corners, and forces are in N. For FEM and MPM.",
                  prm,
                  dealii::Patterns::Integer(2, 3));
    add_parameter("Box",
                  box,
                  dim == 2
                    ? "Lower left and upper right corner x, y; x, y [m]. Its "
                      "sides are named bottom, right, top, left."
                    : "Lowest and highest corner x, y, z; x, y, z [m]. Its "
                      "sides are named left and right (lowest and highest x), "
                      "bottom and top (y), back and front (z).");
    add_parameter("Where",
                  where_text,
                  std::string("MPM: restricts the body to the part of the "
                              "shape where this formula in ") +
                    coordinates + " (m) is > 0, e.g. " +
                    (dim == 2 ? "0.25 - x^2 - y^2" : "0.25 - x^2 - z^2") +
                    " for a " + (dim == 2 ? "disc" : "cylinder") +
                    " of radius 0.5 m. Empty: entire shape.");
    add_parameter("Polygon",
                  polygon,
                  "Vertices x, y; x, y; ... [m] in order. Side i connects "
                  "vertex i and the next one, and is named i (0, 1, ...) "
                  "unless it has one of the 'Side names'.");
    if (dim == 2)
      declare_names_and_holes(*this, side_names, holes_text);
    add_parameter(
      "Centres", centres, "Centres of the discs x, y; x, y; ... [m].");
    add_parameter("Radii",
                  radii,
                  "Radii of the discs [m], comma-separated; one for all or one "
                  "per centre.");
    add_parameter(
      "File",
      file,
      "gmsh mesh file (.msh, version 2.2 or 4.1, ASCII or binary, up to 512 "
      "MB) in the plane z = 0, with triangles or quadrilaterals of first "
      "order; its path is relative to the folder of the parameter file, or "
      "else to the working folder. Sides have the numbers or names of its "
      "physical curves. It is read as data; nothing in it is executed. Or a "
      "gmsh script (.geo), which can run commands and write files with your "
      "rights; it is executed only with the option --run-gmsh-script.");
  }

  void
  Geometry::prepare()
  {
    if (dim == 3 && is_axisymmetric())
      throw InputError("Geometry/Symmetry",
                       symmetry.word(),
                       "plane strain, which says nothing in three dimensions",
                       "leave it out, or set Dimension = 2");
    outline.clear();
    sides.clear();
    holes.clear();
    hole_names.clear();
    sides_of_hole.clear();
    if (!where_text.empty())
      {
        check_formula(where_text, "Geometry/Where", FormulaVariables::place);
        where.emplace().prepare(where_text, "Geometry/Where");
      }
    if (shape == Shape::box)
      {
        if (!is_box(box))
          throw InputError("Geometry/Box",
                           text_of_polygon(box),
                           dim == 2 ? "lower left; upper right corner"
                                    : "lowest; highest corner",
                           dim == 2 ? "for a box of 2 m x 2 m: -1, -2; 1, 0"
                                    : "for a cube of 2 m: 0, -2, 0; 2, 0, 2");
        check_coordinates(box, "Geometry/Box");
        outline = outline_of_box(box[0], box[1]);
        sides   = sides_of_box();
      }
    else if (dim == 3 && shape == Shape::polygon)
      throw InputError("Geometry/Shape",
                       shape.word(),
                       "box | discs | file in three dimensions",
                       "mesh other bodies with gmsh; MPM has 'Geometry/Where', "
                       "too");
    else if (shape == Shape::polygon)
      {
        outline = polygon;
        check_polygon(outline, "Geometry/Polygon");
      }
    prepare_sides();
    if (shape == Shape::discs)
      check_discs();
    else if (shape == Shape::file)
      file = existing_file(file,
                           folder_of_parameters,
                           "Geometry/File",
                           "an existing gmsh .msh file");
  }

  void
  Geometry::prepare_sides()
  {
    if (shape == Shape::polygon)
      for (const std::string &name :
           names_of_sides(side_names, outline.size(), "Geometry/Side names"))
        sides.emplace(name, sides.size());
    if (outline.empty() || holes_text.empty())
      return;
    for (const Hole &hole : holes_of(holes_text, outline))
      {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < hole.outline.size(); ++i)
          {
            const unsigned int id = sides.size();
            names.push_back(std::to_string(id));
            sides[names.back()] = id;
          }
        require(sides.count(hole.name) == 0 &&
                  sides_of_hole.emplace(hole.name, names).second,
                "Geometry/Holes",
                hole.name,
                "names that differ from those of other holes and of the sides",
                "rename it");
        holes.push_back(hole.outline);
        hole_names.push_back(hole.name);
      }
  }

  bool
  Geometry::is_script() const
  {
    return shape == Shape::file &&
           std::filesystem::path(file).extension() == ".geo";
  }

  std::string
  Geometry::unit(const std::string &in_plane_strain) const
  {
    std::string text = in_plane_strain;
    if (is_axisymmetric() || dim == 3)
      for (const std::string per : {"_per_m", "/m"})
        if (const std::size_t place = text.rfind(per);
            place != std::string::npos)
          return text.erase(place, per.size());
    return text;
  }

  void
  Geometry::check_radii(const std::vector<dealii::Point<dim>> &vertices,
                        const double                           rounding) const
  {
    if (is_axisymmetric())
      for (const dealii::Point<dim> &x : vertices)
        if (!(x[0] >= -rounding))
          throw InputError("Geometry/Symmetry",
                           symmetry.word(),
                           format("x >= 0, the radius, and there is a vertex "
                                  "at (%g, %g)",
                                  x[0],
                                  x[1]),
                           "put the axis at x = 0 and the body on its right");
  }

  void
  Geometry::refuse_axis(const std::string &who, const std::string &remedy) const
  {
    if (is_axisymmetric())
      throw InputError("Geometry/Symmetry",
                       symmetry.word(),
                       "plane strain with " + who,
                       remedy);
  }

  void
  Geometry::check_discs()
  {
    const std::string values = dealii::Patterns::Tools::to_string(radii);
    if (centres.empty())
      throw InputError("Geometry/Centres",
                       "",
                       "the centre x, y of one disc or more",
                       "for a disc around the origin: 0, 0");
    if (radii.size() == 1)
      radii.resize(centres.size(), radii[0]);
    if (radii.size() != centres.size())
      throw InputError("Geometry/Radii",
                       values,
                       "one radius for all discs, or one for each of the " +
                         std::to_string(centres.size()) + " centres",
                       "give as many as there are centres");
    for (std::size_t i = 0; i < radii.size(); ++i)
      {
        if (!(radii[i] > 0.))
          throw InputError("Geometry/Radii", values, "> 0", "give them in m");
        double farthest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          farthest = std::max(farthest, std::abs(centres[i][d]) + radii[i]);
        if (!(farthest <= largest_coordinate))
          throw InputError(
            "Geometry/Centres",
            text_of_polygon(centres),
            format("discs within %g m of the origin", largest_coordinate),
            "give centres and radii in m");
        if (radii[i] < resolved_length({centres[i]}))
          throw InputError(
            "Geometry/Radii",
            values,
            format(">= %g at the centre ", resolved_length({centres[i]})) +
              text_of_place(centres[i]),
            "put the origin near the body: numbers of 16 "
            "digits hold no small body far away");
        for (std::size_t j = 0; j < i; ++j)
          if (centres[i].distance(centres[j]) <
              (radii[i] + radii[j]) * (1. - 1e-9))
            throw InputError(
              "Geometry/Centres",
              text_of_polygon(centres),
              "centres of discs that do not overlap",
              "the discs " + std::to_string(j) + " and " + std::to_string(i) +
                " overlap: move one of them, or make it smaller");
      }
  }

  std::array<Point<dim>, 2>
  Geometry::side_ends(const dealii::types::boundary_id side) const
  {
    std::size_t i = side;
    for (const Polygon &loop : loops())
      {
        if (i < loop.size())
          {
            std::array<Point<dim>, 2> ends = {
              {loop[i], loop[(i + 1) % loop.size()]}};
            const bool is_outline = i == side;
            if ((signed_area(loop) > 0.) != is_outline)
              std::swap(ends[0], ends[1]);
            return ends;
          }
        i -= loop.size();
      }
    AssertThrow(false, dealii::ExcInternalError());
    return {};
  }

  std::vector<Polygon>
  Geometry::loops() const
  {
    std::vector<Polygon> all = {outline};
    all.insert(all.end(), holes.begin(), holes.end());
    return all;
  }

  bool
  Geometry::contains(const Point<dim> &x) const
  {
    if (where && !(where->value(x, 0.) > 0.))
      return false;
    switch (shape)
      {
        case Shape::file:
          return true;
        case Shape::discs:
          for (std::size_t i = 0; i < centres.size(); ++i)
            if (x.distance(centres[i]) <= radii[i])
              return true;
          return false;
        default:
          return geocone::contains(outline, x) &&
                 std::none_of(
                   holes.begin(), holes.end(), [&](const Polygon &hole) {
                     return geocone::contains(hole, x);
                   });
      }
  }

  std::pair<Point<dim>, Point<dim>>
  Geometry::bounding_box() const
  {
    Assert(shape != Shape::file, dealii::ExcNotImplemented());
    Polygon corners = outline;
    if (shape == Shape::discs)
      for (std::size_t i = 0; i < centres.size(); ++i)
        for (const double r : {-radii[i], radii[i]})
          {
            Point<dim> corner = centres[i];
            for (unsigned int c = 0; c < dim; ++c)
              corner[c] += r;
            corners.push_back(corner);
          }
    std::pair<Point<dim>, Point<dim>> box = {corners[0], corners[0]};
    for (const Point<dim> &x : corners)
      for (unsigned int c = 0; c < dim; ++c)
        {
          box.first[c]  = std::min(box.first[c], x[c]);
          box.second[c] = std::max(box.second[c], x[c]);
        }
    return box;
  }

  double
  Geometry::rounding() const
  {
    const auto [lower, upper] = bounding_box();
    return 1e-9 * lower.distance(upper) +
           4. * std::numeric_limits<double>::epsilon() *
             std::max(lower.norm(), upper.norm());
  }

  double
  Geometry::area() const
  {
    Assert(shape != Shape::file, dealii::ExcNotImplemented());
    if (where)
      return area_of_samples();
    if (shape == Shape::discs)
      {
        double area = 0.;
        for (const double r : radii)
          area += dim == 2 ? pi * r * r : 4. / 3. * pi * r * r * r;
        return area;
      }
    if (dim == 3)
      return dealii::BoundingBox<dim>(outline).volume();
    double area = std::abs(signed_area(outline));
    for (const Polygon &hole : holes)
      area -= std::abs(signed_area(hole));
    return area;
  }

  double
  Geometry::area_of_samples() const
  {
    const auto [lower, upper] = bounding_box();
    const GridIndex   n       = equal_sizes(dim == 2 ? 256 : 40);
    const std::size_t total   = grid_volume(n);
    std::size_t       inside  = 0;
    for (std::size_t i = 0; i < total; ++i)
      {
        const GridIndex index = index_in_grid(i, n);
        Point<dim>      x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = lower[d] + (index[d] + 0.5) / n[d] * (upper[d] - lower[d]);
        inside += contains(x);
      }
    double area = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      area *= upper[d] - lower[d];
    return area * inside / total;
  }

  void
  Geometry::refuse_where(const std::string &who,
                         const std::string &remedy) const
  {
    if (where)
      throw InputError(
        "Geometry/Where", where_text, "empty with " + who, remedy);
  }
} // namespace geocone::GEOCONE_DIM
