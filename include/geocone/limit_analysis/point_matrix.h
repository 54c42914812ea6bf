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
  /** Matrix sum_p B_p' C_p B_p of the free dofs of some points, C_p symmetric 3 x 3,
   *  with its Cholesky factors. */
  class PointMatrix
  {
  public:
    /** @param is_prescribed by dof */
    PointMatrix(const std::vector<bool> &is_prescribed,
                const PointStrains      &strains);

    /** C_p of all points. */
    using Blocks = std::vector<Eigen::Matrix3d>;

    /**
     * Assembles and factorises. A relative shift of the diagonal of 1e-15 regularises
     * redundant equations.
     * @return whether the matrix is positive definite
     */
    bool
    factorise(const Blocks &blocks);

    /** Solves for the free dofs; all others are zero. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    unsigned int n_factorisations = 0;

  private:
    const PointStrains         &strains;
    std::vector<int>            row_of_dof; ///< or -1
    std::vector<int>            place;      ///< of each entry, or -1
    Eigen::SparseMatrix<double> matrix;     ///< lower triangle

    /** Sets the sparsity pattern for rows in their present order. */
    void
    set_pattern(const unsigned int n_rows);

    /** Calls f(row, column) for each entry on or below the diagonal of a point, in the
     *  order of `place`; negative where a dof is prescribed. */
    template <typename Function>
    void
    for_entries(const Function &f) const;

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
