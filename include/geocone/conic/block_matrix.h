// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conic_block_matrix_h
#define geocone_conic_block_matrix_h

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace geocone
{
  /** Sparse symmetric matrix of the free degrees of freedom (dofs), assembled from small
   *  dense blocks, with its Cholesky factors. */
  class BlockMatrix
  {
  public:
    /** Set of small dense matrices (blocks) of equal size, with n_columns dofs
     *  each. */
    struct Set
    {
      unsigned int        n_columns, n_blocks;
      const unsigned int *dofs;
    };

    /** Sets up the sparsity pattern of the free dofs.
     *  @param is_prescribed true for each prescribed dof
     *  @param sets sets of blocks */
    BlockMatrix(const std::vector<bool> &is_prescribed,
                const std::vector<Set>  &sets);

    /** Sets all matrix entries to zero. */
    void
    clear();

    /** Adds a symmetric block to the matrix, given by its upper triangle. */
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
     * Computes the Cholesky factorisation. A relative shift of the diagonal by 1e-15
     * regularises redundant equations.
     * @return true if the matrix is positive definite
     */
    bool
    factorise();

    /** Solves the linear system for the free dofs. All other dofs are set to zero. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    unsigned int n_factorisations = 0;

  private:
    std::vector<int>            row_of_dof;  ///< -1 for a prescribed dof
    std::vector<int>            place;       ///< of matrix entries; or -1
    std::vector<std::size_t>    first_place; ///< first place of each set
    Eigen::SparseMatrix<double> matrix;      ///< lower triangle

    /** Sets the sparsity pattern for the current order of the rows. */
    void
    set_pattern(const std::vector<Set> &sets, const unsigned int n_rows);

    /** Calls f(row, column) for each entry on or below the diagonal of a block. The order
     *  is that of `place`; for a prescribed dof the row or column is negative. */
    template <typename Function>
    void
    for_entries(const Set &set, const Function &f) const;

    class Factors
      : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>
    {
    public:
      /** Returns the position of each row in an elimination order with little fill-in. */
      std::vector<int>
      fill_reducing_order(const Eigen::SparseMatrix<double> &matrix);

      /** Performs the symbolic factorisation without reordering the rows. */
      void
      analyse_natural_order(const Eigen::SparseMatrix<double> &matrix);
    };
    mutable Factors factors;
  };
} // namespace geocone

#endif
