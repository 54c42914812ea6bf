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
    const auto begin = column.begin() + row_start[row];
    const auto end   = column.begin() + row_start[row + 1];
    const auto place = std::lower_bound(begin, end, col);
    Assert(place != end && *place == col, dealii::ExcInternalError());
    return place - column.begin();
  }

  void
  SparseMatrix::set_pattern(std::vector<std::vector<int>> columns)
  {
    row_start = {0};
    column.clear();
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
    return sizeof(int) *
             (global_index.size() + row_start.size() + column.size()) +
           sizeof(double) * value.size();
  }
} // namespace geocone
