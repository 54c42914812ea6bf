// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_side_points_h
#define geocone_surfaces_side_points_h

#include <geocone/space/space.h>
#include <geocone/surfaces/side_part.h>

#include <functional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A place where shape functions are evaluated: a cell of this rank, N there. */
  struct BoundaryPoint
  {
    dealii::Point<dim> position;
    double             weight; ///< part of the line or triangle
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<double>                          values; ///< N, per node
  };

  /**
   * Calls f(number, point) for points for sums that are integrals over each facet, a line
   * or a triangle, of what of it is in cells of this rank: Gauss points on each cell's
   * part, in the plane exact for the shape functions. Their weights sum up, over all ranks, to the part of
   * the facet that is in the mesh. A facet along the border of cells belongs to those on
   * the side of the body, and one along the border of the mesh to the mesh if that is
   * there.
   * @return the parts that this rank knows
   */
  std::vector<double>
  for_each_point(
    const BackgroundMesh                                                &mesh,
    const Space                                                         &space,
    const std::vector<SidePart>                                         &facets,
    const std::function<void(const std::size_t, const BoundaryPoint &)> &f);

  /** The same points of a line, a triangle or a parallelogram. */
  std::vector<BoundaryPoint>
  points_on(const BackgroundMesh &mesh,
            const Space          &space,
            const SidePart       &part);

  /** The longest part of a line from a to b in one cell (m). Collective. */
  double
  longest_part_in_cell(const BackgroundMesh     &mesh,
                       const dealii::Point<dim> &a,
                       const dealii::Point<dim> &b);

  /** From where to where, between 0 and 1, a + t along has c + t d >= 0 for all of these
   *  c and d; to < from: nowhere. */
  std::pair<double, double>
  part_of_line(const std::vector<std::pair<double, double>> &conditions);
} // namespace geocone::GEOCONE_DIM

#endif
