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
   * Matrix, factorisation and solver of the linear systems in Newton's method.
   * The systems are
   *   [K -H'; H 0] (dv, dlambda) = (r, q),   K = dR/dv on the free dofs.
   * The constraint rows H are eliminated by the Schur complement H K^-1 H',
   * with one additional right-hand side per row. Pore pressures add rows to K
   * (PorePressures). The contribution of free
   * obstacles to K, U W' of low rank, is inverted by Woodbury's formula, with
   * one additional right-hand side per column of U.
   */
  class LinearSystem
  {
  public:
    /** @param vertices interpolation from the vertices of the mesh; selects
     *  p-multigrid unless null */
    LinearSystem(const LinearSolverParameters              &parameters,
                 const MPI_Comm                             comm,
                 const bool                                 symmetric,
                 std::shared_ptr<const VertexInterpolation> vertices = nullptr);

    /** Sets the tolerance of the next linear systems, for iterative solvers. */
    void
    set_tolerance(const double tolerance)
    {
      solver->set_tolerance(tolerance);
    }

    /** Sets the sparsity pattern of the Jacobian of a problem. The unknowns are
     *  reordered if the pattern has changed. Collective. */
    void
    set_pattern(IncrementalProblem &problem, dealii::TimerOutput &timer);

    /**
     * Assembles and factorises the Jacobian dR/dv of the residual R at the
     * iterate of its last evaluation. The tangent contains a fraction
     * elastic_blend of elastic stiffness.
     * @return whether the matrix is regular; the same on all ranks
     */
    [[nodiscard]] bool
    factorise(const IncrementalProblem &problem,
              const double              elastic_blend,
              dealii::TimerOutput      &timer);

    /**
     * Solves the linear system with the last factorisation.
     * @param defect q
     * @param[in,out] x owned free rows: r in, dv out
     */
    void
    solve(const Unknowns        &unknowns,
          const Eigen::VectorXd &defect,
          std::vector<double>   &x);

    /** Solves K X = B for a matrix B of right-hand sides with the factorised
     *  Jacobian K, without the constraints H v = q. The low-rank part of K is
     *  included.
     *  @param columns B in, X out, n_owned_rows() entries per column */
    void
    solve_columns(std::vector<double> &columns, const unsigned int n_columns);

    int
    n_owned_rows() const
    {
      return matrix.n_owned;
    }

    /** Number of nonzero (stored) matrix entries on this MPI rank. */
    std::size_t
    n_nonzeros() const
    {
      return matrix.value.size();
    }

    const LinearSolver &
    linear_solver() const
    {
      return *solver;
    }

  private:
    /** Solves with the factorised matrix, without the low-rank contribution.
     *  Rows of pore pressures have zero right-hand sides. */
    void
    solve_factorised(std::vector<double> &columns,
                     const unsigned int   n_columns);

    std::unique_ptr<LinearSolver> solver;
    MPI_Comm                      comm;
    SparseMatrix                  matrix;  ///< of the velocities
    SparseMatrix                  coupled; ///< with rows of pore pressures
    PorePressures                *pressures = nullptr;
    std::shared_ptr<const VertexInterpolation> vertices;
    LowRank                       low_rank;
    Eigen::MatrixXd               solved_U;  ///< K^-1 U, K without U W'
    Eigen::MatrixXd               to_change; ///< (1 + W' K^-1 U)^-1, Woodbury

    bool has_pattern = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
