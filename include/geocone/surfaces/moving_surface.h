// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_moving_surface_h
#define geocone_surfaces_moving_surface_h

#include <geocone/base/state_row.h>
#include <geocone/surfaces/side_points.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary segments that move with the body. The segments, entire or
   * restricted to a box, consist of facets (lines or triangles) whose corners
   * move with the grid velocity.
   */
  class MovingSurface
  {
  public:
    /**
     * Divides boundary segments into facets.
     * @param panels boundary segments of the body
     * @param longest maximum edge length of facets (m); in three dimensions of
     * parallelograms, each of which is divided into two facets
     */
    MovingSurface(const std::vector<SidePart> &panels, const double longest);

    /** Returns the facets at their current positions. */
    std::vector<SidePart>
    facets() const;

    /** Returns the initial length (m) or area (m^2) of a facet. */
    double
    size_at_start(const std::size_t facet) const
    {
      return parts[facet].size;
    }

    /** Moves the corners of the facets with the grid velocity over a step h
     *  (s), that of the functions with mass; without @p has_mass, of all.
     *  Positions are limited to the box of the mesh. Collective. */
    void
    move(const BackgroundMesh &mesh,
         const Space          &space,
         const NodesWithMass  &has_mass,
         const Vector         &v,
         const double          h);

    void
    state(StateRow &row)
    {
      row(places);
    }

  private:
    /** Facet of a boundary segment, defined by the indices of its corners. */
    struct Part
    {
      std::array<unsigned int, dim> corners;
      double                        size; ///< initial length (m) or area (m^2)
    };
    std::vector<Part>               parts;
    std::vector<dealii::Point<dim>> places; ///< positions of the corners
  };
} // namespace geocone::GEOCONE_DIM

#endif
