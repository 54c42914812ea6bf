// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/point_block.h>
#include <geocone/points/point_arrays.h>

namespace geocone::GEOCONE_DIM
{
  PointArrays::PointArrays(const unsigned int of_material,
                           const unsigned int n_history,
                           const bool         affine,
                           const bool         in_cells)
    : of_material(of_material)
  {
    history.width      = n_history;
    this->affine.width = affine;
    cell.width = unit.width   = in_cells;
    material.width            = 0;
    plastic_strain.width      = 0;
    plastic_strain_rate.width = 0;
    displacement.width        = 0;
    held_by.width             = 0;
    set_size(0);
  }

  namespace
  {
    /** Number of points including the padding. */
    std::size_t
    padded(const std::size_t n)
    {
      const std::size_t lanes = PointBlock::lanes;
      return (n + lanes - 1) / lanes * lanes;
    }
  } // namespace

  void
  PointArrays::set_capacity(const std::size_t n)
  {
    PointState::set_capacity(padded(n));
  }

  unsigned int
  PointArrays::append()
  {
    if (n_padded() != n)
      set_size(n);
    set_size(++n);
    return n - 1;
  }

  void
  PointArrays::pad()
  {
    set_size(n);
    if (n == 0)
      return;
    std::vector<double> last(n_numbers());
    get(n - 1, last.data());
    set_size(padded(n));
    for (std::size_t p = n; p < n_padded(); ++p)
      {
        set(p, last.data());
        mass[p] = volume[p] = 0.;
      }
  }

  void
  PointArrays::reorder(const std::vector<unsigned int> &order)
  {
    PointState::reorder(order);
    n = order.size();
    pad();
  }
} // namespace geocone::GEOCONE_DIM
