// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/preconditioner.h>

#include <algorithm>
#include <cstring>

namespace geocone
{
#if defined(__x86_64__)
  namespace
  {
    /**
     * Products of three rows with the same columns, for processors with AVX2 and
     * FMA: three columns at a time where they follow each other, as those of a
     * node do, in packs of four numbers whose last one is not used.
     * @param rows entries of the rows
     * @param common number of columns
     * @param n_rows length of x and y
     * @param of_rows the vector x in the rows
     * @param[out] sum products of the rows
     * @param y to which the transposed entries are added, if symmetric
     */
    template <bool symmetric>
    [[gnu::target("avx2,fma")]] void
    multiply_three_rows(const double *const (&rows)[3],
                        const int    *column,
                        const int     common,
                        const int     n_rows,
                        const double *x,
                        const double (&of_rows)[3],
                        double (&sum)[3],
                        double *y)
    {
      using Pack [[gnu::vector_size(4 * sizeof(double))]] = double;
      const double *const row_0 = rows[0], *const row_1 = rows[1],
                          *const row_2 = rows[2];
      const double x_0 = of_rows[0], x_1 = of_rows[1], x_2 = of_rows[2];
      Pack         sum_0 = {}, sum_1 = {}, sum_2 = {};
      for (int k = 0; k < common;)
        {
          const int     first = column[k];
          Pack          packed_0, packed_1, packed_2, packed_x;
          double *const to = y + first;
          if (k + 3 < common + symmetric && column[k + 2] == first + 2 &&
              first + 3 < n_rows)
            {
              std::memcpy(&packed_x, x + first, sizeof(Pack));
              std::memcpy(&packed_0, row_0 + k, sizeof(Pack));
              std::memcpy(&packed_1, row_1 + k, sizeof(Pack));
              std::memcpy(&packed_2, row_2 + k, sizeof(Pack));
              sum_0 += packed_0 * packed_x;
              sum_1 += packed_1 * packed_x;
              sum_2 += packed_2 * packed_x;
              if (symmetric)
                {
                  Pack transposed;
                  std::memcpy(&transposed, to, sizeof(Pack));
                  transposed += packed_0 * x_0;
                  transposed += packed_1 * x_1;
                  transposed += packed_2 * x_2;
                  std::memcpy(to, &transposed, 2 * sizeof(double));
                  to[2] = transposed[2];
                }
              k += 3;
              continue;
            }
          sum_0[0] += row_0[k] * x[first];
          sum_1[0] += row_1[k] * x[first];
          sum_2[0] += row_2[k] * x[first];
          if (symmetric)
            *to += row_0[k] * x_0 + row_1[k] * x_1 + row_2[k] * x_2;
          ++k;
        }
      sum[0] = sum_0[0] + sum_0[1] + sum_0[2];
      sum[1] = sum_1[0] + sum_1[1] + sum_1[2];
      sum[2] = sum_2[0] + sum_2[1] + sum_2[2];
    }
  } // namespace
#endif

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

  template <int n>
  void
  RowOperator::multiply_rows(const int first, const double *x, double *y) const
  {
    const bool       symmetric = matrix->symmetric;
    const int *const column    = matrix->columns(first);
    const double    *entries[n];
    double           sum[n] = {}, of_rows[n];
    for (int a = 0; a < n; ++a)
      {
        entries[a] = &matrix->value[matrix->row_start[first + a]];
        of_rows[a] = x[first + a];
      }
    // The diagonal block of one triangle follows the common columns.
    const int common =
      matrix->row_start[first + 1] - matrix->row_start[first] - symmetric;
    int k = 0;
#if defined(__x86_64__)
    static const bool avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if constexpr (n == 3)
      if (avx2)
        {
          const auto multiply =
            symmetric ? multiply_three_rows<true> : multiply_three_rows<false>;
          multiply(
            entries, column, common, matrix->n_rows(), x, of_rows, sum, y);
          k = common;
        }
#endif
    for (; k < common; ++k)
      {
        const double x_k        = x[column[k]];
        double       transposed = 0.;
        for (int a = 0; a < n; ++a)
          {
            sum[a] += entries[a][k] * x_k;
            transposed += entries[a][k] * of_rows[a];
          }
        if (symmetric)
          y[column[k]] += transposed;
      }
    for (int a = 0; symmetric && a < n; ++a)
      for (int b = 0; b <= a; ++b)
        {
          const double entry = entries[a][common + b];
          sum[a] += entry * of_rows[b];
          if (b < a)
            sum[b] += entry * of_rows[a];
        }
    for (int a = 0; a < n; ++a)
      y[first + a] = sum[a];
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
    std::vector<double> local(n < n_rows ? n_rows : 0);
    double *const       y     = n < n_rows ? local.data() : product.begin();
    const auto         &start = matrix->column_start;
    for (int i = 0; i < n_rows;)
      {
        int end = i + 1; // of the rows that share their columns
        while (!start.empty() && end < n_rows && start[end] == start[i])
          ++end;
        if (end == i + 3)
          multiply_rows<3>(i, values, y);
        else if (end == i + 2)
          multiply_rows<2>(i, values, y);
        else
          multiply_rows<1>(i, values, y);
        i = end;
      }
    for (std::size_t i = 0; i < local.size(); ++i)
      product.local_element(place(i)) = local[i];
    if (dealii::Utilities::MPI::n_mpi_processes(matrix->comm) > 1)
      product.compress(dealii::VectorOperation::add);
    x.zero_out_ghost_values();
  }
} // namespace geocone
