// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shapes_convex_hull_h
#define geocone_shapes_convex_hull_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** The corners of the convex hull of points of the plane, anticlockwise: fewer than
   *  three where these are on a line (Andrew 1979). Of the first two coordinates. */
  std::vector<dealii::Point<dim>>
  convex_hull(std::vector<dealii::Point<dim>> points);

  /**
   * The unit vector along the shortest way from the convex hull of some points to that of
   * others: the normal of the plane that parts them with the greatest margin (Gilbert,
   * Johnson and Keerthi 1988). Zero where they meet, or where there are no points.
   */
  dealii::Tensor<1, dim>
  way_between(const std::vector<dealii::Point<dim>> &from,
              const std::vector<dealii::Point<dim>> &to);
} // namespace geocone::GEOCONE_DIM

#endif
