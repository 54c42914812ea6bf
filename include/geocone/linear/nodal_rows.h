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
   * What the rows of a Jacobian stand for: multigrid joins nodes, not rows, and
   * its coarse functions are the motions that elasticity resists least.
   */
  struct NodalRows
  {
    unsigned int n_components = 2; ///< of the velocity of a node

    /** Layout of velocities; the dofs of a node stand one after another. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;

    /** The global dof of each local row. */
    std::vector<dealii::types::global_dof_index> dof;

    /** Translations and, where the places of nodes are known, rotations: each its
     *  values at the owned dofs, zero where they are no row. */
    std::vector<std::vector<double>> rigid_motions;
  };
} // namespace geocone

#endif
