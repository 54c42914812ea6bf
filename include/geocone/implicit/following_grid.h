// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_following_grid_h
#define geocone_implicit_following_grid_h

#include <geocone/conditions/moving_conditions.h>
#include <geocone/space/space.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * A tensor grid that goes with a side that is pushed: between steps its lines
   * move, its state being on the points only. Along each axis the lines across the
   * side go with it, those beyond are stretched or pressed together between the
   * side and the ends of the grid, which stay:
   *   x_l = b + (x_l^0 - b) (s - b)/(s^0 - b)
   * for a line below the side, from the end b of the grid and the places s^0 and s of the
   * side at the start and now; above alike. What places lines is where the side is,
   * and nothing else: the grid has no history.
   */
  class FollowingGrid
  {
  public:
    /** @throws InputError for a mesh that is no grid, or a condition that holds no
     *  side that moves */
    FollowingGrid(const std::string      &condition,
                  const Scene            &scene,
                  const MovingConditions &sides,
                  BackgroundMesh         &mesh,
                  Space                  &space);

    /** Moves the lines to where the side is. @throws StepFailure at the end of the
     *  grid */
    void
    follow(const MovingConditions &sides);

    /** The name of the parameter. */
    static constexpr const char *parameter =
      "Material point method/Grid follows";

  private:
    BackgroundMesh                                   &mesh;
    Space                                            &space;
    const BoundaryCondition                          *condition = nullptr;
    const std::array<std::vector<double>, dim>        lines; ///< at the start
    std::pair<dealii::Point<dim>, dealii::Point<dim>> side;  ///< at the start
  };
} // namespace geocone::GEOCONE_DIM

#endif
