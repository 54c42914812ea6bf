// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_turned_dofs_h
#define geocone_problem_turned_dofs_h

#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodes of cells with rotated dofs (Unknowns::turned_nodes), and the
   * transformation of cell vectors and matrices. Without such nodes it has no
   * cost.
   */
  class TurnedDofs
  {
  public:
    TurnedDofs(const MaterialPoints &points, const Unknowns &unknowns);

    struct Turn
    {
      unsigned int           node; ///< of the cell
      dealii::Tensor<2, dim> axes; ///< by rows
    };

    /** Rotation of a node of a cell, or null. */
    const Turn *
    turn_of(const unsigned int c, const unsigned int node) const;

    /** Transforms velocities of a cell from components of the dofs to x and
     *  y. */
    void
    velocities_to_xy(const unsigned int c, double *cell_v) const
    {
      if (!turns.empty())
        turn_velocities(c, cell_v);
    }

    /** Transforms forces of a cell from x and y to components of the dofs. */
    void
    forces_to_dofs(const unsigned int c, double *cell_f) const
    {
      if (!turns.empty())
        turn_forces(c, cell_f);
    }

    /** Transforms the rows and columns of the matrix of a cell.
     *  @param n_dofs its rows @param upper whether only the upper entries are
     *  set */
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

    /** If there are any, those of cell c begin at first_turn[c]. */
    std::vector<Turn>         turns;
    std::vector<unsigned int> first_turn;
  };
} // namespace geocone::GEOCONE_DIM

#endif
