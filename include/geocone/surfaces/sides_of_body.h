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
   * Parts of the condition's boundary segments of the body inside its box: in
   * the plane lines, in space rectangles.
   * @throws InputError if the body has no such segment or it is outside the box
   */
  std::vector<SidePart>
  panels_of_body(const BoundaryCondition &condition, const Geometry &geometry);

  /** Side of a box normal to an axis.
   *  @param low,high corners of the side, or of a part of it */
  SidePart
  side_across(const unsigned int        axis,
              const bool                is_upper,
              const dealii::Point<dim> &low,
              const dealii::Point<dim> &high);

  /** Longest part of the centre line along an edge in one cell (m).
   *  Collective. */
  double
  cell_size_along(const BackgroundMesh &mesh,
                  const SidePart       &panel,
                  const unsigned int    edge);
} // namespace geocone::GEOCONE_DIM

#endif
