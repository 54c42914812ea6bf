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
  /** A position where shape functions are evaluated: a cell of this rank, N
   *  there. */
  struct BoundaryPoint
  {
    dealii::Point<dim> position;
    double             weight; ///< fraction of the line or triangle
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<double>                          values; ///< N, per node
  };

  /**
   * Calls f(number, point) for quadrature points on the part of each facet, a
   * line or a triangle, inside cells of this rank: Gauss points on the part in
   * each cell, in the plane exact for the shape functions. Over all ranks their
   * weights sum to the part of the facet in the mesh. A facet along the
   * boundary of cells belongs to those on the side of the body; a facet along
   * the boundary of the mesh belongs to the mesh if the mesh is on that side.
   * @return fractions of the facets found on this rank
   */
  std::vector<double>
  for_each_point(
    const BackgroundMesh                                                &mesh,
    const Space                                                         &space,
    const std::vector<SidePart>                                         &facets,
    const std::function<void(const std::size_t, const BoundaryPoint &)> &f);

  /** Quadrature points of a line, a triangle or a parallelogram. */
  std::vector<BoundaryPoint>
  points_on(const BackgroundMesh &mesh,
            const Space          &space,
            const SidePart       &part);

  /** Longest part of a line from a to b in one cell (m). Collective. */
  double
  longest_part_in_cell(const BackgroundMesh     &mesh,
                       const dealii::Point<dim> &a,
                       const dealii::Point<dim> &b);

  /** Range [from, to] of t in [0, 1] with c + t d >= 0 for all given c and d;
   *  empty if to < from. */
  std::pair<double, double>
  part_of_line(const std::vector<std::pair<double, double>> &conditions);
} // namespace geocone::GEOCONE_DIM

#endif
