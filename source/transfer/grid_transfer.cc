// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/transfer/grid_transfer.h>

namespace geocone::GEOCONE_DIM
{
  void
  GridTransfer::clear_cells()
  {
    sums_of_cells.assign(2 * n_stored_cells(), 0.);
  }

  void
  GridTransfer::add_to_cells(const TransferBlock &points, const double *values)
  {
    unsigned int cells[BlockScratch::size];
    find_cells(points, cells);
    for (unsigned int k = 0; k < points.n; ++k)
      {
        const double  V  = points.volume[k];
        double *const to = &sums_of_cells[2 * std::size_t(cells[k])];
        to[0] += V;
        to[1] += V * values[k];
      }
  }

  void
  GridTransfer::average(const TransferBlock &points, double *means) const
  {
    unsigned int cells[BlockScratch::size];
    find_cells(points, cells);
    for (unsigned int k = 0; k < points.n; ++k)
      {
        const double *from = &sums_of_cells[2 * std::size_t(cells[k])];
        means[k]           = from[0] > 0. ? from[1] / from[0] : 0.;
      }
  }
} // namespace geocone::GEOCONE_DIM
