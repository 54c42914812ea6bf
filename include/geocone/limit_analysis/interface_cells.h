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
  /** Point of an interface cell. */
  struct InterfacePoint
  {
    double part = 0.; ///< share of the edge's length

    /** Dofs (x component) of the edge's nodes, with the weights of the nodes in the
     *  velocity at the point. */
    std::vector<std::pair<unsigned int, double>> nodes;

    /** Position at which the rigid velocity of the obstacle is evaluated. */
    dealii::Point<dim> place;
  };

  /** Number of dofs added by interfaces: motions of the obstacles, and three openings per
   *  interface. */
  unsigned int
  n_dofs_of_interfaces(const BoundScene &bound);

  /** Returns the three interface points of an edge in a velocity space. */
  using PointsOfEdge =
    std::function<std::array<InterfacePoint, 3>(const unsigned int edge)>;

  /**
   * Appends the interfaces as cells of a problem, prescribes the velocities of driven
   * obstacles, and applies the loads of free obstacles.
   * @param first_dof first of the n_dofs_of_interfaces() dofs
   */
  void
  add_interfaces(const BoundScene   &bound,
                 const PointsOfEdge &points_of,
                 const unsigned int  first_dof,
                 BoundProblem       &problem);
} // namespace geocone::GEOCONE_DIM

#endif
