// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_moving_boundary_h
#define geocone_mechanics_moving_boundary_h

#include <geocone/discretisation/space.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone
{
  /** A place where shape functions are evaluated: a cell of this rank, N there. */
  struct BoundaryPoint
  {
    dealii::Point<dim>                           position;
    double                                       weight; ///< part of the line
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<double>                          values; ///< N, per node
  };

  /**
   * Points on the line from a to b for sums that are integrals over it, exact for
   * the shape functions along each cell that it crosses: Gauss points on each
   * cell's part of the line. Weights sum up, over all ranks, to the part of the
   * line that lies in the mesh. A line along the border of two cells belongs to
   * the cell on its left, seen from a to b, and one along the border of the mesh
   * to the mesh if that is on its left.
   */
  std::vector<BoundaryPoint>
  points_on_line(const BackgroundMesh     &mesh,
                 const Space              &space,
                 const dealii::Point<dim> &a,
                 const dealii::Point<dim> &b);

  /** A side of the body, or its part in a box, that moves: a chain of lines. */
  class MovingBoundary
  {
  public:
    /**
     * @param condition gives the sides of the body, and the box
     * @param longest length of its lines (m); 0: one line for each side
     * @throws InputError if the body has no such side or it misses the box
     */
    MovingBoundary(const BoundaryCondition &condition,
                   const Geometry          &geometry,
                   const double             longest);

    struct Line
    {
      /** Its present ends; the body lies to the left. */
      dealii::Point<dim> a, b;
      double             length; ///< at the start (m)
    };
    std::vector<Line> lines;
  };

  /** @throws InputError where a condition's box holds no part of its sides of the body */
  void
  refuse_no_part(const BoundaryCondition &condition, const std::size_t n_parts);

  /**
   * The ends of the parts of the condition's sides inside its box, with the body
   * to the left.
   * @throws InputError as MovingBoundary
   */
  std::vector<MovingBoundary::Line>
  lines_of_body(const BoundaryCondition &condition, const Geometry &geometry);
} // namespace geocone

#endif
