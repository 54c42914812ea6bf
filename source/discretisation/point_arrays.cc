// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/point_arrays.h>
#include <geocone/materials/point_block.h>

namespace geocone
{
  PointArrays::PointArrays(const unsigned int material,
                           const unsigned int n_history,
                           const bool         affine)
    : material(material)
    , n_history(n_history)
    , affine(affine)
    , data(n_common + n_history + (affine ? dim * dim : 0))
  {}

  namespace
  {
    /** Points with those that fill up the last vector. */
    std::size_t
    padded(const std::size_t n)
    {
      const std::size_t lanes = PointBlock::lanes;
      return (n + lanes - 1) / lanes * lanes;
    }
  } // namespace

  void
  PointArrays::reserve(const std::size_t n)
  {
    for (std::vector<double> &array : data)
      array.reserve(padded(n));
    id.reserve(n);
  }

  void
  PointArrays::append(const double *values, const unsigned int new_id)
  {
    unpad();
    for (unsigned int field = 0; field < data.size(); ++field)
      data[field].push_back(values[field]);
    id.push_back(new_id);
  }

  void
  PointArrays::unpad()
  {
    if (data[0].size() != id.size())
      for (std::vector<double> &array : data)
        array.resize(id.size());
  }

  void
  PointArrays::pad()
  {
    unpad();
    const std::size_t n = id.size();
    for (unsigned int field = 0; field < data.size(); ++field)
      data[field].resize(
        padded(n),
        n == 0 || field == mass || field == volume ? 0. : data[field].back());
  }

  void
  PointArrays::reorder(const std::vector<unsigned int> &order)
  {
    unpad();
    for (std::vector<double> &array : data)
      {
        buffer.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i)
          buffer[i] = array[order[i]];
        // Copied, not swapped: one buffer serves all arrays for ever.
        array.assign(buffer.begin(), buffer.end());
      }
    std::vector<unsigned int> new_id(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      new_id[i] = id[order[i]];
    id.swap(new_id);
    if (!cell.empty())
      {
        new_id.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i)
          new_id[i] = cell[order[i]];
        cell.swap(new_id);
      }
    pad();
  }

  std::size_t
  PointArrays::memory() const
  {
    std::size_t bytes =
      (id.capacity() + cell.capacity()) * sizeof(unsigned int) +
      buffer.capacity() * sizeof(double);
    for (const std::vector<double> &array : data)
      bytes += array.capacity() * sizeof(double);
    return bytes;
  }
} // namespace geocone
