// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/sparse_matrix.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace geocone
{
  int
  SparseMatrix::entry(const int row, const int col) const
  {
    const int *const begin = columns(row);
    const int *const end   = begin + (row_start[row + 1] - row_start[row]);
    const int *const place = std::lower_bound(begin, end, col);
    Assert(place != end && *place == col, dealii::ExcInternalError());
    return row_start[row] + (place - begin);
  }

  void
  SparseMatrix::set_pattern(std::vector<std::vector<int>> columns)
  {
    row_start = {0};
    column.clear();
    column_start.clear();
    for (std::vector<int> &of_row : columns)
      {
        std::sort(of_row.begin(), of_row.end());
        of_row.erase(std::unique(of_row.begin(), of_row.end()), of_row.end());
        column.insert(column.end(), of_row.begin(), of_row.end());
        row_start.push_back(column.size());
      }
    value.assign(column.size(), 0.);
  }

  std::size_t
  SparseMatrix::memory() const
  {
    return sizeof(int) * (global_index.size() + row_start.size() +
                          column.size() + column_start.size()) +
           sizeof(double) * value.size();
  }
} // namespace geocone
