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
  /** Lists of the vertices of faces. */
  using VerticesOfFaces = std::vector<std::vector<dealii::Point<dim>>>;

  /**
   * Time in which a loaded part of the boundary moves by a thousandth of its
   * length (s): the minimum over all parts at their greatest speed, or 0 if
   * there are none. The length is that of the part selected by the condition,
   * doubled if it ends in a plane of symmetry; for an obstacle, its width or
   * that of the body.
   * @param mesh its box, which is that of a body from a file
   * @param faces_of vertices of the faces on a condition's sides, of all ranks
   */
  double
  time_of_small_motion(
    const Scene                                                     &scene,
    const dealii::BoundingBox<dim>                                  &mesh,
    const std::function<VerticesOfFaces(const BoundaryCondition &)> &faces_of);
} // namespace geocone::GEOCONE_DIM

#endif
