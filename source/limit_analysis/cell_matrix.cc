// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/cell_matrix.h>

#include <algorithm>

namespace geocone
{
  CellMatrix::CellMatrix(const BoundProblem                       &problem,
                         const std::vector<BoundProblem::Strains> &strains)
    : problem(problem)
    , strains(strains)
    , row_of_dof(problem.n_dofs(), -1)
  {
    int n_rows = 0;
    for (unsigned int i = 0; i < problem.n_dofs(); ++i)
      if (!problem.is_prescribed[i])
        row_of_dof[i] = n_rows++;

    // The order of elimination is that of the rows: CHOLMOD then neither permutes
    // nor transposes the matrix of each iteration.
    set_pattern(n_rows);
    const std::vector<int> place_of = factors.fill_reducing_order(matrix);
    for (int &row : row_of_dof)
      if (row >= 0)
        row = place_of[row];
    set_pattern(n_rows);

    const unsigned int n = problem.n_local;
    place.assign(problem.n_cells() * n * n, -1);
    const int *const first = matrix.outerIndexPtr();
    const int *const rows  = matrix.innerIndexPtr();
    for (unsigned int c = 0; c < problem.n_cells(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const int row    = row_of_dof[problem.dofs[n * c + i]],
                      column = row_of_dof[problem.dofs[n * c + j]];
            if (column >= 0 && row >= column)
              place[(c * n + i) * n + j] =
                std::lower_bound(
                  rows + first[column], rows + first[column + 1], row) -
                rows;
          }
    factors.analyse_as_it_is(matrix);
  }

  void
  CellMatrix::set_pattern(const unsigned int n_rows)
  {
    const unsigned int                n = problem.n_local;
    std::vector<Eigen::Triplet<char>> entries;
    entries.reserve(problem.n_cells() * n * (n + 1) / 2);
    for (unsigned int c = 0; c < problem.n_cells(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const int row    = row_of_dof[problem.dofs[n * c + i]],
                      column = row_of_dof[problem.dofs[n * c + j]];
            if (column >= 0 && row >= column)
              entries.emplace_back(row, column, 1);
          }
    Eigen::SparseMatrix<char> pattern(n_rows, n_rows);
    pattern.setFromTriplets(entries.begin(), entries.end());
    matrix = pattern.cast<double>();
  }

  std::vector<int>
  CellMatrix::Factors::fill_reducing_order(
    const Eigen::SparseMatrix<double> &matrix)
  {
    analyzePattern(matrix);
    std::vector<int> place_of(matrix.rows());
    const int *const from = static_cast<const int *>(m_cholmodFactor->Perm);
    for (int i = 0; i < matrix.rows(); ++i)
      place_of[from[i]] = i;
    return place_of;
  }

  void
  CellMatrix::Factors::analyse_as_it_is(
    const Eigen::SparseMatrix<double> &matrix)
  {
    cholmod().nmethods           = 1;
    cholmod().method[0].ordering = CHOLMOD_NATURAL;
    cholmod().postorder          = false; // which the order has been
    analyzePattern(matrix);
  }

  bool
  CellMatrix::factorise(const PointBlocks &blocks)
  {
    double *const values = matrix.valuePtr();
    std::fill(values, values + matrix.nonZeros(), 0.);
    with_n_local(problem, [&](const auto size) {
      constexpr int               n = decltype(size)::value;
      Eigen::Matrix<double, 9, n> CB;
      Eigen::Matrix<double, n, n> cell;
      for (unsigned int c = 0; c < problem.n_cells(); ++c)
        {
          const auto B = fixed<n>(strains[c]);
          for (unsigned int i = 0; i < 3; ++i)
            CB.template middleRows<3>(3 * i).noalias() =
              blocks[3 * c + i] * B.template middleRows<3>(3 * i);
          cell.noalias()    = B.transpose().lazyProduct(CB);
          const int *places = &place[c * n * n];
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              if (const int k = *places++; k >= 0)
                values[k] += cell(i, j);
        }
    });
    for (int j = 0; j < matrix.cols(); ++j) // the diagonal comes first
      values[matrix.outerIndexPtr()[j]] *= 1. + 1e-15;
    factors.factorize(matrix);
    ++n_factorisations;
    return factors.info() == Eigen::Success;
  }

  Eigen::VectorXd
  CellMatrix::solve(const Eigen::VectorXd &rhs) const
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
