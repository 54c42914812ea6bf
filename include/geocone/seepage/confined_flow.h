// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_confined_flow_h
#define geocone_seepage_confined_flow_h

#include <geocone/functions/lagrange_simplex.h>
#include <geocone/geometry/geometry.h>
#include <geocone/seepage/flow_mesh.h>

#include <deal.II/base/symmetric_tensor.h>

#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Steady seepage flow without a free surface. The hydraulic head h = psi + y
   * is continuous and of degree 1 to 3 in each cell,
   *   integral of grad N_i . k grad h = inflow at node i,
   * which is zero at nodes without a prescribed head. The inflows sum to zero.
   * See doc/theory/seepage.md.
   */
  class ConfinedFlow
  {
  public:
    /** Creates the nodes. The first ones are the vertices of the mesh.
     *  @pre the mesh outlives the object */
    ConfinedFlow(const FlowMesh &mesh, const unsigned int degree);

    const std::vector<dealii::Point<dim>> &
    nodes() const
    {
      return positions;
    }

    /** Nodes on facets of the mesh, with repetitions. */
    std::vector<unsigned int>
    nodes_on(const std::vector<unsigned int> &facets) const;

    /** Computes the flow.
     *  @param permeability hydraulic conductivity of each material (m/s)
     *  @param prescribed pressure heads psi at nodes (m); at least one
     *  @throws RunError if the linear system is singular */
    void
    solve(const std::vector<dealii::SymmetricTensor<2, dim>> &permeability,
          const Geometry::Symmetry                            symmetry,
          const std::vector<std::optional<double>>           &prescribed);

    /** @name Results of solve() */
    /** @{ */
    std::vector<double> head;   ///< psi at the nodes (m)
    std::vector<double> inflow; ///< through the boundary at the nodes (m^2/s)

    /** Largest imbalance of a node without a prescribed head over the sum of
     *  the absolute flows from its neighbours (-). */
    double error = 0.;
    /** @} */

    /** Darcy velocity at a point of a cell (m/s).
     *  @param k hydraulic conductivity of the cell (m/s) */
    dealii::Tensor<1, dim>
    velocity(const unsigned int                     cell,
             const LagrangeSimplex::Barycentric    &at,
             const dealii::SymmetricTensor<2, dim> &k) const;

    const std::vector<std::vector<unsigned int>> &
    nodes_of_cells() const
    {
      return nodes_of_cell;
    }

    unsigned int
    degree() const
    {
      return shape.degree();
    }

  private:
    /** Gradients of the shape functions at a point of a cell (1/m). */
    std::vector<dealii::Tensor<1, dim>>
    gradients(const unsigned int                  cell,
              const LagrangeSimplex::Barycentric &at) const;

    /** Conductances integral of grad N_i . k grad N_j of a cell, row by row. */
    std::vector<double>
    conductances(const unsigned int                     cell,
                 const dealii::SymmetricTensor<2, dim> &k,
                 const Geometry::Symmetry               symmetry) const;

    const FlowMesh                        &mesh;
    LagrangeSimplex                        shape;
    std::vector<std::vector<unsigned int>> nodes_of_cell;
    std::vector<dealii::Point<dim>>        positions;
  };
} // namespace geocone::GEOCONE_DIM

#endif
