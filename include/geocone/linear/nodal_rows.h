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
   * Nodes of the rows of a Jacobian, for multigrid: it aggregates nodes, not
   * rows, and its coarse functions are the motions with the least elastic
   * resistance.
   */
  struct NodalRows
  {
    unsigned int n_components = 2; ///< of the velocity of a node

    /** Layout of velocities; the dofs of a node are consecutive. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;

    /** Global dof of each local row. */
    std::vector<dealii::types::global_dof_index> dof;

    /** Translations and, if nodal positions are known, rotations: values at the
     *  owned dofs, zero at dofs without a row. */
    std::vector<std::vector<double>> rigid_motions;
  };
} // namespace geocone

#endif
