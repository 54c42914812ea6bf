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

  std::size_t
  SparseMatrix::memory() const
  {
    return sizeof(int) *
             (global_index.size() + row_start.size() + column.size()) +
           sizeof(double) * value.size();
  }
} // namespace geocone
