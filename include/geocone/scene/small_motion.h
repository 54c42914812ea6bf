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
  /** List of faces, each as a list of its vertices. */
  using VerticesOfFaces = std::vector<std::vector<dealii::Point<dim>>>;

  /**
   * Returns the time (s) in which a loaded part of the boundary moves by a
   * thousandth of its length at its maximum speed. The time is the minimum over
   * all loaded parts, 0 without loaded parts. For a boundary condition the
   * length is the extent of the selected part, doubled if it ends in a plane of
   * symmetry; for an obstacle, the width of the obstacle or of the body.
   * @param mesh bounding box of the mesh, also of the body if it is from a file
   * @param faces_of vertices of the faces on the sides of a condition, gathered
   * from all ranks
   */
  double
  time_of_small_motion(
    const Scene                                                     &scene,
    const dealii::BoundingBox<dim>                                  &mesh,
    const std::function<VerticesOfFaces(const BoundaryCondition &)> &faces_of);
} // namespace geocone::GEOCONE_DIM

#endif
