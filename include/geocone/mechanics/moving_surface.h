// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_moving_surface_h
#define geocone_mechanics_moving_surface_h

#include <geocone/base/state_row.h>
#include <geocone/mechanics/panel.h>

#include <array>
#include <functional>
#include <vector>

namespace geocone
{
  /**
   * Sides of a body that is a box in three dimensions, or their parts in a box, that move
   * with it: triangles whose corners are carried by the velocity of the nodes.
   */
  class MovingSurface
  {
  public:
    /**
     * @param condition gives the sides of the body, and the box
     * @param longest edge of what is halved into triangles (m)
     * @throws InputError if the body is no box, has no such side or it misses the box
     */
    MovingSurface(const BoundaryCondition &condition,
                  const Geometry          &geometry,
                  const double             longest);

    struct Triangle
    {
      std::array<unsigned int, 3>
             corners; ///< counterclockwise, seen from outside
      double area;    ///< at the start (m^2)
    };

    /** Its outward normal as it is, times its area (m^2). */
    dealii::Tensor<1, dim>
    area_of(const Triangle &triangle) const;

    /** Of each triangle, as it is. */
    std::vector<dealii::Point<dim>>
    middles() const;

    /** See for_each_point_of_triangles(). */
    std::vector<double>
    for_each_point(const BackgroundMesh                             &mesh,
                   const Space                                      &space,
                   const std::function<void(const Triangle &,
                                            const BoundaryPoint &)> &f) const;

    /** Moves the corners over a step h, within the box of a grid. Collective. */
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

    std::vector<Triangle>           triangles;
    std::vector<dealii::Point<dim>> places; ///< of the corners
  };
} // namespace geocone

#endif
