// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_following_grid_h
#define geocone_implicit_following_grid_h

#include <geocone/conditions/moving_conditions.h>
#include <geocone/space/space.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Tensor-product grid whose lines follow a moving boundary segment. The grid
   * lines move between steps; the state is stored at the material points only.
   * Along each axis, the lines at the segment move with the segment; the other
   * lines are stretched or compressed between the segment and the fixed ends of
   * the grid:
   *   x_l = b + (x_l^0 - b) (s - b)/(s^0 - b)
   * for a line below the segment, with the end b of the grid and the initial
   * and current positions s^0 and s of the segment; above likewise. The lines
   * depend only on the current position of the segment, not on the history.
   */
  class FollowingGrid
  {
  public:
    /** Selects the boundary segment that the grid follows. @throws InputError
     *  for a mesh that is not a tensor-product grid, or a boundary condition
     *  without a moving segment */
    FollowingGrid(const std::string      &condition,
                  const Scene            &scene,
                  const MovingConditions &sides,
                  BackgroundMesh         &mesh,
                  Space                  &space);

    /** Moves the grid lines to the current position of the boundary segment.
     *  @throws StepFailure if the segment reaches the end of the grid */
    void
    follow(const MovingConditions &sides);

    /** Name of the input parameter that selects the boundary condition of the
     *  followed segment. */
    static constexpr const char *parameter =
      "Material point method/Grid follows";

  private:
    BackgroundMesh                                   &mesh;
    Space                                            &space;
    const BoundaryCondition                          *condition = nullptr;
    const std::array<std::vector<double>, dim>        lines; ///< initial lines
    std::pair<dealii::Point<dim>, dealii::Point<dim>> side; ///< initial segment
  };
} // namespace geocone::GEOCONE_DIM

#endif
