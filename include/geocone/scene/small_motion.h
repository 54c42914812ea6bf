// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_small_motion_h
#define geocone_scene_small_motion_h

#include <geocone/scene/scene.h>

#include <deal.II/base/bounding_box.h>

#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** The vertices of faces, of each a list. */
  using VerticesOfFaces = std::vector<std::vector<dealii::Point<dim>>>;

  /**
   * The time in which a part of the boundary that is pushed moves by a thousandth
   * of its length (s): the least of all of them at their greatest speed, or 0 if
   * nothing is pushed. The length is that of the part which the condition selects, and
   * twice it where it ends in a plane of symmetry; of an obstacle its width, or that
   * of the body.
   * @param mesh its box, which is that of a body from a file
   * @param faces_of the vertices of the faces on a condition's sides, of all ranks
   */
  double
  time_of_small_motion(
    const Scene                                                     &scene,
    const dealii::BoundingBox<dim>                                  &mesh,
    const std::function<VerticesOfFaces(const BoundaryCondition &)> &faces_of);
} // namespace geocone::GEOCONE_DIM

#endif
