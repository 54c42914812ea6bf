// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_interface_cells_h
#define geocone_limit_analysis_interface_cells_h

#include <geocone/limit_analysis/bound_problem.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Point of an interface. */
  struct InterfacePoint
  {
    double part = 0.; ///< share of the edge's length

    /** The x dofs of the edge's nodes, with their weights in the velocity. */
    std::vector<std::pair<unsigned int, double>> nodes;

    /** Point where the obstacle's linear velocity is evaluated. */
    dealii::Point<dim> place;
  };

  /** Number of dofs of the obstacles' motions and of the openings, three per
   *  interface. */
  unsigned int
  n_dofs_of_interfaces(const BoundScene &bound);

  /** The three points of an edge in a space of velocities. */
  using PointsOfEdge =
    std::function<std::array<InterfacePoint, 3>(const unsigned int edge)>;

  /**
   * Adds the interfaces as cells; prescribes the obstacles' velocities, or loads free
   * ones.
   * @param first_dof of n_dofs_of_interfaces()
   */
  void
  add_interfaces(const BoundScene   &bound,
                 const PointsOfEdge &points_of,
                 const unsigned int  first_dof,
                 BoundProblem       &problem);
} // namespace geocone::GEOCONE_DIM

#endif
