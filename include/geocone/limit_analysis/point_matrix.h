// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_point_matrix_h
#define geocone_limit_analysis_point_matrix_h

#include <geocone/limit_analysis/point_strains.h>

#include <Eigen/CholmodSupport>
#include <Eigen/Sparse>

#include <vector>

namespace geocone
{
  /** Sparse matrix sum_p B_p' C_p B_p on the free dofs, with a symmetric 3 x 3 block C_p
   *  for each point, and its Cholesky factorisation. */
  class PointMatrix
  {
  public:
    /** Creates the sparsity pattern. @param is_prescribed by dof */
    PointMatrix(const std::vector<bool> &is_prescribed,
                const PointStrains      &strains);

    /** Blocks C_p of all points. */
    using Blocks = std::vector<Eigen::Matrix3d>;

    /**
     * Assembles and factorises the matrix. A relative shift of the diagonal of 1e-15
     * regularises redundant equations.
     * @return whether the matrix is positive definite
     */
    bool
    factorise(const Blocks &blocks);

    /** Solves the linear system for the free dofs; prescribed dofs are set to zero. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    unsigned int n_factorisations = 0;

  private:
    const PointStrains         &strains;
    std::vector<int>            row_of_dof; ///< -1 for prescribed dofs
    std::vector<int>            place;      ///< position of each entry, or -1
    Eigen::SparseMatrix<double> matrix;     ///< lower triangle

    /** Creates the sparsity pattern for the current order of rows. */
    void
    set_pattern(const unsigned int n_rows);

    /** Calls f(row, column) for each entry of the points' matrices on or below the
     *  diagonal, in the order of `place`; row or column is negative for a prescribed
     *  dof. */
    template <typename Function>
    void
    for_entries(const Function &f) const;

    class Factors
      : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>
    {
    public:
      /** Computes the position of each row in a fill-reducing elimination order. */
      std::vector<int>
      fill_reducing_order(const Eigen::SparseMatrix<double> &matrix);

      /** Performs the symbolic factorisation of a matrix that is already in
       *  fill-reducing order. */
      void
      analyse_as_it_is(const Eigen::SparseMatrix<double> &matrix);
    };
    mutable Factors factors;
  };
} // namespace geocone

#endif
