// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_nodal_rows_h
#define geocone_linear_nodal_rows_h

#include <deal.II/base/partitioner.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Linear interpolation of a nodal field from the vertices of the mesh.
   * Vertices are nodes as well.
   */
  struct VertexInterpolation
  {
    /** A vertex (local number of its node) and its weight. */
    using Weight = std::pair<unsigned int, double>;

    /** Vertices with nonzero weights of each local node, one node after the
     *  other. */
    std::vector<Weight> weights;

    /** Index of the first weight of each local node in the array `weights`, and
     *  finally the number of weights. */
    std::vector<std::size_t> first;

    /** Returns true if a local node is a vertex. */
    bool
    is_vertex(const unsigned int node) const
    {
      return first[node + 1] == first[node] + 1 &&
             weights[first[node]].first == node;
    }
  };

  /**
   * Assignment of the rows of a Jacobian to nodes, for algebraic multigrid.
   * Multigrid aggregates nodes instead of rows, with rigid motions as the
   * near-nullspace of the elastic stiffness.
   */
  struct NodalRows
  {
    unsigned int n_components = 2; ///< velocity components per node

    /** Parallel layout of the velocity vector; the degrees of freedom of a node
     *  are consecutive. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;

    /** Global index of the degree of freedom of each locally owned matrix
     *  row. */
    std::vector<dealii::types::global_dof_index> dof;

    /** Rigid-body modes: translations, and rotations if nodal positions are
     *  available. Values at the owned dofs, zero at dofs without a matrix
     *  row. */
    std::vector<std::vector<double>> rigid_motions;

    /** Interpolation from the vertices of the mesh, for multigrid on polynomial
     *  degrees; null for other solvers. */
    std::shared_ptr<const VertexInterpolation> vertices;

    /** Local nodes whose components are not those of the coordinate axes, with
     *  the unit vectors of their components (row by row). */
    std::vector<std::pair<unsigned int, std::array<double, 9>>> turned;
  };
} // namespace geocone

#endif
