// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_geometry_h
#define geocone_scene_geometry_h

#include <geocone/base/choice.h>
#include <geocone/base/text_of_place.h>
#include <geocone/base/types.h>
#include <geocone/functions/expression.h>
#include <geocone/materials/material_library.h>

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
  /** Vertices of a polygon in order; in three dimensions the lowest and the
   *  highest corner of a box, the only predefined shape. */
  using Polygon = std::vector<dealii::Point<dim>>;

  Polygon
  outline_of_box(const dealii::Point<dim> &lower,
                 const dealii::Point<dim> &upper);

  /** Names of the sides of a box, by axis and end (lower, upper). */
  constexpr const char *side_of_box[3][2] = {
    {"left", "right"}, {"bottom", "top"}, {"back", "front"}};

  /** Boundary id of each side of a box: left and right are the sides at the
   *  smallest and largest x, bottom and top at the smallest and largest y, back
   *  and front at the smallest and largest z. */
  std::map<std::string, dealii::types::boundary_id>
  sides_of_box();

  /**
   * Limits of coordinates and lengths that double precision resolves with a
   * margin for the solution: coordinates up to 1e12 m, whose squares and
   * products are far from overflow, and lengths of at least 1e-12 m and 1e-9 of
   * the coordinates. The rounding error of coordinates is 1e-16 of their
   * magnitude, and thus at most 1e-7 of a cell size.
   */
  constexpr double largest_coordinate     = 1e12;
  constexpr double smallest_size          = 1e-12;
  constexpr double smallest_relative_size = 1e-9;

  /** Smallest resolved length (m) at the coordinates of @p points. */
  double
  resolved_length(const std::vector<dealii::Point<dim>> &points);

  /**
   * Checks the coordinates of points. @throws InputError if they are not finite
   * or too large, or if the extent of the points along x or y is not resolved
   * by their coordinates
   */
  void
  check_coordinates(const std::vector<dealii::Point<dim>> &points,
                    const std::string                     &parameter);

  /** Whether x lies inside a polygon (crossing number). */
  bool
  contains(const Polygon &polygon, const dealii::Point<dim> &x);

  /** Point of the segment ab nearest to x. */
  dealii::Point<dim>
  nearest_on_segment(const dealii::Point<dim> &x,
                     const dealii::Point<dim> &a,
                     const dealii::Point<dim> &b);

  /** Distance of x from the segment ab (m). */
  double
  distance_to_segment(const dealii::Point<dim> &x,
                      const dealii::Point<dim> &a,
                      const dealii::Point<dim> &b);

  /**
   * Checks the vertices of a polygon. @throws InputError if it has fewer than
   * three vertices, repeated vertices, no area, or sides that cross or touch
   */
  void
  check_polygon(const Polygon &polygon, const std::string &parameter);

  /** Area of a polygon (m^2), positive if its vertices are counterclockwise. */
  double
  signed_area(const Polygon &polygon);

  /** Whether two sides, ab and cd, meet within a tolerance (m). */
  bool
  segments_meet(const dealii::Point<dim> &a,
                const dealii::Point<dim> &b,
                const dealii::Point<dim> &c,
                const dealii::Point<dim> &d,
                const double              tolerance);

  /** Vertices as in a parameter file, for messages. */
  std::string
  text_of_polygon(const Polygon &polygon);

  /**
   * The domain: a box, a polygon, discs, or the content of a .msh file (or of a
   * gmsh script); for MPM optionally only its part with a positive formula. The
   * sides of a box are called bottom, right, top, left; those of a polygon 0,
   * 1, 2, ... (side i connects vertex i to the next one); the numbers of the
   * sides of holes follow those of the outline; those of a file have
   * the numbers or names of its physical curves; discs have none, and are
   * supported by the material point method only.
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

    /** Symmetry of a plane scene: plane strain or axisymmetry. */
    enum class Symmetry
    {
      plane_strain, ///< a body of unit thickness that does not move along z
      axisymmetric  ///< axisymmetric about x = 0, without torsion
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

    /** Factor from areas and lengths in the plane to volumes and areas, at x: 1
     *  in plane strain (per metre of thickness), 2 pi r in axisymmetry (m). */
    static double
    measure(const Symmetry symmetry, const dealii::Point<dim> &x)
    {
      return symmetry == Symmetry::axisymmetric ? 2. * pi * x[0] : 1.;
    }

    /** Side length of the square or cube of a material point at x (m).
     *  @param volume of the point; in axisymmetry of the ring it represents */
    double
    size_of_point(const dealii::Point<dim> &x, const double volume) const
    {
      return length_of(volume / measure(symmetry, x));
    }

    /** Unit of a quantity, e.g. "N/m" or "load (N/m)" or "energy_J_per_m",
     *  without "per metre of thickness" in axisymmetry. */
    std::string
    unit(const std::string &in_plane_strain) const;

    /** Rejects axisymmetry. @throws InputError @param who feature that does not
     *  support it
     *  @param remedy e.g. "set ..." */
    void
    refuse_axis(const std::string &who, const std::string &remedy) const;

    Choice<Shape> shape = {{{"box", Shape::box},
                            {"polygon", Shape::polygon},
                            {"discs", Shape::discs},
                            {"file", Shape::file}}};

    /** Vertices of the box or polygon, in order; empty for discs and files. */
    Polygon outline;

    /** Polygons inside the outline that are no part of the body. */
    std::vector<Polygon> holes;

    /** Outline and holes. */
    std::vector<Polygon>
    loops() const;

    /** Number of each named side of the box or polygon, and of its holes. */
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Names of the sides of each hole: "hole 0", "hole 1", ... */
    std::map<std::string, std::vector<std::string>> sides_of_hole;

    /** Name of the .msh file or the geo script. */
    std::string file;

    /** Whether the command line allows gmsh to run a script. */
    bool may_run_script = false;

    /** Whether the file is a gmsh script, whose mesh does not exist before gmsh
     *  has run. */
    bool
    is_script() const;

    /** Ends of a side of the outline or of a hole, with the body to the left. */
    std::array<dealii::Point<dim>, 2>
    side_ends(const dealii::types::boundary_id side) const;

    /** Whether the body is the part of the shape where a formula is
     *  positive. */
    bool
    is_part_by_formula() const
    {
      return where.has_value();
    }

    /** Whether x lies in the body; always true for a file, because the mesh
     *  defines the body. */
    bool
    contains(const dealii::Point<dim> &x) const;

    /** Lower left and upper right corner of the bounding box of the body. @pre
     *  the body is not from a file */
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    bounding_box() const;

    /** Length (m) below which distances are treated as zero: 1e-9 of the body's
     *  size, but at least the resolution of its coordinates. @pre the body is
     *  not from a file */
    double
    rounding() const;

    /** Area or volume of the body (m^2, m^3); by sampling if a formula
     *  restricts the body. @pre the body is not from a file */
    double
    area() const;

    /** Rejects a body restricted by a formula. @throws InputError @param who
     *  feature that does not support it
     *  @param remedy e.g. "set ..." */
    void
    refuse_where(const std::string &who, const std::string &remedy) const;

  private:
    void
    check_discs();

    /** Area or volume of the body from sampling points on a lattice (m^2,
     *  m^3). */
    double
    area_of_samples() const;

    const std::string               folder_of_parameters;
    std::string                     where_text;
    std::optional<Expression>       where;
    unsigned int                    dimension = dim;
    std::vector<dealii::Point<dim>> box;
    std::vector<dealii::Point<dim>> polygon;
    std::string                     holes_text;
    std::vector<dealii::Point<dim>> centres = {dealii::Point<dim>()};
    std::vector<double>             radii   = {1.};
  };
} // namespace geocone::GEOCONE_DIM

#endif
