// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_soil_part_h
#define geocone_points_soil_part_h

#include <geocone/surfaces/side_part.h>
#include <geocone/surfaces/side_points.h>

#include <deal.II/base/bounding_box.h>

#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Fraction of a cell's size that counts as zero. */
  inline constexpr double negligible_part = 1e-9;

  /** Part of a fixed boundary that is normal to a coordinate axis and has soil
   *  on one side. */
  struct SoilLimit
  {
    unsigned int             axis;
    double                   level;         ///< coordinate along the axis (m)
    bool                     soil_is_below; ///< soil at smaller coordinates
    dealii::BoundingBox<dim> extent;        ///< its thickness is irrelevant
  };

  /** Lower and upper corner of a box. */
  using Corners = std::pair<dealii::Point<dim>, dealii::Point<dim>>;

  /** Facet of a loaded side, with an axis along which it limits the soil. */
  struct LoadedFacet
  {
    SidePart                 part;
    unsigned int             axis = 0;
    bool                     soil_is_below;
    dealii::BoundingBox<dim> extent;

    LoadedFacet(const SidePart &part, const unsigned int axis)
      : part(part)
      , axis(axis)
      , soil_is_below(area_of(part)[axis] > 0.)
      , extent(part.corners)
    {}

    /** Facet along the axis to which it is nearly normal. */
    explicit LoadedFacet(const SidePart &part);

    /** Returns true if it acts on a cell along a direction: over the
     *  cross-section, at most one cell away. */
    bool
    is_near(const dealii::BoundingBox<dim> &cell,
            const unsigned int              along) const;

    double
    projected_area() const
    {
      return std::abs(area_of(part)[axis]);
    }

    /** Returns true if it slopes by less than a fiftieth, up to which the mean
     *  level of a side is taken at the edge of another one. */
    bool
    is_nearly_normal_to_axis() const;
  };

  /** Known boundaries of the soil. */
  struct KnownBoundary
  {
    std::vector<SoilLimit>   limits;
    std::vector<LoadedFacet> loaded;
  };

  /** Part of a cell that can be soil: a box, or its part up to loaded facets
   *  along one axis. */
  struct SoilPart
  {
    Corners                  box;
    std::vector<LoadedFacet> top = {}; ///< inside the box

    /** Volume, or area in two dimensions. */
    double
    volume() const;

    /** Height of a position on a facet above the end of the box on the
     *  soil's side. */
    double
    height(const LoadedFacet &facet, const dealii::Point<dim> &x) const
    {
      return facet.soil_is_below ? x[facet.axis] - box.first[facet.axis]
                                 : box.second[facet.axis] - x[facet.axis];
    }

    /** Quadrature points and weights, n in each direction of a box. */
    std::vector<std::pair<dealii::Point<dim>, double>>
    quadrature(const unsigned int n) const;
  };

  /**
   * Finds the part of a cell on the soil's side of all boundaries. The part below
   * a loaded side is exact where its facets cover the cross-section of the cell
   * along an axis, with the soil on one side; at a convex edge of loaded sides
   * along the axes, it is the part up to their mean levels. Other facets limit
   * nothing.
   */
  SoilPart
  soil_part(const dealii::BoundingBox<dim> &cell,
            const KnownBoundary            &boundary);
} // namespace geocone::GEOCONE_DIM

#endif
