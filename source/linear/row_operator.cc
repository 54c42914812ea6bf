// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/preconditioner.h>

#include <algorithm>

namespace geocone
{
  void
  RowOperator::reinit(const SparseMatrix &new_matrix)
  {
    matrix            = &new_matrix;
    const int   n     = matrix->n_owned;
    const auto &index = matrix->global_index;
    // A rank without rows has an empty range.
    dealii::IndexSet owned(matrix->n_global), other(matrix->n_global);
    if (n > 0)
      owned.add_range(index[0], index[0] + n);
    std::vector<dealii::types::global_dof_index> others(index.begin() + n,
                                                        index.end());
    std::sort(others.begin(), others.end());
    other.add_indices(others.begin(), others.end());
    rows = std::make_shared<dealii::Utilities::MPI::Partitioner>(
      owned, other, matrix->comm);
    ghosts.clear();
    for (auto row = index.begin() + n; row != index.end(); ++row)
      ghosts.push_back(rows->global_to_local(*row));
  }

  void
  RowOperator::vmult(RowVector &product, const RowVector &x) const
  {
    x.update_ghost_values();
    const int           n_rows = matrix->n_rows(), n = matrix->n_owned;
    const double       *values = x.begin();
    std::vector<double> with_ghosts;
    if (n < n_rows)
      {
        with_ghosts.assign(values, values + n);
        for (const unsigned int place : ghosts)
          with_ghosts.push_back(x.local_element(place));
        values  = with_ghosts.data();
        product = 0.;
      }
    const int    *column = matrix->column.data();
    const double *entry  = matrix->value.data();
    for (int i = 0; i < n_rows; ++i)
      {
        double sum = 0.;
        for (int e = matrix->row_start[i]; e < matrix->row_start[i + 1]; ++e)
          sum += entry[e] * values[column[e]];
        product.local_element(place(i)) = sum;
      }
    if (dealii::Utilities::MPI::n_mpi_processes(matrix->comm) > 1)
      product.compress(dealii::VectorOperation::add);
    x.zero_out_ghost_values();
  }
} // namespace geocone
