// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_sparse_matrix_h
#define geocone_base_sparse_matrix_h

#include <mpi.h>

#include <vector>

namespace geocone
{
  /**
   * Distributed square sparse matrix, defined as the sum of local matrices over
   * all ranks. Each rank stores the contributions of its cells in
   * compressed-row format (CSR) with local numbers; entries stored by several
   * ranks are summed. Distributed direct solvers accept this format, so that
   * assembly requires no communication. On one rank it is the usual CSR matrix.
   *
   * Rows owned by the rank are first in the local numbering and have
   * consecutive global numbers.
   */
  struct SparseMatrix
  {
    MPI_Comm comm = MPI_COMM_SELF;

    /** True if only the lower triangle of the matrix is stored. Its entries
     *  have column <= row in local numbering. */
    bool symmetric = false;

    int n_global = 0; ///< number of rows on all ranks
    int n_owned  = 0; ///< number of rows owned by this rank

    /** Global index of each local row of the matrix. */
    std::vector<int> global_index;

    /** Matrix in compressed-row format (CSR), with sorted column indices in
     *  each row. */
    std::vector<int>    row_start = {0};
    std::vector<int>    column;
    std::vector<double> value;

    /** Index of the first column of each row in the array `column`, if the rows
     *  of a node share a list of columns. Each row has as many of the first ones
     *  as it has entries: if one triangle is stored, the last row has all of
     *  them. Empty if each row has its own columns, in the order of the values,
     *  as direct solvers require. */
    std::vector<int> column_start;

    int
    n_rows() const
    {
      return row_start.size() - 1;
    }

    /** Sorted column indices of the entries of a row. */
    const int *
    columns(const int row) const
    {
      return &column[column_start.empty() ? row_start[row] : column_start[row]];
    }

    /** Column index of an entry of a row. @param place in the array `value` */
    int
    column_of(const int row, const int place) const
    {
      return columns(row)[place - row_start[row]];
    }

    /** Returns the position of a matrix entry in the array `value`. The entry
     *  must be in the sparsity pattern. */
    int
    entry(const int row, const int col) const;

    /** Sets the sparsity pattern, with entries of value zero.
     *  @param columns of each local row, in any order, also repeated */
    void
    set_pattern(std::vector<std::vector<int>> columns);

    /** Memory used by the matrix arrays (bytes). */
    std::size_t
    memory() const;
  };
} // namespace geocone

#endif
