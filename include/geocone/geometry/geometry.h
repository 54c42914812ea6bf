// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_geometry_geometry_h
#define geocone_geometry_geometry_h

#include <geocone/base/choice.h>
#include <geocone/base/text_of_place.h>
#include <geocone/base/types.h>
#include <geocone/functions/expression.h>
#include <geocone/laws/material_library.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Vertices of a polygon in order. In three dimensions: the two opposite
   *  corners of a box, with the smallest and the largest coordinates. */
  using Polygon = std::vector<dealii::Point<dim>>;

  Polygon
  outline_of_box(const dealii::Point<dim> &lower,
                 const dealii::Point<dim> &upper);

  /** Names of the six sides of a box, by axis (x, y, z) and end (lower,
   *  upper). */
  constexpr const char *side_of_box[3][2] = {
    {"left", "right"}, {"bottom", "top"}, {"back", "front"}};

  /** Returns the boundary id of each side of a box, by name. The sides left and
   *  right are at the smallest and largest x, bottom and top at the smallest
   *  and largest y, back and front at the smallest and largest z. */
  std::map<std::string, dealii::types::boundary_id>
  sides_of_box();

  /**
   * Largest coordinates and smallest lengths (m) that are resolved in double
   * precision. Coordinates up to 1e12 m have squares and products far from
   * overflow. Lengths are at least 1e-12 m and 1e-9 of the coordinates, whose
   * rounding error is 1e-16 of their magnitude and thus at most 1e-7 of a cell
   * size.
   */
  constexpr double largest_coordinate     = 1e12;
  constexpr double smallest_size          = 1e-12;
  constexpr double smallest_relative_size = 1e-9;

  /** Returns the smallest length (m) resolved in double precision at the
   *  coordinates of @p points. */
  double
  resolved_length(const std::vector<dealii::Point<dim>> &points);

  /**
   * Checks that the coordinates of points are finite and that their differences
   * are resolved in double precision. @throws InputError if a coordinate is not
   * finite or too large, or if the extent of the points along x or y is too
   * small relative to the coordinates
   */
  void
  check_coordinates(const std::vector<dealii::Point<dim>> &points,
                    const std::string                     &parameter);

  /** Returns true if the point x lies inside a polygon (crossing number
   *  algorithm). */
  bool
  contains(const Polygon &polygon, const dealii::Point<dim> &x);

  /** Returns the point nearest to x on the line segment ab. */
  dealii::Point<dim>
  nearest_on_segment(const dealii::Point<dim> &x,
                     const dealii::Point<dim> &a,
                     const dealii::Point<dim> &b);

  /** Returns the distance (m) of the point x from the line segment ab. */
  double
  distance_to_segment(const dealii::Point<dim> &x,
                      const dealii::Point<dim> &a,
                      const dealii::Point<dim> &b);

  /**
   * Checks that a polygon is simple, i.e. does not intersect itself.
   * @throws InputError if it has fewer than three vertices, repeated vertices,
   * no area, or sides that cross or touch
   */
  void
  check_polygon(const Polygon &polygon, const std::string &parameter);

  /** Returns the signed area of a polygon (m^2). The area is positive if the
   *  vertices are in counterclockwise order. */
  double
  signed_area(const Polygon &polygon);

  /** Returns true if the line segments ab and cd intersect within a tolerance
   *  (m). */
  bool
  segments_meet(const dealii::Point<dim> &a,
                const dealii::Point<dim> &b,
                const dealii::Point<dim> &c,
                const dealii::Point<dim> &d,
                const double              tolerance);

  /** Returns the vertices of a polygon as text in the format of the parameter
   *  file, for error messages. */
  std::string
  text_of_polygon(const Polygon &polygon);

  /**
   * Geometry of the body: a box, a polygon, discs, or a mesh from a .msh file
   * or gmsh script. For MPM a formula can restrict the body to the part where
   * the formula is positive. The sides of a box are called bottom, right, top,
   * left; those of a polygon have names or are 0, 1, 2, ... (side i connects
   * vertex i to the next one); the numbers of the sides of holes follow those
   * of the outline; those
   * of a file have the numbers or names of its physical curves; discs have
   * none, and are supported by the material point method only.
   */
  class Geometry : public dealii::ParameterAcceptor
  {
  public:
    enum class Shape
    {
      box,
      polygon,
      discs,
      file
    };

    /** Symmetry of a plane problem: plane strain or axisymmetry. */
    enum class Symmetry
    {
      plane_strain, ///< unit thickness, no displacement along z
      axisymmetric  ///< symmetric about x = 0, no torsion
    };

    explicit Geometry(const ParameterFile &file);

    void
    prepare();

    Choice<Symmetry> symmetry = {{{"plane strain", Symmetry::plane_strain},
                                  {"axisymmetric", Symmetry::axisymmetric}}};

    bool
    is_axisymmetric() const
    {
      return symmetry == Symmetry::axisymmetric;
    }

    /** Returns the factor that converts an area in the plane of the model to a
     *  volume. Lengths are multiplied by the same factor to obtain areas. The
     *  factor is 1 in plane strain (per metre of thickness) and 2 pi r at the
     *  point x in axisymmetry (m). */
    static double
    measure(const Symmetry symmetry, const dealii::Point<dim> &x)
    {
      return symmetry == Symmetry::axisymmetric ? 2. * pi * x[0] : 1.;
    }

    /** Returns the side length (m) of the square or cube represented by a
     *  material point.
     *  @param x position of the material point
     *  @param volume of the material point; in axisymmetry of the ring it
     *  represents */
    double
    size_of_point(const dealii::Point<dim> &x, const double volume) const
    {
      return side_length(volume / measure(symmetry, x));
    }

    /** Converts a unit for plane strain to the unit for the current problem,
     *  i.e. without "per metre of thickness" in axisymmetric and
     *  three-dimensional problems. In axisymmetry, units are not per metre of
     *  thickness.
     *  @param in_plane_strain unit in plane strain, e.g. "N/m" or "load (N/m)"
     *  or "energy_J_per_m" */
    std::string
    unit(const std::string &in_plane_strain) const;

    /** Rejects vertices at a negative radius of an axisymmetric body. @throws
     *  InputError @param rounding largest accepted distance beyond the axis (m) */
    void
    check_radii(const std::vector<dealii::Point<dim>> &vertices,
                const double                           rounding = 0.) const;

    /** Rejects axisymmetry. @throws InputError @param who feature that does not
     *  support it
     *  @param remedy e.g. "set ..." */
    void
    refuse_axis(const std::string &who, const std::string &remedy) const;

    Choice<Shape> shape = {{{"box", Shape::box},
                            {"polygon", Shape::polygon},
                            {"discs", Shape::discs},
                            {"file", Shape::file}}};

    /** Vertices of the outer boundary of a box or polygon, in order along the
     *  boundary. Empty for discs and files. */
    Polygon outline;

    /** Holes in the body, as polygons inside the outer boundary. */
    std::vector<Polygon> holes;

    /** Outline and holes. */
    std::vector<Polygon>
    loops() const;

    /** Boundary id of each side of the box or polygon and of the holes, by
     *  name. */
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Name of each hole. */
    std::vector<std::string> hole_names;

    /** Names of the sides of each hole, by name of the hole. */
    std::map<std::string, std::vector<std::string>> sides_of_hole;

    /** Name of the .msh file or gmsh script. */
    std::string file;

    /** True if a command-line option allows the execution of a gmsh script. */
    bool may_run_script = false;

    /** Returns true if the geometry is a gmsh script. The mesh exists only
     *  after gmsh has run the script. */
    bool
    is_script() const;

    /** Returns the two ends of a side of the body or of a hole. The body is on
     *  the left of the line from the first to the second end. */
    std::array<dealii::Point<dim>, 2>
    side_ends(const dealii::types::boundary_id side) const;

    /** Returns true if a formula restricts the body to the part where the
     *  formula is positive. */
    bool
    is_part_by_formula() const
    {
      return where.has_value();
    }

    /** Returns true if the point x lies in the body. Always true for a geometry
     *  from a file, because the mesh defines the body. */
    bool
    contains(const dealii::Point<dim> &x) const;

    /** Returns the lower and the upper corner of the bounding box of the body.
     *  @pre the geometry is not from a file */
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    bounding_box() const;

    /** Returns the length (m) below which distances are treated as zero. It is
     *  1e-9 of the size of the body, but at least the resolution of the
     *  coordinates. @pre the geometry is not from a file */
    double
    rounding() const;

    /** Returns the area (m^2) or volume (m^3) of the body. If a formula
     *  restricts the body, the value is an estimate from sampling points. @pre
     *  the geometry is not from a file */
    double
    area() const;

    /** Rejects a body that is restricted by a formula. @throws InputError
     *  @param who feature that does not support it
     *  @param remedy e.g. "set ..." */
    void
    refuse_where(const std::string &who, const std::string &remedy) const;

  private:
    /** Sets the names of the sides of the outline of a polygon, and holes with
     *  their names and sides. */
    void
    prepare_sides();

    void
    check_discs();

    /** Estimates the area (m^2) or volume (m^3) of the body from points on a
     *  lattice that covers the body. */
    double
    area_of_samples() const;

    const std::string               folder_of_parameters;
    std::string                     where_text;
    std::optional<Expression>       where;
    unsigned int                    dimension = dim;
    std::vector<dealii::Point<dim>> box;
    std::vector<dealii::Point<dim>> polygon;
    std::vector<std::string>        side_names;
    std::string                     holes_text;
    std::vector<dealii::Point<dim>> centres = {dealii::Point<dim>()};
    std::vector<double>             radii   = {1.};
  };
} // namespace geocone::GEOCONE_DIM

#endif
