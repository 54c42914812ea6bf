// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_unknowns_h
#define geocone_conditions_unknowns_h

#include <geocone/conditions/multipliers.h>

#include <deal.II/base/point.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Which dofs are unknown: those that are neither prescribed nor of a node
   * without mass, the free dofs, and the linear constraints on them. This is all
   * that an incremental problem knows of the supports.
   */
  struct Unknowns
  {
    bool
    is_free(const unsigned int local_dof) const
    {
      return free_row[local_dof] >= 0;
    }

    /** Whether a local dof is of a node with mass. */
    bool
    has_mass(const unsigned int local_dof) const
    {
      return with_mass[local_dof];
    }

    bool
    is_prescribed(const unsigned int local_dof) const
    {
      return free_row[local_dof] == prescribed_row;
    }

    /**
     * Per local dof its row among the free ones, or a negative number: where it
     * is prescribed, or where the node has no mass.
     */
    std::vector<int>     free_row;
    static constexpr int prescribed_row = -1, massless_row = -2;

    std::vector<bool> with_mass; ///< per local dof

    /** Global row numbers of the local free rows; the owned ones come first. */
    std::vector<int> global_row;
    int              n_owned_rows = 0;
    int              n_rows       = 0; ///< unknowns of all ranks

    /** Constraints on the free dofs. */
    Multipliers multipliers;

    /**
     * Nodes whose dofs are not along the coordinates: vectors of the incremental
     * problem have there the components along other axes, of which the first ones span
     * what is held.
     */
    struct TurnedNode
    {
      unsigned int           node; ///< local
      dealii::Tensor<2, dim> axes; ///< unit vectors, by rows
    };
    std::vector<TurnedNode> turned_nodes;

    /** Where the local nodes are; null in a problem that is replayed. */
    const std::vector<dealii::Point<dim>> *node_positions = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
