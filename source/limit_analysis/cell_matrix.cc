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

    const unsigned int                n = problem.n_local;
    std::vector<Eigen::Triplet<char>> entries;
    entries.reserve(problem.n_cells() * n * (n + 1) / 2);
    for (unsigned int c = 0; c < problem.n_cells(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const int row    = row_of_dof[problem.dofs[n * c + i]],
                      column = row_of_dof[problem.dofs[n * c + j]];
            if (row >= 0 && column >= row)
              entries.emplace_back(row, column, 1);
          }
    Eigen::SparseMatrix<char> pattern(n_rows, n_rows);
    pattern.setFromTriplets(entries.begin(), entries.end());
    matrix = pattern.cast<double>();

    place.assign(problem.n_cells() * n * n, -1);
    const int *const first = matrix.outerIndexPtr();
    const int *const rows  = matrix.innerIndexPtr();
    for (unsigned int c = 0; c < problem.n_cells(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const int row    = row_of_dof[problem.dofs[n * c + i]],
                      column = row_of_dof[problem.dofs[n * c + j]];
            if (row >= 0 && column >= row)
              place[(c * n + i) * n + j] =
                std::lower_bound(
                  rows + first[column], rows + first[column + 1], row) -
                rows;
          }
    factors.analyzePattern(matrix);
  }

  bool
  CellMatrix::factorise(const PointBlocks &blocks)
  {
    const unsigned int n      = problem.n_local;
    double *const      values = matrix.valuePtr();
    std::fill(values, values + matrix.nonZeros(), 0.);
    BoundProblem::Strains CB(9, n);
    Eigen::MatrixXd       cell(n, n);
    for (unsigned int c = 0; c < problem.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < 3; ++i)
          CB.middleRows<3>(3 * i).noalias() =
            blocks[3 * c + i] * strains[c].middleRows<3>(3 * i);
        cell.noalias() = strains[c].transpose() * CB;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            if (const int k = place[(c * n + i) * n + j]; k >= 0)
              values[k] += cell(i, j);
      }
    for (int j = 0; j < matrix.cols(); ++j) // the diagonal comes last
      values[matrix.outerIndexPtr()[j + 1] - 1] *= 1. + 1e-15;
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
