// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_jacobian_pattern_h
#define geocone_conditions_jacobian_pattern_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/conditions/unknowns.h>
#include <geocone/points/material_points.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * The Jacobian of the free dofs: nodes that share a cell with points meet in it.
   * It knows where in the matrix the entries of a cell and the diagonal stand.
   */
  class JacobianPattern
  {
  public:
    /** Of no cells. */
    JacobianPattern() = default;

    /**
     * @param groups more nodes that meet
     * @param links a node, and others whose rows take up its own (Contact::links())
     * @param one_triangle whether the lower triangle of a symmetric matrix is
     * enough
     * @param[out] matrix with the pattern, and zero values
     */
    JacobianPattern(const MaterialPoints                           &points,
                    const Unknowns                                 &unknowns,
                    const MPI_Comm                                  comm,
                    const std::vector<std::array<unsigned int, 3>> &groups,
                    const std::vector<std::vector<unsigned int>>   &links,
                    const bool    one_triangle,
                    SparseMatrix &matrix);

    /** Whether only the entries i <= j of a cell's matrix are taken. */
    bool
    is_one_triangle() const
    {
      return one_triangle;
    }

    /** matrix += K of a cell, row-major (dim n)^2, rows interleaved as v_x, v_y, ... */
    template <int n>
    void
    add_cell(const unsigned int c, const double *K, SparseMatrix &matrix) const
    {
      constexpr int m     = dim * n;
      const int    *place = &places[c * places_of_cell];
      for (int i = 0; i < m; ++i)
        for (int j = one_triangle ? i : 0; j < m; ++j, ++place)
          if (*place >= 0)
            matrix.value[*place] += K[m * i + j];
    }

    /** matrix += a value where two free rows meet; of the entries of a symmetric
     *  matrix those of its other triangle are left out. */
    void
    add_entry(const int     row,
              const int     column,
              const double  value,
              SparseMatrix &matrix) const
    {
      if (!one_triangle || column <= row)
        matrix.value[matrix.entry(row, column)] += value;
    }

    /** matrix += a value on the diagonal of a free row. */
    void
    add_diagonal(const int row, const double value, SparseMatrix &matrix) const
    {
      matrix.value[diagonal[row]] += value;
    }

  private:
    bool one_triangle = false;

    /**
     * Per cell the places in the matrix of its (dim n_nodes)^2 entries, or of
     * one of each symmetric pair if one triangle is stored; -1 for prescribed.
     */
    std::vector<int> places;
    std::size_t      places_of_cell = 0;

    /** Place of the diagonal entry of each free row. */
    std::vector<int> diagonal;
  };
} // namespace geocone::GEOCONE_DIM

#endif
