// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solvers_linear_solver_h
#define geocone_solvers_linear_solver_h

#include <geocone/base/sparse_matrix.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * A sparse direct solver. analyse() once per pattern, factorise() once per
   * matrix, solve() once per right-hand side.
   */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /** Orders the unknowns and plans the factorisation of this pattern. */
    virtual void
    analyse(const SparseMatrix &matrix) = 0;

    /**
     * Factorises the values of a matrix with the analysed pattern.
     * @return false if the matrix is singular or, for a Cholesky
     * factorisation, not positive definite; the same on all ranks
     */
    [[nodiscard]] virtual bool
    factorise(const SparseMatrix &matrix) = 0;

    /**
     * Replaces the owned rows of right-hand sides by the solutions.
     * @param x the columns one after another
     */
    virtual void
    solve(std::vector<double> &x, const unsigned int n_columns = 1) = 0;

    /** Whether it takes the lower triangle of a symmetric matrix only. */
    virtual bool
    wants_one_triangle() const = 0;

    virtual std::string
    name() const = 0;
  };

  /**
   * Makes a solver by name:
   *  - Cholmod: supernodal Cholesky of SuiteSparse; one rank, symmetric
   *    positive definite matrices (associated flow);
   *  - Umfpack: unsymmetric multifrontal LU of SuiteSparse; one rank;
   *  - Mumps: distributed multifrontal LU, or LDL' where symmetric;
   *  - automatic: Cholmod or Umfpack on one rank, Mumps on several.
   * @throws InputError for a name that this build lacks, or that cannot do it
   */
  std::unique_ptr<LinearSolver>
  make_linear_solver(const std::string &name,
                     const MPI_Comm     comm,
                     const bool         symmetric);
} // namespace geocone

#endif
