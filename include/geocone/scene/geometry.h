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
  /** The vertices of a polygon in order; in three dimensions, which know no other
   *  bodies by themselves, the lowest and the highest corner of a box. */
  using Polygon = std::vector<dealii::Point<dim>>;

  Polygon
  outline_of_box(const dealii::Point<dim> &lower,
                 const dealii::Point<dim> &upper);

  /** Names of the sides of a box, by direction and end, the lower one first. */
  constexpr const char *side_of_box[3][2] = {
    {"left", "right"}, {"bottom", "top"}, {"back", "front"}};

  /** The number of each side: those at the least and largest x are called left and
   *  right, y bottom and top, z back and front. */
  std::map<std::string, dealii::types::boundary_id>
  sides_of_box();

  /**
   * What double precision resolves with room for a solution: coordinates up to
   * 1e12 m, whose squares and products stay far from overflow, and lengths of
   * 1e-12 m or more that are 1e-9 of the coordinates or more. A coordinate is
   * rounded by 1e-16 of itself, a cell then by 1e-7 of its size.
   */
  constexpr double largest_coordinate     = 1e12;
  constexpr double smallest_size          = 1e-12;
  constexpr double smallest_relative_size = 1e-9;

  /** The smallest length (m) that is resolved where @p points are. */
  double
  resolved_length(const std::vector<dealii::Point<dim>> &points);

  /**
   * @throws InputError if coordinates are not finite or too large, or if the
   * points reach less far along x or y than their coordinates resolve
   */
  void
  check_coordinates(const std::vector<dealii::Point<dim>> &points,
                    const std::string                     &parameter);

  /** Whether x lies inside a polygon (crossing number). */
  bool
  contains(const Polygon &polygon, const dealii::Point<dim> &x);

  /** The point of the segment ab that is nearest to x. */
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
   * @throws InputError if the polygon has fewer than three vertices, repeated
   * vertices, no area, or sides that cross or touch
   */
  void
  check_polygon(const Polygon &polygon, const std::string &parameter);

  /**
   * The domain: a box, a polygon, discs, or whatever a .msh file (or a script of
   * gmsh) holds; of MPM the part of it where a formula is positive, if one is given. The sides of a box are called bottom, right, top, left; those of
   * a polygon 0, 1, 2, ... (side i runs from vertex i to the next one); those of
   * a file have the numbers or names of its physical curves; discs have none, and
   * only the material point method can fill them.
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

    /** What the plane of the scene is a section of. */
    enum class Symmetry
    {
      plane_strain, ///< a body of unit thickness that does not move along z
      axisymmetric  ///< a round body about x = 0, without torsion
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

    /** What an area or a length of the plane at x stands for, over itself: 1 (m per
     *  metre of thickness), or 2 pi r (m). */
    static double
    measure(const Symmetry symmetry, const dealii::Point<dim> &x)
    {
      return symmetry == Symmetry::axisymmetric ? 2. * pi * x[0] : 1.;
    }

    /** The side of the square, or the cube, of a material point at x (m).
     *  @param volume of it, around the axis of its ring */
    double
    size_of_point(const dealii::Point<dim> &x, const double volume) const
    {
      return length_of(volume / measure(symmetry, x));
    }

    /** A unit, e.g. "N/m" or "load (N/m)" or "energy_J_per_m", without what says "per
     *  metre of thickness" if the body is round. */
    std::string
    unit(const std::string &in_plane_strain) const;

    /** @throws InputError where the scene is around an axis @param who cannot be
     *  @param remedy e.g. "set ..." */
    void
    refuse_axis(const std::string &who, const std::string &remedy) const;

    Choice<Shape> shape = {{{"box", Shape::box},
                            {"polygon", Shape::polygon},
                            {"discs", Shape::discs},
                            {"file", Shape::file}}};

    /** Vertices of the box or polygon, in order; empty for discs and files. */
    Polygon outline;

    /** The number of each named side of the box or polygon. */
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Name of the .msh file, or of the geo script. */
    std::string file;

    /** Whether the file may be a script, which gmsh then runs. */
    bool may_run_script = false;

    /** Whether it is one, whose cells are known when it has run only. */
    bool
    is_script() const;

    /** The ends of a side of the outline: its vertex and the next one. */
    std::array<dealii::Point<dim>, 2>
    side_ends(const dealii::types::boundary_id side) const;

    /** Whether the body is a part of the shape, where a formula is positive. */
    bool
    is_part_by_formula() const
    {
      return where.has_value();
    }

    /** Whether x lies in the body; true for a file, whose cells are the body. */
    bool
    contains(const dealii::Point<dim> &x) const;

    /** Lower left and upper right corner of the body; not for a file. */
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    bounding_box() const;

    /** Lengths that count as zero (m): 1e-9 of the body's size, and at least what its
     *  coordinates resolve; not for a file. */
    double
    rounding() const;

    /** Area or volume of the body (m^2, m^3), of a formula that of samples; not for a
     *  file. */
    double
    area() const;

    /** @throws InputError where a formula tells the body @param who cannot take it
     *  @param remedy e.g. "set ..." */
    void
    refuse_where(const std::string &who, const std::string &remedy) const;

  private:
    void
    check_discs();

    /** That of the points of a lattice which lie in the body. */
    double
    area_of_samples() const;

    const std::string               folder_of_parameters;
    std::string                     where_text;
    std::optional<Expression>       where;
    unsigned int                    dimension = dim;
    std::vector<dealii::Point<dim>> box;
    std::vector<dealii::Point<dim>> polygon;
    std::vector<dealii::Point<dim>> centres = {dealii::Point<dim>()};
    std::vector<double>             radii   = {1.};
  };

  /**
   * Which material fills which part of the domain: per material a polygon, what lies
   * below a line, or a physical surface of a .msh file.
   */
  class Regions
  {
  public:
    /** @param materials their names */
    explicit Regions(const std::vector<std::string> &materials);

    /** @param may_be_empty by material: those that others become, which need no
     *  region */
    void
    prepare(const Geometry          &geometry,
            const std::vector<bool> &may_be_empty = {});

    /** Whether a material may have no part of the body. */
    bool
    may_be_empty(const unsigned int material) const
    {
      return material == 0 ||
             (material < empty_ones.size() && empty_ones[material]);
    }

    /** The polygons, to be respected by mesh generators. */
    std::vector<Polygon>
    polygons() const;

    /** The polygon of a material; empty: it has none. */
    const Polygon &
    polygon_of(const unsigned int material) const
    {
      return regions[material]->outline;
    }

    /** Whether a material is found by a physical surface. */
    bool
    have_groups() const;

    /** @throws InputError if a file has no physical surface of a material
     *  @param groups numbers and names, empty where there is none, of the file */
    void
    check_groups(const std::map<int, std::string> &groups) const;

    /** The material at x, outside of all physical surfaces. */
    unsigned int
    material_at(const dealii::Point<dim> &x) const;

    /** The material at x in a cell of a physical surface.
     *  @param name empty: it has none */
    unsigned int
    material_at(const dealii::Point<dim> &x,
                const int                 group,
                const std::string        &name) const;

    /** Whether the points of a material stay where they are while others move, as
     *  those of finite elements do. */
    bool
    are_fixed(const unsigned int material) const
    {
      return regions[material]->points == Points::fixed;
    }

    /** @throws InputError if a material's points are fixed, with what moves all */
    void
    refuse_fixed(const std::string &method) const;

  private:
    enum class Points
    {
      moving,
      fixed
    };

    class Region : public dealii::ParameterAcceptor
    {
    public:
      explicit Region(const std::string &name);

      void
      prepare(const Geometry &geometry);

      bool
      has_group() const
      {
        return group != "-1";
      }

      bool
      is_group(const int number, const std::string &name) const
      {
        return has_group() &&
               (group == std::to_string(number) || group == name);
      }

      std::vector<dealii::Point<dim>> polygon, below;
      std::string                     group = "-1"; ///< number or name
      Polygon        outline; ///< the polygon, or what lies below the line
      Choice<Points> points = {
        {{"moving", Points::moving}, {"fixed", Points::fixed}}};
    };
    std::vector<std::unique_ptr<Region>> regions;
    std::vector<bool>                    empty_ones; ///< see may_be_empty()
  };
} // namespace geocone::GEOCONE_DIM

#endif
