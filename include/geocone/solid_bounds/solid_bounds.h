// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_bounds_h
#define geocone_solid_bounds_solid_bounds_h

#include <geocone/bounds/cell_points.h>
#include <geocone/solid_bounds/solid_scene.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodes of polynomials in the Bernstein basis on tetrahedra. The coefficients span a
   * convex hull of the polynomial. The nodes are the vertices for order 1; for order 2
   * they are followed by the six edges ij, with the basis functions l_i^2 and 2 l_i l_j.
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

    /** Returns the local index of the node on the edge between the vertices i
     *  and j of a cell. For i = j it is the node of the vertex. */
    unsigned int
    node(const unsigned int i, const unsigned int j);
  } // namespace simplex_nodes

  /** Returns, for each node of a facet, the index of the same node in an adjacent cell.
   *  @param side 0 or 1: the facet's first or second cell */
  std::vector<unsigned int>
  nodes_in_cell(const Tetrahedra  &tetrahedra,
                const unsigned int order,
                const unsigned int facet,
                const unsigned int side);

  /** Returns the unit normal of a facet, outward from the first cell, and two unit
   *  tangents. */
  std::array<dealii::Tensor<1, dim>, 3>
  axes_of_facet(const Tetrahedra &tetrahedra, const unsigned int facet);

  /** Returns the cell whose strength limits a velocity jump on a facet. Between two
   *  materials it is the cell with the smaller face cohesion, since the crack may be in
   *  either. */
  unsigned int
  cell_of_jump(const SolidScene &bound, const unsigned int facet);

  /** Returns the strength at each point of a cell, or of a facet for velocity
   *  jumps. With these values, the sum over the points bounds the dissipation
   *  of linearly varying strength from above. */
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

  /** Returns the strength of a crack in the soil at each point of a facet, as for jumps;
   *  no value for soil with a tensile strength. */
  std::vector<std::optional<InterfaceStrength::Soil>>
  strength_of_cracks(const SolidScene  &bound,
                     const unsigned int order,
                     const unsigned int facet);

  /** Returns the strength k at the nodes of a cell. */
  std::vector<double>
  strength_at_nodes(const SolidScene  &bound,
                    const unsigned int order,
                    const unsigned int cell);

  /**
   * Returns, for each node of each cell, whether any admissible stress vanishes there. A
   * traction that vanishes on a facet makes zero a principal stress, and with friction but
   * no strength all of them: at free surfaces, and from there across the facets of a node
   * to all cells without strength.
   */
  std::vector<bool>
  stress_free_nodes(const SolidScene &bound, const unsigned int order);

  /** Returns the equivalent nodal forces of a traction on a facet, divided by
   *  the area of the facet. The force at a node is the integral of the traction
   *  times the basis function. The traction is linear, with the given values at
   *  the vertices. */
  std::vector<dealii::Tensor<1, dim>>
  forces_of_traction(const unsigned int                           order,
                     const std::array<dealii::Tensor<1, dim>, 3> &traction);

  /**
   * Assembles the upper-bound problem with velocities of order 1 or 2 on tetrahedra,
   * discontinuous at all faces. Strain rates are linear in a cell and jumps are in the
   * hull of their coefficients, so flow that is admissible at the points is admissible
   * everywhere. Continuous velocities of order 2 would lock for phi = 0. Fixed boundaries
   * are treated as faces against a rigid body, and planes of symmetry may open where phi
   * > 0: cracks in the soil directly beside the support, without which no velocity would
   * be inside the cones.
   *
   * Dofs: three for each node of each cell, then three for each fixed velocity.
   */
  ConicProblem
  upper_problem(const SolidScene &bound, const unsigned int order);

  /**
   * Assembles the lower-bound problem with stresses of order 1 or 2 on tetrahedra,
   * discontinuous at all faces. Stresses are in equilibrium in the cells and across
   * faces; all coefficients are in the cone, and hence the stress. Velocities are the
   * dual variables: u of the cell (of its vertices for order 2) and w of the nodes of the
   * facets.
   *
   * Dofs: first u, then w.
   */
  ConicProblem
  lower_problem(const SolidScene &bound, const unsigned int order);

  /** Returns the stresses of cells with the elastic ones that their residual of
   *  equilibrium causes: the smallest that restore it.
   *  @param problem solved lower-bound problem @param lambda its load factor */
  std::vector<Mandel>
  in_equilibrium(const SolidScene          &bound,
                 const unsigned int         order,
                 const ConicProblem        &problem,
                 const double               lambda,
                 const std::vector<Mandel> &stress);

  /** Returns the power of the stresses of each cell with the dual variables of the
   *  lower-bound problem.
   *  @param stress of the nodes of all cells @param q dual variables */
  std::vector<double>
  dual_power_of_cells(const SolidScene          &bound,
                      const unsigned int         order,
                      const std::vector<Mandel> &stress,
                      const Eigen::VectorXd     &q);
} // namespace geocone::GEOCONE_DIM

#endif
