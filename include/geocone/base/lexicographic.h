// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_lexicographic_h
#define geocone_base_lexicographic_h

#include <geocone/base/types.h>

#include <array>
#include <cstddef>

namespace geocone::GEOCONE_DIM
{
  /** Index, or number of entries, along each direction of a grid; the first
   *  direction runs fastest. */
  using GridIndex = std::array<unsigned int, dim>;

  /** The same number of entries along each direction. */
  inline GridIndex
  equal_sizes(const unsigned int n)
  {
    GridIndex sizes;
    sizes.fill(n);
    return sizes;
  }

  /** Grid index of a lexicographic number, for given grid sizes. */
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

  /** Lexicographic number of a grid index, the inverse of index_in_grid(). */
  inline std::size_t
  number_in_grid(const GridIndex &index, const GridIndex &sizes)
  {
    std::size_t number = 0;
    for (unsigned int d = dim; d-- > 0;)
      number = number * sizes[d] + index[d];
    return number;
  }

  /** Number of entries of a grid of given sizes. */
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
