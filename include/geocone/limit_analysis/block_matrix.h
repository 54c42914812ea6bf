// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_block_matrix_h
#define geocone_limit_analysis_block_matrix_h

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace geocone
{
  /** Sparse symmetric matrix of the free dofs, a sum of small dense blocks, with its
   *  Cholesky factors. */
  class BlockMatrix
  {
  public:
    /** Blocks of one size: n_columns dofs each. */
    struct Set
    {
      unsigned int        n_columns, n_blocks;
      const unsigned int *dofs;
    };

    /** @param is_prescribed by dof */
    BlockMatrix(const std::vector<bool> &is_prescribed,
                const std::vector<Set>  &sets);

    /** Sets all entries to zero. */
    void
    clear();

    /** Adds a block, the symmetric part of which is given by its upper triangle. */
    template <int n>
    void
    add(const unsigned int                 set,
        const unsigned int                 number,
        const Eigen::Matrix<double, n, n> &block)
    {
      const int *places =
        &place[first_place[set] + std::size_t(n * (n + 1) / 2) * number];
      double *const values = matrix.valuePtr();
      for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j)
          if (const int k = *places++; k >= 0)
            values[k] += block(j, i);
    }

    /**
     * Factorises. A relative shift of the diagonal of 1e-15 regularises redundant
     * equations.
     * @return whether the matrix is positive definite
     */
    bool
    factorise();

    /** Solves for the free dofs; all others are zero. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    unsigned int n_factorisations = 0;

  private:
    std::vector<int>            row_of_dof;  ///< or -1
    std::vector<int>            place;       ///< of each entry, or -1
    std::vector<std::size_t>    first_place; ///< of each set
    Eigen::SparseMatrix<double> matrix;      ///< lower triangle

    /** Sets the sparsity pattern for rows in their present order. */
    void
    set_pattern(const std::vector<Set> &sets, const unsigned int n_rows);

    /** Calls f(row, column) for each entry on or below the diagonal of a block, in the
     *  order of `place`; negative where a dof is prescribed. */
    template <typename Function>
    void
    for_entries(const Set &set, const Function &f) const;

    class Factors
      : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>
    {
    public:
      /** Position of each row in an elimination order with little fill. */
      std::vector<int>
      fill_reducing_order(const Eigen::SparseMatrix<double> &matrix);

      /** Analyses a matrix that is already in such an order. */
      void
      analyse_as_it_is(const Eigen::SparseMatrix<double> &matrix);
    };
    mutable Factors factors;
  };
} // namespace geocone

#endif
