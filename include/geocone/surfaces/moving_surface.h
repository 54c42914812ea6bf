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
   * Boundary segments of a body, or their parts in a box, that move with it.
   * They consist of facets, lines or triangles, with corners that move with the
   * velocity of the grid.
   */
  class MovingSurface
  {
  public:
    /**
     * @param panels of the body
     * @param longest edge length of facets into which panels are divided; in
     * space of a parallelogram, which is halved into two (m)
     */
    MovingSurface(const std::vector<SidePart> &panels, const double longest);

    /** Facets in their current positions. */
    std::vector<SidePart>
    facets() const;

    /** Initial size of a facet (m, or m^2). */
    double
    size_at_start(const std::size_t facet) const
    {
      return parts[facet].size;
    }

    /** Moves the corners over a step h, within the box of a grid.
     *  Collective. */
    void
    move(const BackgroundMesh &mesh,
         const Space          &space,
         const Vector         &v,
         const double          h);

    void
    state(StateRow &row)
    {
      row(places);
    }

  private:
    /** A facet. */
    struct Part
    {
      std::array<unsigned int, dim> corners;
      double                        size; ///< at the start
    };
    std::vector<Part>               parts;
    std::vector<dealii::Point<dim>> places; ///< of the corners
  };
} // namespace geocone::GEOCONE_DIM

#endif
