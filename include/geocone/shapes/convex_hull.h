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
  /** Vertices of the convex hull of points in the plane of the first two
   *  coordinates, counterclockwise (Andrew 1979). There are fewer than three if
   *  the points are collinear. */
  std::vector<dealii::Point<dim>>
  convex_hull(std::vector<dealii::Point<dim>> points);

  /**
   * Unit vector along the shortest connection between the convex hulls of two
   * point sets. It is the normal of the separating plane with the largest
   * margin (Gilbert, Johnson and Keerthi 1988). Zero if the hulls intersect or
   * a set is empty.
   */
  dealii::Tensor<1, dim>
  way_between(const std::vector<dealii::Point<dim>> &from,
              const std::vector<dealii::Point<dim>> &to);
} // namespace geocone::GEOCONE_DIM

#endif
