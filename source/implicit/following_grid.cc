// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/implicit/following_grid.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Position of x when @p from moves to @p to, and @p fixed is fixed. */
    double
    stretched(const double x,
              const double fixed,
              const double from,
              const double to)
    {
      return fixed + (x - fixed) * (to - fixed) / (from - fixed);
    }
  } // namespace

  FollowingGrid::FollowingGrid(const std::string      &name,
                               const Scene            &scene,
                               const MovingConditions &sides,
                               BackgroundMesh         &mesh,
                               Space                  &space)
    : mesh(mesh)
    , space(space)
    , lines(mesh.grid())
  {
    if (lines[0].empty())
      throw InputError(parameter,
                       name,
                       "nothing on a mesh that is no grid of rectangles",
                       "set Mesh/Type = uniform or graded, and Mesh/Cells = "
                       "quadrilaterals");
    std::string known;
    for (const auto &candidate : scene.dirichlet.list)
      if (candidate->imposed_on() == Imposition::On::side)
        {
          known += (known.empty() ? "" : " | ") + candidate->name;
          if (candidate->name == name)
            condition = candidate.get();
        }
    if (condition == nullptr)
      throw InputError(
        parameter,
        name,
        known.empty() ? "a condition with 'Imposed on' = averages | segments"
                      : known,
        "name a condition that is imposed on averages or segments "
        "of a side of the body, or leave it out");
    if (!condition->stages.are_all())
      throw InputError(parameter,
                       name,
                       "a condition that acts in all stages",
                       "leave out '" +
                         condition->parameter(ActingStages::entry) + "'");
    side = sides.box_of(*condition);
  }

  void
  FollowingGrid::follow(const MovingConditions &sides)
  {
    const auto now = sides.box_of(*condition);
    auto       to  = lines;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double begin = lines[d].front(), end = lines[d].back();
        // A segment inside the grid remains inside; a segment at its end
        // remains there.
        const double small = 1e-9 * (end - begin);
        const auto   stays =
          [&](const double from, const double to, const double at) {
            return std::abs(from - at) > small ? (to - at) * (from - at) > 0.
                                               : std::abs(to - at) <= small;
          };
        if (!stays(side.first[d], now.first[d], begin) ||
            !stays(side.second[d], now.second[d], end))
          throw StepFailure(
            "the side of '" + condition->name +
            "', which the grid follows, has reached an end of the grid or left "
            "it\n"
            "  remedy:  enlarge 'Mesh/Box', so that there is room on both "
            "sides "
            "of it, or end the loading earlier");
        for (double &x : to[d])
          if (x < side.first[d])
            x = stretched(x, begin, side.first[d], now.first[d]);
          else if (x > side.second[d])
            x = stretched(x, end, side.second[d], now.second[d]);
          else
            x += now.first[d] - side.first[d];
      }
    mesh.move_grid(to);
    space.follow_grid();
  }
} // namespace geocone::GEOCONE_DIM
