// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conic/block_matrix.h>

#include <algorithm>
#include <mutex>
#include <numeric>

namespace geocone
{
  namespace
  {
    /** Blocks of a set whose dofs differ from those of the block before, as of the points
     *  of a cell. */
    struct DistinctBlocks
    {
      explicit DistinctBlocks(const BlockMatrix::Set &set)
      {
        const unsigned int  n    = set.n_columns;
        const unsigned int *from = set.dofs;
        for (unsigned int p = 0; p < set.n_blocks; ++p, from += n)
          {
            if (p == 0 || !std::equal(from, from + n, from - n))
              dofs.insert(dofs.end(), from, from + n);
            number.push_back(dofs.size() / n - 1);
          }
      }

      std::vector<unsigned int> dofs;
      std::vector<unsigned int>
        number; ///< of each block among the distinct ones
    };
  } // namespace

  BlockMatrix::BlockMatrix(const std::vector<bool> &is_prescribed,
                           const std::vector<Set>  &all_sets)
    : row_of_dof(is_prescribed.size(), -1)
  {
    std::vector<DistinctBlocks> distinct(all_sets.begin(), all_sets.end());
    std::vector<Set>            sets;
    for (unsigned int i = 0; i < all_sets.size(); ++i)
      {
        const unsigned int n = all_sets[i].n_columns;
        sets.push_back(
          {n,
           n == 0 ? 0U : static_cast<unsigned int>(distinct[i].dofs.size() / n),
           distinct[i].dofs.data()});
      }
    int n_rows = 0;
    for (unsigned int i = 0; i < is_prescribed.size(); ++i)
      if (!is_prescribed[i])
        row_of_dof[i] = n_rows++;

    // The rows are in elimination order, so that CHOLMOD neither permutes nor
    // transposes the matrix of each iteration.
    set_pattern(sets, n_rows);
    const std::vector<int> place_of = factors.fill_reducing_order(matrix);
    for (int &row : row_of_dof)
      if (row >= 0)
        row = place_of[row];
    set_pattern(sets, n_rows);

    const int *const first = matrix.outerIndexPtr();
    const int *const rows  = matrix.innerIndexPtr();
    for (unsigned int i = 0; i < sets.size(); ++i)
      {
        std::vector<int> places;
        for_entries(sets[i], [&](const int row, const int column) {
          places.push_back(column < 0
                             ? -1
                             : std::lower_bound(rows + first[column],
                                                rows + first[column + 1],
                                                row) -
                                 rows);
        });
        const std::size_t n =
          std::size_t(sets[i].n_columns) * (sets[i].n_columns + 1) / 2;
        first_place.push_back(place.size());
        for (const unsigned int block : distinct[i].number)
          place.insert(place.end(),
                       places.begin() + n * block,
                       places.begin() + n * (block + 1));
      }
    factors.analyse_natural_order(matrix);
  }

  template <typename Function>
  void
  BlockMatrix::for_entries(const Set &set, const Function &f) const
  {
    const unsigned int *dofs = set.dofs;
    for (unsigned int p = 0; p < set.n_blocks; ++p, dofs += set.n_columns)
      for (unsigned int i = 0; i < set.n_columns; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          {
            const int a = row_of_dof[dofs[i]], b = row_of_dof[dofs[j]];
            f(std::max(a, b), std::min(a, b));
          }
  }

  void
  BlockMatrix::set_pattern(const std::vector<Set> &sets,
                           const unsigned int      n_rows)
  {
    // Rows of each column, diagonal first, with duplicates.
    std::vector<std::size_t> end(n_rows + 1, 0);
    for (unsigned int j = 0; j < n_rows; ++j)
      end[j + 1] = 1;
    for (const Set &set : sets)
      for_entries(set, [&](const int, const int column) {
        if (column >= 0)
          ++end[column + 1];
      });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<int>         rows(end[n_rows]);
    std::vector<std::size_t> next(end.begin(), end.end() - 1);
    for (unsigned int j = 0; j < n_rows; ++j)
      rows[next[j]++] = j;
    for (const Set &set : sets)
      for_entries(set, [&](const int row, const int column) {
        if (column >= 0)
          rows[next[column]++] = row;
      });

    matrix.resize(n_rows, n_rows);
    int *const first = matrix.outerIndexPtr();
    auto       last  = rows.begin();
    for (unsigned int j = 0; j < n_rows; ++j)
      {
        const auto from = rows.begin() + end[j], to = rows.begin() + end[j + 1];
        std::sort(from, to);
        first[j] = last - rows.begin();
        last     = std::copy(from, std::unique(from, to), last);
      }
    first[n_rows] = last - rows.begin();
    matrix.resizeNonZeros(first[n_rows]);
    std::copy(rows.begin(), last, matrix.innerIndexPtr());
    std::fill_n(matrix.valuePtr(), first[n_rows], 1.);
  }

  std::vector<int>
  BlockMatrix::Factors::fill_reducing_order(
    const Eigen::SparseMatrix<double> &matrix)
  {
    // METIS draws from the random numbers of the process, which it seeds first.
    static std::mutex                 in_use;
    const std::lock_guard<std::mutex> lock(in_use);
    analyzePattern(matrix);
    std::vector<int> place_of(matrix.rows());
    const int *const from = static_cast<const int *>(m_cholmodFactor->Perm);
    for (int i = 0; i < matrix.rows(); ++i)
      place_of[from[i]] = i;
    return place_of;
  }

  void
  BlockMatrix::Factors::analyse_natural_order(
    const Eigen::SparseMatrix<double> &matrix)
  {
    cholmod().print              = 0; // a failure is a value here
    cholmod().nmethods           = 1;
    cholmod().method[0].ordering = CHOLMOD_NATURAL;
    cholmod().postorder          = false; // the rows are in postorder
    analyzePattern(matrix);
  }

  void
  BlockMatrix::clear()
  {
    std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.);
  }

  bool
  BlockMatrix::factorise()
  {
    double *const values = matrix.valuePtr();
    for (int j = 0; j < matrix.cols(); ++j) // the diagonal comes first
      values[matrix.outerIndexPtr()[j]] *= 1. + 1e-15;
    factors.factorize(matrix);
    ++n_factorisations;
    return factors.info() == Eigen::Success;
  }

  Eigen::VectorXd
  BlockMatrix::solve(const Eigen::VectorXd &rhs) const
  {
    Eigen::VectorXd own(matrix.rows());
    for (unsigned int i = 0; i < rhs.size(); ++i)
      if (row_of_dof[i] >= 0)
        own[row_of_dof[i]] = rhs[i];
    own               = factors.solve(own).eval();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(rhs.size());
    for (unsigned int i = 0; i < rhs.size(); ++i)
      if (row_of_dof[i] >= 0)
        x[i] = own[row_of_dof[i]];
    return x;
  }
} // namespace geocone
