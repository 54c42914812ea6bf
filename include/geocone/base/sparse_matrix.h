// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_sparse_matrix_h
#define geocone_base_sparse_matrix_h

#include <mpi.h>

#include <vector>

namespace geocone
{
  /**
   * A square matrix as a sum over ranks: each rank stores the contributions of
   * its cells in compressed rows of its own local numbering; entries held by
   * several ranks are added. Distributed direct solvers accept this form, so
   * that assembly needs no communication. On one rank it is the usual
   * compressed-row matrix.
   *
   * Local rows: those owned by the rank come first, with consecutive global
   * numbers.
   */
  struct SparseMatrix
  {
    MPI_Comm comm = MPI_COMM_SELF;

    /** Whether only the entries with column <= row (local numbers) are
     *  stored. */
    bool symmetric = false;

    int n_global = 0; ///< rows of the matrix, of all ranks
    int n_owned  = 0; ///< rows owned by this rank

    /** Global number of each local row. */
    std::vector<int> global_index;

    /** Compressed rows with sorted columns. */
    std::vector<int>    row_start = {0};
    std::vector<int>    column;
    std::vector<double> value;

    int
    n_rows() const
    {
      return row_start.size() - 1;
    }

    /** Position of an entry of the pattern in `column` and `value`. */
    int
    entry(const int row, const int col) const;

    /** Size of the arrays (bytes). */
    std::size_t
    memory() const;
  };
} // namespace geocone

#endif
