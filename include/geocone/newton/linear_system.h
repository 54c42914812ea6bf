// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_linear_system_h
#define geocone_newton_linear_system_h

#include <geocone/linear/linear_solver.h>
#include <geocone/problem/incremental_problem.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Linear systems of Newton's method,
   *   [K -H'; H 0] (dv, dlambda) = (r, q),   K = dR/dv on the free dofs:
   * their matrix, its factors, and the linear solver. Rows H are treated by the
   * Schur complement H K^-1 H', with one more right-hand side for each row. The
   * contribution of free obstacles to K, a part U W' of low rank, is inverted
   * by Woodbury's formula, with one more right-hand side for each column of U.
   */
  class LinearSystem
  {
  public:
    LinearSystem(const LinearSolverParameters &parameters,
                 const MPI_Comm                comm,
                 const bool                    symmetric);

    /** Sets the pattern to that of a problem's Jacobian, with a new ordering of
     *  the unknowns if it differs from the previous one. Collective. */
    void
    set_pattern(IncrementalProblem &problem, dealii::TimerOutput &timer);

    /**
     * Assembles and factorises dR/dv at the last residual(), with an elastic
     * blend.
     * @return whether it is regular; the same on all ranks
     */
    [[nodiscard]] bool
    factorise(const IncrementalProblem &problem,
              const double              elastic_blend,
              dealii::TimerOutput      &timer);

    /**
     * Solves with the last factors.
     * @param defect q
     * @param[in,out] x owned free rows: r in, dv out
     */
    void
    solve(const Unknowns        &unknowns,
          const Eigen::VectorXd &defect,
          std::vector<double>   &x);

    /** Solves with K, including the low-rank part, and without H. @param
     *  columns of n_owned_rows(), one after another */
    void
    solve_columns(std::vector<double> &columns, const unsigned int n_columns);

    int
    n_owned_rows() const
    {
      return matrix.n_owned;
    }

    /** Number of entries stored on this rank. */
    std::size_t
    n_nonzeros() const
    {
      return matrix.column.size();
    }

    std::string
    solver_name() const
    {
      return solver->name();
    }

  private:
    std::unique_ptr<LinearSolver> solver;
    MPI_Comm                      comm;
    SparseMatrix                  matrix;
    LowRank                       low_rank;
    Eigen::MatrixXd               solved_U;  ///< K^-1 U, without low-rank part
    Eigen::MatrixXd               to_change; ///< (1 + W' K^-1 U)^-1

    bool has_pattern = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
