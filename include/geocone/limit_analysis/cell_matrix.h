// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_cell_matrix_h
#define geocone_limit_analysis_cell_matrix_h

#include <geocone/limit_analysis/bound_problem.h>

#include <Eigen/CholmodSupport>
#include <Eigen/Sparse>

#include <vector>

namespace geocone
{
  /**
   * The matrix sum_c B_c' C_c B_c of the free dofs of a BoundProblem, C_c
   * symmetric 9 x 9, with its Cholesky factors.
   */
  class CellMatrix
  {
  public:
    /** @param strains B of each cell */
    CellMatrix(const BoundProblem                       &problem,
               const std::vector<BoundProblem::Strains> &strains);

    /** Three blocks on the diagonal of C_c, one for each point. */
    using PointBlocks = std::vector<Eigen::Matrix3d>;

    /**
     * Assembles and factorises; the diagonal is raised by a part of 1e-15, for
     * redundant equations.
     * @return whether it is positive definite
     */
    bool
    factorise(const PointBlocks &blocks);

    /** Solves in the free dofs; others are zero. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &rhs) const;

    unsigned int n_factorisations = 0;

  private:
    const BoundProblem                       &problem;
    const std::vector<BoundProblem::Strains> &strains;
    std::vector<int>                          row_of_dof; ///< or -1
    std::vector<int>            place;  ///< of entries of the cells
    Eigen::SparseMatrix<double> matrix; ///< lower triangle

    /** Makes the matrix, empty, of the rows as they are numbered. */
    void
    set_pattern(const unsigned int n_rows);

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
