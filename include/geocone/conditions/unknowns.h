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
   * Unknowns of an incremental problem: the free dofs and the linear constraints on
   * the free dofs. Free dofs are the dofs of nodes with mass that are not
   * prescribed. The incremental problem depends on the supports through this class
   * only.
   */
  struct Unknowns
  {
    bool
    is_free(const unsigned int local_dof) const
    {
      return free_row[local_dof] >= 0;
    }

    /** Returns true if the node of a local dof has nonzero mass. */
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
     * Local row number of each free dof, indexed by local dof number. The value is
     * prescribed_row for prescribed dofs and massless_row for dofs of nodes without
     * mass.
     */
    std::vector<int>     free_row;
    static constexpr int prescribed_row = -1, massless_row = -2;

    std::vector<bool> with_mass; ///< has_mass(), by local dof

    /** Global row number of each free dof, by local row number. Rows owned by
     *  this rank are first. */
    std::vector<int> global_row;
    int              n_owned_rows = 0;
    int              n_rows       = 0; ///< number over all ranks

    /** Linear constraints H v = q on the free dofs. */
    Multipliers multipliers;

    /**
     * A node whose dofs are rotated to the directions of its prescribed velocities.
     * Vectors of the incremental problem contain the components along the axes of
     * the node, the first of which span the prescribed directions.
     */
    struct TurnedNode
    {
      unsigned int           node; ///< local number
      dealii::Tensor<2, dim> axes; ///< unit vectors, by rows
    };
    std::vector<TurnedNode> turned_nodes;

    /** Positions of the local nodes; null if the problem was read from a file
     *  (FrozenProblem). */
    const std::vector<dealii::Point<dim>> *node_positions = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
