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
  /**
   * The matrix sum_p B_p' C_p B_p of the free dofs of some points, C_p symmetric 3 x 3,
   * with its Cholesky factors.
   */
  class PointMatrix
  {
  public:
    /** @param is_prescribed by dof */
    PointMatrix(const std::vector<bool> &is_prescribed,
                const PointStrains      &strains);

    /** C_p of all points. */
    using Blocks = std::vector<Eigen::Matrix3d>;

    /**
     * Assembles and factorises; the diagonal is raised by a part of 1e-15, for
     * redundant equations.
     * @return whether it is positive definite
     */
    bool
    factorise(const Blocks &blocks);

    /** Solves in the free dofs; others are zero. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    unsigned int n_factorisations = 0;

  private:
    const PointStrains         &strains;
    std::vector<int>            row_of_dof; ///< or -1
    std::vector<int>            place;      ///< of entries of the points, or -1
    Eigen::SparseMatrix<double> matrix;     ///< lower triangle

    /** Makes the matrix, empty, of the rows as they are numbered. */
    void
    set_pattern(const unsigned int n_rows);

    /** Calls f(row, column) for each entry on or below the diagonal that a point has,
     *  in the order of `place`; negative where a dof is prescribed. */
    template <typename Function>
    void
    for_entries(const Function &f) const;

    class Factors
      : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>
    {
    public:
      /** The place of each row in an order of elimination with little fill. */
      std::vector<int>
      fill_reducing_order(const Eigen::SparseMatrix<double> &matrix);

      /** For a matrix that is in such an order. */
      void
      analyse_as_it_is(const Eigen::SparseMatrix<double> &matrix);
    };
    mutable Factors factors;
  };
} // namespace geocone

#endif
