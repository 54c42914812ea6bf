// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solvers_nonsmooth_newton_h
#define geocone_solvers_nonsmooth_newton_h

#include <geocone/mechanics/incremental_problem.h>
#include <geocone/solvers/linear_solver.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/timer.h>

#include <string>
#include <vector>

namespace geocone
{
  /** A line of the Newton table: a state and how it was reached. */
  struct NewtonIteration
  {
    double       relative_residual = 0.; ///< norm / force norm
    double       step_length       = 0.; ///< of the step that led here
    double       elastic_blend     = 0.; ///< w in its tangent
    unsigned int n_cone            = 0;
    unsigned int n_apex            = 0;
    unsigned int n_switched        = 0;
  };

  /** What a solve came to. */
  struct SolverReport
  {
    bool         converged      = false;
    unsigned int iterations     = 0; ///< linear systems solved
    unsigned int factorisations = 0;
    unsigned int regularised    = 0;  ///< systems made regular by a blend
    double       residual       = 0.; ///< relative, at the end
    std::vector<NewtonIteration> table;
    std::string                  reason; ///< why it did not converge
  };

  /**
   * Semismooth Newton method for R(v) = 0 with the generalised Jacobian of the
   * closed-form return map (the natural map in the elastic metric, with (s, z)
   * eliminated point by point). The change of the prescribed velocities and the
   * defect of the constraints H v = q enter the first linear system, whose step
   * is full. With multipliers the Schur complement H K^-1 H' is formed by as many
   * more right-hand sides as there are rows. Convergence: |R_free| <=
   * max(tolerance x greatest norm of a part of R, absolute).
   *
   * Globalisation, by name:
   *  - line search: that of line_search.h, along each Newton direction;
   *  - elastic blend: full steps with the tangent (1 - w) C + w D, where
   *    w = min(1/2, |R_free| / |B'V s|), which vanishes with the residual;
   *  - merit search: steps are halved until the merit sum R_i^2 / D_i falls, D
   *    the diagonal of the elastic Jacobian; where that stalls the tangent is
   *    blended, w = max(0.02, 3 w), until it works again;
   *  - none: full Newton steps;
   *  - automatic: for particles the line search, but the merit search for theta <
   *    phi/2 after an elastic start. For FEM the elastic blend for theta < phi/2
   *    without inertia, the line search otherwise; where that fails the other
   *    one from the same start, but for associated flow and for theta < phi/2
   *    with inertia, where a shorter step is the better cure
   *    (doc/performance.md).
   */
  class NonsmoothNewton : public dealii::ParameterAcceptor
  {
  public:
    NonsmoothNewton();

    /** Checks the parameters. */
    void
    prepare();

    /** What a time stepper knows of its problem. */
    struct Hints
    {
      bool particles     = false; ///< the points move
      bool elastic_first = false; ///< take the elastic tangent once
    };

    /**
     * @param[in,out] v in: the start, velocities of t_n; out: the solution
     * @param[out] residual R(v) in all rows: reactions where prescribed
     */
    SolverReport
    solve(IncrementalProblem  &problem,
          SparseMatrix        &matrix,
          LinearSolver        &linear_solver,
          dealii::TimerOutput &timer,
          Vector              &v,
          Vector              &residual,
          const Hints         &hints) const;

    double
    tolerance() const
    {
      return relative_tolerance;
    }

    /** Name of the linear solver that was asked for. */
    const std::string &
    linear_solver_name() const
    {
      return solver_name.value;
    }

  private:
    enum class Globalisation
    {
      line_search,
      elastic_blend,
      merit_search,
      none
    };

    /** solve() with one globalisation; what it spends is added to the report. */
    void
    attempt(const Globalisation  globalisation,
            const Hints         &hints,
            IncrementalProblem  &problem,
            SparseMatrix        &matrix,
            LinearSolver        &linear_solver,
            dealii::TimerOutput &timer,
            Vector              &v,
            Vector              &residual,
            SolverReport        &report) const;

    double       relative_tolerance = 1e-10;
    double       absolute_tolerance = 1e-12;
    unsigned int max_iterations     = 0;
    std::string  globalisation      = "automatic";

    /** Has a section of its own. */
    struct SolverName : dealii::ParameterAcceptor
    {
      SolverName();
      std::string value = "automatic";
    };
    SolverName solver_name;
  };
} // namespace geocone

#endif
