// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_surfaces_side_points_h
#define geocone_surfaces_side_points_h

#include <geocone/space/space.h>
#include <geocone/surfaces/side_part.h>

#include <deal.II/base/quadrature.h>

#include <functional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Quadrature point on a facet, with the shape functions N of the cell that
   *  contains the point. */
  struct BoundaryPoint
  {
    dealii::Point<dim> position;
    double             weight; ///< fraction of the facet
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<double>                          values; ///< N, by node
  };

  /** Whether the shape function of a local node has mass: others see no
   *  particle, do not move, and carry no load. */
  using NodesWithMass = std::function<bool(const unsigned int)>;

  /** Sets the values of functions without mass to zero and scales the others to
   *  the sum 1. @return whether any has mass */
  bool
  keep_nodes_with_mass(
    const Space                                        &space,
    const NodesWithMass                                &has_mass,
    const std::vector<dealii::types::global_dof_index> &nodes,
    std::vector<double>                                &values);

  /**
   * Calls f(index, point) for each quadrature point of facets (lines or
   * triangles) inside cells of this rank. These are Gauss points on the part of
   * the facet in each cell, in two dimensions exact for the shape functions.
   * Over all ranks the weights of a facet sum to its fraction inside the mesh.
   * A facet along the boundary of cells belongs to the cells on the side of the
   * body; a facet along the boundary of the mesh belongs to the mesh if the
   * mesh is on that side.
   * @return fraction of each facet on this rank
   */
  std::vector<double>
  for_each_point(
    const BackgroundMesh                                                &mesh,
    const Space                                                         &space,
    const std::vector<SidePart>                                         &facets,
    const std::function<void(const std::size_t, const BoundaryPoint &)> &f);

  /** Half of space: (x - first) . second >= 0. */
  using SideOfPlane = std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>;

  /** Returns the part of a facet in the intersection of half-spaces, as
   *  facets. */
  std::vector<SidePart>
  pieces_between(const std::vector<SideOfPlane> &planes, const SidePart &facet);

  /** Returns a quadrature rule on a facet of size 1, of degree 9 on a line and 7
   *  on a triangle. */
  dealii::Quadrature<dim - 1>
  rule_of_facets();

  /** Returns quadrature points on a line, a triangle or a parallelogram. */
  std::vector<BoundaryPoint>
  points_on(const BackgroundMesh &mesh,
            const Space          &space,
            const SidePart       &part);

  /** Returns the length (m) of the longest part of the line ab that lies in a
   *  single cell. Collective. */
  double
  longest_part_in_cell(const BackgroundMesh     &mesh,
                       const dealii::Point<dim> &a,
                       const dealii::Point<dim> &b);

  /** Returns the range [from, to] of t in [0, 1] in which all given linear
   *  functions c + t d are non-negative. The range is empty if to < from. */
  std::pair<double, double>
  part_of_line(const std::vector<std::pair<double, double>> &conditions);
} // namespace geocone::GEOCONE_DIM

#endif
