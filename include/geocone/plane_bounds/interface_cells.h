// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_interface_cells_h
#define geocone_plane_bounds_interface_cells_h

#include <geocone/plane_bounds/bound_problem.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Point on an edge at which the relative velocity of an interface is evaluated. */
  struct InterfacePoint
  {
    double part = 0.; ///< fraction of the edge length

    /** Dofs of the x velocities of the edge's nodes, each with its
     *  interpolation weight at the point. */
    std::vector<std::pair<unsigned int, double>> nodes;

    /** Position at which the rigid-body velocity of the obstacle is evaluated. */
    dealii::Point<dim> place;
  };

  /** Relative velocity across an interface at a point, for a unit value of each dof. */
  struct PassingVelocity
  {
    std::vector<unsigned int>           dofs;
    std::vector<dealii::Tensor<1, dim>> G;

    void
    add(const unsigned int dof, const dealii::Tensor<1, dim> &velocity)
    {
      dofs.push_back(dof);
      G.push_back(velocity);
    }

    /** In cone axes, restricted to the components bounded by a face. @param N the
     *  normal */
    StrainMatrix
    strains(const Interface::Face &face, const dealii::Tensor<1, dim> &N) const;
  };

  /** Returns the number of dofs added by interfaces. These are the motions of the
   *  obstacles, and three opening rates for each interface that can open. */
  unsigned int
  n_dofs_of_interfaces(const BoundScene &bound);

  /** Function that returns the three interface points of an edge. */
  using PointsOfEdge =
    std::function<std::array<InterfacePoint, 3>(const Triangles::HeldEdge &)>;

  /**
   * Appends the interfaces to a problem as additional cells. Also prescribes the
   * velocities of driven obstacles and applies the loads of free obstacles.
   * @param first_dof first of the n_dofs_of_interfaces() dofs
   */
  void
  add_interfaces(const BoundScene   &bound,
                 const PointsOfEdge &points_of,
                 const unsigned int  first_dof,
                 BoundProblem       &problem);
} // namespace geocone::GEOCONE_DIM

#endif
