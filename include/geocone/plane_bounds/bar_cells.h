// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_bar_cells_h
#define geocone_plane_bounds_bar_cells_h

#include <geocone/plane_bounds/bound_problem.h>
#include <geocone/plane_bounds/certificate.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Returns the number of dofs that structures add to the upper or the lower
   *  bound. */
  unsigned int
  n_dofs_of_bars(const BoundScene &bound, const BoundSide side);

  /** Returns the largest number of dofs of a point in the lower bound: more than six where
   *  the axial force and the moment of a plate interact. */
  unsigned int
  n_lower_columns(const BoundScene &bound);

  /** Returns the x dof of a node of quadratic velocities
   *  (PlasticBars::node_of_cell()). */
  unsigned int
  dof_of_node(const BoundScene &bound, const unsigned int node);

  /** Returns the x dof of the velocity with which the traction of a triangle works at
   *  the end of an edge, in the lower bound. @param vertex at that end */
  unsigned int
  dof_at_end_of_cell(const BoundScene  &bound,
                     const unsigned int cell,
                     const unsigned int edge,
                     const unsigned int vertex);

  /** Prescribes the velocities of the vertices of structures on sides with prescribed
   *  velocities, and adds the cells of structures to a problem. */
  void
  add_bars(const BoundScene &bound,
           const BoundSide   side,
           BoundProblem     &problem);

  /** Adds the contributions of structures and their interfaces to the gap between the
   *  bounds. @param[in,out] gap of each triangle, see gap_of_cells() */
  void
  add_gap_of_bars(const BoundScene    &bound,
                  const BoundProblem  &upper_problem,
                  const Bound         &upper,
                  const Bound         &lower,
                  std::vector<double> &gap);

  /** Forces of a lower bound and yielding of an upper bound at a point of a plate,
   *  geogrid, anchor or strut, in SI units. */
  struct BarPoint
  {
    const Structure   *structure = nullptr;
    double             arc       = 0.; ///< along its points (m)
    dealii::Point<dim> x;
    double             normal = 0., shear = 0., moment = 0.; ///< N/m, N/m, N
    dealii::Tensor<1, dim> velocity;   ///< of the upper bound, scaled
    double                 hinge = 0.; ///< jump of the rotation rate, scaled
    double                 rate  = 0.; ///< rate of axial strain, scaled
    double                 jump  = 0.; ///< axial jump of the velocity, scaled
  };

  /** Returns the points of all structures: both ends and the middle of each edge of
   *  chains, and both ends of anchors and struts. */
  std::vector<BarPoint>
  points_of_bars(const BoundScene &bound,
                 const Bound      &upper,
                 const Bound      &lower);
} // namespace geocone::GEOCONE_DIM

#endif
