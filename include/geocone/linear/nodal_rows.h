// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_nodal_rows_h
#define geocone_linear_nodal_rows_h

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace geocone
{
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
  };
} // namespace geocone

#endif
