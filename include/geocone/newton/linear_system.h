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
   * The linear systems of Newton's method,
   *   [K -H'; H 0] (dv, dlambda) = (r, q),   K = dR/dv on the free dofs:
   * their matrix, its factors, and the solver that makes them. With rows H they
   * are solved by the Schur complement H K^-1 H', which takes as many more
   * right-hand sides as there are rows. What free obstacles add to K, a part U W' of
   * low rank, is inverted by Woodbury's formula, with one more for each column of U.
   */
  class LinearSystem
  {
  public:
    LinearSystem(const LinearSolverParameters &parameters,
                 const MPI_Comm                comm,
                 const bool                    symmetric);

    /** Takes the pattern of a problem's Jacobian, and orders the unknowns anew if
     *  it is another one than before. Collective. */
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

    /** Solves with K, the part of low rank too, and without H. @param columns of
     *  n_owned_rows(), one after another */
    void
    solve_columns(std::vector<double> &columns, const unsigned int n_columns);

    int
    n_owned_rows() const
    {
      return matrix.n_owned;
    }

    /** Entries that are stored on this rank. */
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
    Eigen::MatrixXd               solved_U;  ///< K^-1 U, without its own part
    Eigen::MatrixXd               to_change; ///< (1 + W' K^-1 U)^-1

    bool has_pattern = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
