// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/mesh_parameters.h>
#include <geocone/mesh/structured_mesh.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    const UsedWhere used_mesh_parameters[] = {
      {"Mesh/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Mesh/Box", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Box", "Discretisation/Method", {"MPM", "explicit MPM"}},
      {"Mesh/Cells", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Diagonals", "Mesh/Type", {"uniform", "graded"}},
      {"Mesh/Diagonals", "Discretisation/Method", {"FEM"}},
      {"Mesh/Cell size", "Geometry/Shape", {"box", "polygon", "discs"}},
      {"Mesh/Cell size",
       "Mesh/Type",
       {"uniform", "unstructured", "from the bounds"}},
      {"Mesh/Grading points",
       "Mesh/Type",
       {"graded", "unstructured", "from the bounds"}},
      {"Mesh/Smallest size",
       "Mesh/Type",
       {"graded", "unstructured", "from the bounds"}},
      {"Mesh/Largest size",
       "Mesh/Type",
       {"graded", "unstructured", "from the bounds"}},
      {"Mesh/Growth factor", "Mesh/Type", {"graded"}},
      {"Mesh/Size ratio", "Mesh/Type", {"unstructured", "from the bounds"}},
      {"Mesh/Number of cells", "Mesh/Type", {"from the bounds"}},
      {"Mesh/Gmsh algorithm",
       "Mesh/Type",
       {"unstructured", "from the bounds"}}};
  } // namespace

  MeshParameters::MeshParameters()
    : dealii::ParameterAcceptor("/Mesh")
  {
    type.declare(*this,
                 "Type",
                 ". Uniform and graded: for boxes. Unstructured: by gmsh. From "
                 "the bounds: by gmsh, with cell sizes from a limit analysis "
                 "of the scene, of which the mesh of a .msh file is the first "
                 "one. All others are without effect if the domain is a .msh "
                 "file.");
    add_parameter(
      "Box",
      box,
      "MPM: lower left and upper right corner x, y; x, y [m] of the background "
      "mesh, with room for the motion of the body. Unstructured meshes have "
      "edges along the boundary of the body. Empty: bounding box of the body, "
      "or the body itself for an unstructured mesh.");
    cells.declare(
      *this,
      "Cells",
      dim == 2 ? ". Automatic: triangles for FEM, quadrilaterals for MPM."
               : ". Boxes have hexahedra; mesh files have their own cells.");
    diagonals.declare(
      *this,
      "Diagonals",
      ": division of the rectangles of uniform and graded meshes into "
      "triangles. Alternating and parallel: two triangles; crossed: four.");
    add_parameter("Cell size",
                  cell_size,
                  "Cell size of a uniform mesh [m], rounded to a whole number "
                  "of cells; without grading points also of an unstructured "
                  "mesh, and of the first mesh from the bounds.");
    add_parameter("Grading points",
                  grading_points,
                  "Points x, y; x, y; ... [m] around which graded and "
                  "unstructured meshes are refined. Each becomes a vertex.");
    add_parameter(
      "Smallest size", smallest, "Cell size at the grading points [m].");
    add_parameter("Largest size", largest, "Largest cell size [m].");
    add_parameter(
      "Growth factor",
      growth,
      "Graded meshes: size ratio of a cell to its smaller neighbour [-], > 1.");
    add_parameter("Size ratio",
                  size_ratio,
                  "Unstructured meshes: ratio of the cell size to the distance "
                  "from the nearest grading point [-], > 0.");
    add_parameter("Number of cells",
                  number,
                  "Mesh from the bounds: approximate number of triangles.");
    add_parameter(
      "Gmsh algorithm",
      algorithm,
      "2D algorithm of gmsh: 5 Delaunay, 6 frontal-Delaunay, 1 MeshAdapt.");
  }

  void
  MeshParameters::choose_outline(const Geometry &geometry, const Method &method)
  {
    fits_body = !method.is_mpm() || (is_unstructured() && box.empty() &&
                                     geometry.shape != Geometry::Shape::discs);
    if (fits_body)
      {
        // Particles move into holes.
        outline                           = geometry.outline;
        (method.is_mpm() ? inner : holes) = geometry.holes;
        return;
      }
    if (is_unstructured() && !geometry.outline.empty())
      inner = geometry.loops();
    const auto [lower, upper] = geometry.bounding_box();
    if (box.empty())
      box = {lower, upper};
    if (box.size() == 2)
      check_coordinates(box, "Mesh/Box");
    const double tolerance = geometry.rounding();
    bool         is_around = box.size() == 2;
    for (unsigned int c = 0; c < dim && is_around; ++c)
      is_around =
        box[0][c] <= lower[c] + tolerance && box[1][c] >= upper[c] - tolerance;
    if (!is_around)
      throw InputError("Mesh/Box",
                       dealii::Patterns::Tools::to_string(box),
                       "lower left; upper right corner of a box around the "
                       "body",
                       "the body reaches from " +
                         dealii::Patterns::Tools::to_string(lower) + " to " +
                         dealii::Patterns::Tools::to_string(upper));
    outline = outline_of_box(box[0], box[1]);
  }

  void
  MeshParameters::check_mesh_from_bounds(const Geometry &geometry,
                                         const Method   &method) const
  {
    const std::string remedy =
      "meshes from the bounds are those of plane scenes: set "
      "Mesh/Type = unstructured";
    if (dim == 3)
      throw InputError("Mesh/Type",
                       type.word(),
                       "another type with Geometry/Dimension = 3",
                       remedy);
    geometry.refuse_axis("'Mesh/Type' = " + std::string(type.word()), remedy);
    // Its mesh covers the holes, whose bounds would be those of a full body.
    if (method.is_mpm() && !geometry.holes.empty())
      throw InputError("Mesh/Type",
                       type.word(),
                       "another type with MPM and Geometry/Holes",
                       "set Mesh/Type = unstructured");
    const bool is_file = geometry.shape == Geometry::Shape::file;
    if (geometry.shape == Geometry::Shape::discs || method.is_explicit() ||
        (method.is_mpm() && (is_file || !box.empty())))
      throw InputError(
        "Mesh/Type",
        type.word(),
        "a mesh of the body, a box or a polygon, for FEM "
        "and implicit MPM without Mesh/Box, or of a file for FEM",
        "set Mesh/Type = unstructured");
    if (cells == Cells::quadrilaterals)
      throw InputError("Mesh/Cells",
                       cells.word(),
                       "triangles where the mesh is from the bounds",
                       "set Mesh/Cells = triangles");
    if (number < 20 || number > 200000)
      throw InputError(
        "Mesh/Number of cells", number, "20 to 200000", "1500 are usual");
  }

  void
  MeshParameters::choose_cells(const Geometry &geometry, const Method &method)
  {
    if (type == Type::from_bounds)
      cells = Cells::triangles;
    if (dim == 3 && geometry.shape != Geometry::Shape::file)
      {
        const Cells only =
          is_unstructured() ? Cells::triangles : Cells::quadrilaterals;
        if (cells != Cells::automatic && cells != only)
          throw InputError(
            "Mesh/Cells",
            cells.word(),
            "automatic: tetrahedra for Mesh/Type = unstructured, "
            "hexahedra for the others",
            "set Mesh/Cells = automatic");
        cells = only;
      }
    if (cells == Cells::automatic)
      cells = method.is_mpm() ? Cells::quadrilaterals : Cells::triangles;
  }

  void
  MeshParameters::check_numbers() const
  {
    const auto positive = [](const std::string &entry, const double value) {
      if (!(value > 0.))
        throw InputError("Mesh/" + entry, value, "> 0", "give it in m");
    };
    positive("Cell size", cell_size);
    positive("Smallest size", smallest);
    positive("Largest size", largest);
    positive("Size ratio", size_ratio);
    if (algorithm == 8) // gmsh 4.8 crashes for any domain
      throw InputError("Mesh/Gmsh algorithm",
                       algorithm,
                       "1 to 7, 9, 11: gmsh's frontal algorithm for "
                       "quadrilaterals ends with a segmentation fault where "
                       "sizes are given by a field",
                       "take 5 or 6; 'Mesh/Cells = quadrilaterals' recombines "
                       "their triangles");
    if (largest < smallest)
      throw InputError("Mesh/Largest size",
                       largest,
                       ">= the smallest size",
                       "exchange the two");
    if (type == Type::graded && !(growth > 1.))
      throw InputError("Mesh/Growth factor",
                       growth,
                       "> 1",
                       "1.3 is usual; for equal cells take a uniform mesh");
  }

  void
  MeshParameters::check_grading_points(const Geometry &geometry) const
  {
    if (type == Type::graded && grading_points.empty())
      throw InputError("Mesh/Grading points",
                       "",
                       "one or more points for a graded mesh",
                       "give e.g. the edge of the footing: 0.1, 0");
    std::vector<Polygon> loops = {outline};
    loops.insert(loops.end(), holes.begin(), holes.end());
    if (geometry.shape != Geometry::Shape::file)
      for (const Point<dim> &x : grading_points)
        {
          double distance = 1e300;
          bool   is_in    = contains(outline, x);
          for (const Polygon &hole : holes)
            is_in = is_in && !contains(hole, x);
          for (const Polygon &loop : loops)
            for (std::size_t i = 0; i < loop.size() && dim == 2; ++i)
              distance = std::min(
                distance,
                distance_to_segment(x, loop[i], loop[(i + 1) % loop.size()]));
          if (distance > geometry.rounding() && !is_in)
            throw InputError("Mesh/Grading points",
                             dealii::Patterns::Tools::to_string(x),
                             "points of the domain",
                             "move it into the domain or onto its border");
        }
  }

  void
  MeshParameters::prepare(const Geometry &geometry, const Method &method)
  {
    if (type == Type::from_bounds)
      check_mesh_from_bounds(geometry, method);
    choose_cells(geometry, method);
    check_numbers();
    if (geometry.shape == Geometry::Shape::discs && !method.is_mpm())
      throw InputError("Geometry/Shape",
                       "discs",
                       "box | polygon | file with FEM",
                       "set Discretisation/Method = MPM, or mesh the discs "
                       "with gmsh");
    if (!method.is_mpm())
      geometry.refuse_where("FEM",
                            "set Discretisation/Method = MPM, or mesh the body "
                            "with gmsh");
    if (geometry.shape != Geometry::Shape::file)
      choose_outline(geometry, method);
    if (!is_unstructured() && !method.is_mpm() &&
        geometry.shape == Geometry::Shape::polygon)
      throw InputError("Mesh/Type",
                       type.word(),
                       "unstructured, where the domain is a polygon",
                       "set Mesh/Type = unstructured");
    if (!is_unstructured() && !method.is_mpm() && !geometry.holes.empty())
      throw InputError("Mesh/Type",
                       type.word(),
                       "unstructured, where the domain has holes",
                       "set Mesh/Type = unstructured");
    check_grading_points(geometry);
    if (geometry.shape != Geometry::Shape::file)
      check_sizes();
  }

  void
  MeshParameters::check_sizes() const
  {
    const double resolved   = resolved_length(outline);
    const bool   by_grading = type == Type::graded || !grading_points.empty();
    const bool   uniform    = type == Type::uniform || !by_grading;
    const std::string entry = uniform ? "Mesh/Cell size" : "Mesh/Smallest size";
    const double      size  = uniform ? cell_size : smallest;
    if (size < resolved)
      throw InputError(
        entry,
        size,
        format(">= %g at the coordinates of the domain", resolved),
        "take larger cells, or put the origin nearer to the "
        "body: double precision resolves no smaller cells there");
    double n_cells;
    if (is_unstructured())
      n_cells = unstructured_size(*this);
    else
      {
        const std::array<double, dim> n = grid_size(*this);
        n_cells                         = 1.;
        for (const double intervals : n)
          n_cells *= intervals;
        n_cells *= (cells == Cells::quadrilaterals    ? 1.
                    : diagonals == Diagonals::crossed ? 4.
                                                      : 2.);
      }
    // Unknowns have 32-bit indices.
    constexpr double most_cells = 1e8;
    if (!(n_cells <= most_cells))
      throw InputError(entry,
                       size,
                       format("sizes that give up to %g cells; these would "
                              "give about %.3g",
                              most_cells,
                              n_cells),
                       uniform ? std::string("take larger cells")
                               : "raise it, or 'Mesh/Largest size', or " +
                                   std::string(type == Type::graded
                                                 ? "'Mesh/Growth factor'"
                                                 : "'Mesh/Size ratio'"));
  }
} // namespace geocone::GEOCONE_DIM
