// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_moving_surface_h
#define geocone_surfaces_moving_surface_h

#include <geocone/base/state_row.h>
#include <geocone/surfaces/side_points.h>

#include <array>
#include <functional>
#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Boundary segments that move with the body. The segments, entire or
   * restricted to a box, consist of facets (lines or triangles) whose corners
   * move with the grid velocity. A facet belongs to the soil just behind it: a
   * load acts on it as long as this soil is there.
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

    /** Returns those with soil. */
    std::vector<SidePart>
    facets_with_soil() const;

    /** Returns the initial length (m) or area (m^2) of a facet. */
    double
    size_at_start(const std::size_t facet) const
    {
      return parts[facet].size;
    }

    /** @name Soil behind facets, by the place just behind each one */
    /** @{ */

    /** Removes the soil of facets. @param begin,duration time (s) and duration
     *  of a gradual removal; 0: at once */
    void
    remove(const std::function<bool(const dealii::Point<dim> &)> &goes,
           const double                                           begin,
           const double                                           duration);

    /** Adds the soil of facets that have none. */
    void
    add(const std::function<bool(const dealii::Point<dim> &)> &comes);

    /** Returns the part of the soil behind a facet that is left at time t. */
    double
    part_left(const std::size_t facet, const double t) const;

    bool
    has_soil(const std::size_t facet) const
    {
      return ends[facet] > never;
    }
    /** @} */

    /** Moves the corners of the facets with the grid velocity over a step h
     *  (s), that of the functions with mass; without @p has_mass, of all. Facets
     *  without soil stay. Positions are limited to the box of the mesh.
     *  Collective. */
    void
    move(const BackgroundMesh &mesh,
         const Space          &space,
         const NodesWithMass  &has_mass,
         const Vector         &v,
         const double          h);

    void
    state(StateRow &row)
    {
      row(places, ends, fading);
    }

  private:
    static constexpr double never  = std::numeric_limits<double>::lowest(),
                            always = std::numeric_limits<double>::max();

    /** Facet of a boundary segment, defined by the indices of its corners. */
    struct Part
    {
      std::array<unsigned int, dim> corners;
      double                        size; ///< initial length (m) or area (m^2)
    };
    std::vector<Part>               parts;
    std::vector<dealii::Point<dim>> places; ///< positions of the corners
    std::vector<double>             ends;   ///< of the soil of each facet (s)
    std::vector<double>             fading; ///< duration of its removal (s)
  };
} // namespace geocone::GEOCONE_DIM

#endif
