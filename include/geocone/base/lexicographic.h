// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_lexicographic_h
#define geocone_base_lexicographic_h

#include <geocone/base/types.h>

#include <array>
#include <cstddef>

namespace geocone::GEOCONE_DIM
{
  /** Multi-index of a structured grid, or number of grid entries per
   *  direction. The first direction varies fastest. */
  using GridIndex = std::array<unsigned int, dim>;

  /** Returns the multi-index (n, ..., n): a structured grid with n entries in
   *  each direction. */
  inline GridIndex
  equal_sizes(const unsigned int n)
  {
    GridIndex sizes;
    sizes.fill(n);
    return sizes;
  }

  /** Converts a lexicographic index to the multi-index of a structured grid. */
  inline GridIndex
  index_in_grid(std::size_t number, const GridIndex &sizes)
  {
    GridIndex index;
    for (unsigned int d = 0; d < dim; ++d)
      {
        index[d] = number % sizes[d];
        number /= sizes[d];
      }
    return index;
  }

  /** Converts a multi-index of a structured grid to its lexicographic index.
   *  Inverse of index_in_grid(). */
  inline std::size_t
  number_in_grid(const GridIndex &index, const GridIndex &sizes)
  {
    std::size_t number = 0;
    for (unsigned int d = dim; d-- > 0;)
      number = number * sizes[d] + index[d];
    return number;
  }

  /** Total number of entries of a structured grid. */
  inline std::size_t
  grid_volume(const GridIndex &sizes)
  {
    std::size_t n = 1;
    for (const unsigned int size : sizes)
      n *= size;
    return n;
  }
} // namespace geocone::GEOCONE_DIM

#endif
