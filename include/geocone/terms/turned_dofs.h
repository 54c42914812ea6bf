// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_turned_dofs_h
#define geocone_terms_turned_dofs_h

#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Transforms cell vectors and cell matrices to rotated dofs, i.e. nodal
   * components along rotated axes (Unknowns::turned_nodes). Without rotated
   * dofs it has no cost.
   */
  class TurnedDofs
  {
  public:
    TurnedDofs(const MaterialPoints &points, const Unknowns &unknowns);

    struct Turn
    {
      unsigned int           node; ///< node number in the cell
      dealii::Tensor<2, dim> axes; ///< unit vectors, by rows
    };

    /** Rotated axes of a node of a cell; null if the dofs of the node are not
     *  rotated. */
    const Turn *
    turn_of(const unsigned int c, const unsigned int node) const;

    /** Transforms the nodal velocities of a cell from components along the
     *  rotated axes of the nodes to Cartesian components. */
    void
    velocities_to_xy(const unsigned int c, double *cell_v) const
    {
      if (!turns.empty())
        turn_velocities(c, cell_v);
    }

    /** Transforms the nodal forces of a cell from Cartesian components to
     *  components along the rotated axes of the nodes. */
    void
    forces_to_dofs(const unsigned int c, double *cell_f) const
    {
      if (!turns.empty())
        turn_forces(c, cell_f);
    }

    /** Transforms a cell matrix (rows and columns) from Cartesian components to
     *  components along the rotated axes of the nodes.
     *  @param n_dofs number of rows
     *  @param upper whether only the upper triangle is set */
    void
    matrix_to_dofs(const unsigned int c,
                   const unsigned int n_dofs,
                   const bool         upper,
                   double            *K) const;

  private:
    void
    turn_velocities(const unsigned int c, double *cell_v) const;
    void
    turn_forces(const unsigned int c, double *cell_f) const;

    /** Rotated axes of all nodes with rotated dofs, ordered by cell. The entries of
     *  cell c begin at first_turn[c]. Empty without rotated dofs. */
    std::vector<Turn>         turns;
    std::vector<unsigned int> first_turn;
  };
} // namespace geocone::GEOCONE_DIM

#endif
