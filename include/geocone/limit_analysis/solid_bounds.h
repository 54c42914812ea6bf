// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_solid_bounds_h
#define geocone_limit_analysis_solid_bounds_h

#include <geocone/limit_analysis/conic_solver.h>
#include <geocone/limit_analysis/solid_scene.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodes of polynomials on tetrahedra in Bernstein's basis, whose coefficients span a hull
   * of the polynomial: the vertices for the order 1; for the order 2 after them the six
   * edges ij, with the functions l_i^2 and 2 l_i l_j.
   */
  namespace simplex_nodes
  {
    constexpr unsigned int edges[6][2] = {
      {0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    constexpr unsigned int edges_of_facet[3][2] = {{0, 1}, {0, 2}, {1, 2}};

    constexpr unsigned int
    n_in_cell(const unsigned int order)
    {
      return order == 1 ? 4 : 10;
    }
    constexpr unsigned int
    n_on_facet(const unsigned int order)
    {
      return order == 1 ? 3 : 6;
    }

    /** Node of the edge between two vertices of a cell, or of the vertex i = j. */
    unsigned int
    node(const unsigned int i, const unsigned int j);
  } // namespace simplex_nodes

  /** Nodes in a cell of the nodes of one of its facets.
   *  @param side 0 or 1: the facet's first or second cell */
  std::vector<unsigned int>
  nodes_in_cell(const Tetrahedra  &tetrahedra,
                const unsigned int order,
                const unsigned int facet,
                const unsigned int side);

  /** Unit normal out of the first cell and two tangents of a facet. */
  std::array<dealii::Tensor<1, dim>, 3>
  axes_of_facet(const Tetrahedra &tetrahedra, const unsigned int facet);

  /** The cell whose strength a jump on a facet has: of two materials that with the smaller
   *  cohesion of the face, since the crack may be in either. */
  unsigned int
  cell_of_jump(const SolidScene &bound, const unsigned int facet);

  /** k at the points of a cell, or of a facet for its jumps, for which the sum over the
   *  points bounds the dissipation of linear strength from above. */
  /** @{ */
  std::vector<double>
  strength_of_rates(const SolidScene  &bound,
                    const unsigned int order,
                    const unsigned int cell);
  std::vector<double>
  strength_of_jumps(const SolidScene  &bound,
                    const unsigned int order,
                    const unsigned int facet);
  /** @} */

  /** Integral of a traction, linear with these values at the vertices, times the function
   *  of each node of a facet over its area. */
  std::vector<dealii::Tensor<1, dim>>
  forces_of_traction(const unsigned int                           order,
                     const std::array<dealii::Tensor<1, dim>, 3> &traction);

  /**
   * Upper bound: velocities of the order 1 or 2 that jump at all faces. Strain rates are
   * linear in a cell and jumps are in the hull of their coefficients, so flow that is
   * admissible at the points is so everywhere. The order 2 in cells that share their
   * velocities would lock for phi = 0. Fixed boundaries are faces against a body that does
   * not deform, and planes of symmetry may open where phi > 0: cracks in the soil just
   * beside what holds it, without which no velocity would be inside the cones.
   *
   * Dofs: three of each node of each cell, then three of each fixed velocity.
   */
  ConicProblem
  upper_problem(const SolidScene &bound, const unsigned int order);

  /**
   * Lower bound: stresses of the order 1 or 2 that are discontinuous at all faces, in
   * equilibrium in the cells and across faces; all coefficients are in the cone, and hence
   * the stress. Velocities are their dual: u of the cell (of its vertices for the order 2)
   * and w of the nodes of the facets.
   *
   * Dofs: the u, then the w.
   */
  ConicProblem
  lower_problem(const SolidScene &bound, const unsigned int order);

  /** The points of a lower problem: coefficients of the stress of each cell. */
  struct StressPlace
  {
    unsigned int group, point; ///< of the coefficient 0; others follow
  };
  std::vector<StressPlace>
  places_of_stresses(const SolidScene &bound, const unsigned int order);
} // namespace geocone::GEOCONE_DIM

#endif
