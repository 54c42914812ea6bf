// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_geometry_regions_h
#define geocone_geometry_regions_h

#include <geocone/base/choice.h>
#include <geocone/geometry/geometry.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Assignment of materials to regions of the body. The region of a material is
   * a polygon, the part of the body below a line, or a physical surface of a
   * .msh file.
   */
  class Regions
  {
  public:
    /** Declares the parameters of the region of each material. @param materials
     *  names of all materials */
    explicit Regions(const std::vector<std::string> &materials);

    /** Checks the regions.
     *  @param may_be_empty whether the region of each material may be empty:
     *  replacements of other materials need no region */
    void
    prepare(const Geometry          &geometry,
            const std::vector<bool> &may_be_empty = {});

    /** Returns true if the region of a material may be empty. */
    bool
    may_be_empty(const unsigned int material) const
    {
      return material == 0 ||
             (material < empty_ones.size() && empty_ones[material]);
    }

    /** Returns the polygons of all materials, for mesh generators. */
    std::vector<Polygon>
    polygons() const;

    /** Returns the polygon of the region of a material. Empty for materials
     *  without a polygon. */
    const Polygon &
    polygon_of(const unsigned int material) const
    {
      return regions[material]->outline;
    }

    /** Returns true if the region of any material is a physical surface of a
     *  .msh file. */
    bool
    have_groups() const;

    /** Checks that the physical surfaces of all materials exist in the mesh
     *  file. @throws InputError if the surface of a material is missing
     *  @param groups numbers and names (possibly empty) of the physical
     *  surfaces */
    void
    check_groups(const std::map<int, std::string> &groups) const;

    /** Returns the index of the material at the point x, for cells outside all
     *  physical surfaces of the .msh file. */
    unsigned int
    material_at(const dealii::Point<dim> &x) const;

    /** Returns the index of the material at the point x, for cells in a
     *  physical surface of the .msh file.
     *  @param group,name number and name of the surface; empty: unnamed */
    unsigned int
    material_at(const dealii::Point<dim> &x,
                const int                 group,
                const std::string        &name) const;

    /** Returns true if the points of a material are fixed quadrature points
     *  instead of moving material points. */
    bool
    are_fixed(const unsigned int material) const
    {
      return regions[material]->points == Points::fixed;
    }

    /** Rejects materials with fixed quadrature points. @throws InputError
     *  @param method name of the method, which moves all points */
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
        return has_group() && (group == std::to_string(number) ||
                               (group == name && !name.empty()));
      }

      std::vector<dealii::Point<dim>> polygon, below;
      std::string                     group = "-1"; ///< number or name
      Polygon        outline; ///< polygon, or the part below the line
      Choice<Points> points = {
        {{"moving", Points::moving}, {"fixed", Points::fixed}}};
    };
    std::vector<std::unique_ptr<Region>> regions;
    std::vector<bool>                    empty_ones; ///< see may_be_empty()
  };
} // namespace geocone::GEOCONE_DIM

#endif
