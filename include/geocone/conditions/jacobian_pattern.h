// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_jacobian_pattern_h
#define geocone_conditions_jacobian_pattern_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Sparsity pattern of the Jacobian on the free dofs. Two nodes are coupled if they
   * share a cell with material points. Stores the positions of the entries of cell
   * matrices and of the diagonal in the array of values.
   */
  class JacobianPattern
  {
  public:
    /** Creates an empty sparsity pattern. */
    JacobianPattern() = default;

    /**
     * Creates the sparsity pattern and a zero matrix.
     * @param groups groups of nodes that are coupled without sharing a cell
     * @param links lists of a node, followed by nodes to whose rows the row of the
     * first one is added (Contact::links())
     * @param one_triangle whether only the lower triangle of a symmetric matrix
     * is stored
     * @param[out] matrix with the pattern and zero values
     */
    JacobianPattern(const MaterialPoints                         &points,
                    const Unknowns                               &unknowns,
                    const MPI_Comm                                comm,
                    const std::vector<std::vector<unsigned int>> &groups,
                    const std::vector<std::vector<unsigned int>> &links,
                    const bool                                    one_triangle,
                    SparseMatrix                                 &matrix);

    /** Returns true if only one triangle of a symmetric Jacobian is stored. Only
     *  the entries i <= j of a cell matrix are then used. */
    bool
    is_one_triangle() const
    {
      return one_triangle;
    }

    /** Adds the matrix K of a cell to the Jacobian. K has (dim n)^2 entries in
     *  row-major order, with rows interleaved as v_x, v_y, ... */
    template <int n>
    void
    add_cell(const unsigned int c, const double *K, SparseMatrix &matrix) const
    {
      constexpr int m     = dim * n;
      const int    *place = &places[c * places_of_cell];
      for (int i = 0; i < m; ++i)
        for (int j = one_triangle ? i : 0; j < m; ++j, ++place)
          if (*place >= 0)
            matrix.value[*place] += K[m * i + j];
    }

    /** Adds a value to the Jacobian entry of a pair of free dofs. If one triangle
     *  is stored, entries of the upper triangle are skipped. */
    void
    add_entry(const int     row,
              const int     column,
              const double  value,
              SparseMatrix &matrix) const
    {
      if (!one_triangle || column <= row)
        matrix.value[matrix.entry(row, column)] += value;
    }

    /** Adds a value to the diagonal entry of a free dof in the Jacobian. */
    void
    add_diagonal(const int row, const double value, SparseMatrix &matrix) const
    {
      matrix.value[diagonal[row]] += value;
    }

  private:
    bool one_triangle = false;

    /**
     * Positions of the entries of each cell matrix in the array of Jacobian values.
     * A cell has (dim n_nodes)^2 entries, or one entry per symmetric pair if one
     * triangle is stored; -1 for dofs that are not free.
     */
    std::vector<int> places;
    std::size_t      places_of_cell = 0;

    /** Position of the diagonal entry of each free dof in the array of Jacobian
     *  values. */
    std::vector<int> diagonal;
  };
} // namespace geocone::GEOCONE_DIM

#endif
