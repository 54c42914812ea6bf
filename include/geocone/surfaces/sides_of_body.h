// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_sides_of_body_h
#define geocone_surfaces_sides_of_body_h

#include <geocone/scene/scene.h>
#include <geocone/surfaces/side_points.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Returns the boundary segments of the body selected by a boundary condition.
   * The segments (lines, in three dimensions rectangles) are clipped to the box
   * of the condition.
   * @throws InputError if the body lacks such a segment, or the segment is
   * outside of the box
   */
  std::vector<SidePart>
  segments_of_body(const BoundaryCondition &condition,
                   const Geometry          &geometry);

  /** Returns a side of a box normal to an axis, or a part of this side.
   *  @param low,high opposite corners of the side or part */
  SidePart
  side_across(const unsigned int        axis,
              const bool                is_upper,
              const dealii::Point<dim> &low,
              const dealii::Point<dim> &high);

  /** Returns the cell size (m) along an edge of a boundary segment. It is the
   *  maximum length of the centre line of the segment inside a single cell.
   *  Collective. */
  double
  cell_size_along(const BackgroundMesh &mesh,
                  const SidePart       &panel,
                  const unsigned int    edge);
} // namespace geocone::GEOCONE_DIM

#endif
