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
   * matrices, by pairs of nodes, and of the diagonal in the array of values.
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
     * @param shares_columns whether the rows of a node share their columns
     * @param[out] matrix with the pattern and zero values
     */
    JacobianPattern(const MaterialPoints                         &points,
                    const Unknowns                               &unknowns,
                    const MPI_Comm                                comm,
                    const std::vector<std::vector<unsigned int>> &groups,
                    const std::vector<std::vector<unsigned int>> &links,
                    const bool                                    one_triangle,
                    const bool    shares_columns,
                    SparseMatrix &matrix);

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
      constexpr int d = dim, m = d * n;
      const int    *row    = &rows[std::size_t(m) * c];
      const int    *offset = &offsets[pairs_of_cell * c];
      bool          all    = true;
      int           start[m];  // of the row of a dof in the array of values
      int           column[m]; // of a dof among the free dofs of its node
      for (int i = 0; i < m; ++i)
        {
          all       = all && row[i] >= 0;
          start[i]  = row[i] >= 0 ? matrix.row_start[row[i]] : 0;
          column[i] = i % d > 0 ? column[i - 1] + (row[i - 1] >= 0) : 0;
        }
      double *const value = matrix.value.data();
      // Adds the block of nodes i and j, or its transpose, to the rows of i.
      const auto add = [&](const int i, const int j, const int at, auto of) {
        for (int a = d * i; a < d * (i + 1); ++a)
          for (int b = 0; b < d; ++b)
            if (all)
              value[start[a] + at + b] += of(a, d * j + b);
            else if (row[a] >= 0 && row[d * j + b] >= 0)
              value[start[a] + at + column[d * j + b]] += of(a, d * j + b);
      };
      const auto plain = [K](const int a, const int b) { return K[m * a + b]; };
      const auto turned = [K](const int a, const int b) {
        return K[m * b + a];
      };
      for (int i = 0; i < n; ++i)
        {
          if (!one_triangle)
            for (int j = 0; j < n; ++j, ++offset)
              add(i, j, *offset, plain);
          else
            {
              for (int a = d * i; a < d * (i + 1); ++a)
                for (int b = a; b < d * (i + 1); ++b)
                  if (row[a] >= 0 && row[b] >= 0)
                    value[start[b] + *offset + column[a]] += plain(a, b);
              ++offset;
              for (int j = i + 1; j < n; ++j, ++offset)
                if (*offset >= 0)
                  add(i, j, *offset, plain);
                else
                  add(j, i, -1 - *offset, turned);
            }
        }
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

    /** Rows of the dofs of each cell, or a negative number for dofs that are
     *  not free. */
    std::vector<int> rows;

    /**
     * Places of the blocks of pairs of nodes of each cell in the rows of the first
     * node: distance from the start of the row to the first entry in the columns
     * of the second one. It is the same in the rows of all components of a node,
     * which have the same columns. All pairs in row-major order or, if one
     * triangle is stored, the pairs i <= j, where -1 - d is the distance d in the
     * rows of the second node if these are below those of the first one.
     */
    std::vector<int> offsets;
    std::size_t      pairs_of_cell = 0;

    /** Position of the diagonal entry of each free dof in the array of Jacobian
     *  values. */
    std::vector<int> diagonal;
  };
} // namespace geocone::GEOCONE_DIM

#endif
