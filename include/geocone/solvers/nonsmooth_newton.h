// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solvers_nonsmooth_newton_h
#define geocone_solvers_nonsmooth_newton_h

#include <geocone/mechanics/reduced_problem.h>
#include <geocone/solvers/reduced_report.h>
#include <geocone/solvers/step_workspace.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
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
   *    w = min(1/2, c |R_free| / |B'V s|) vanishes with the residual; c = 0.3 with
   *    the return map, 0.05 with the natural map;
   *  - merit search: steps are halved until the merit sum R_i^2 / D_i falls, D
   *    the diagonal of the elastic Jacobian; where that stalls the tangent is
   *    blended, w = max(0.02, 3 w), until it works again;
   *  - lag continuation: friction that lags is easy (its law is nearer to
   *    associated flow, and explicit at lag 1), so that the exact law is reached
   *    on a path of solutions whose lag falls from 1/2 to 0; each is the start
   *    of the next, with the line search;
   *  - none: full Newton steps.
   * Formulation and globalisation automatic: for theta >= phi/2 the return map
   * with the line search. Otherwise, and where that fails, the natural map with
   * the elastic blend: the stress is an unknown that obeys the law at the end
   * only, and iterations that would cycle between modes of points get around.
   * What is not solved so, without associated flow, the lag continuation tries
   * (doc/performance.md compares them).
   *
   * Friction, by name:
   *  - exact: the law at t_{n+1}, or the step is not solved;
   *  - delayed: the law with `Friction lag`, a time discretisation of first order;
   *  - automatic: exact where the continuation gets there, and otherwise with the
   *    least lag that it has reached, which the report tells.
   */
  class NonsmoothNewton : public dealii::ParameterAcceptor
  {
  public:
    NonsmoothNewton();

    /** Checks the parameters with each other. */
    void
    prepare();

    /**
     * Checks whether the formulation can be that of this problem, before a step
     * is tried. Collective.
     * @throws InputError
     */
    void
    check(const IncrementalProblem &problem) const;

    /** What a time stepper knows of its problem. */
    struct Hints
    {
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

    /**
     * Solves a reduced problem that is given as such: by Gauss-Seidel if that is
     * the formulation, by Newton's method with the natural map or, for all other
     * formulations, with the return map.
     * @param[in,out] s stresses in cone axes (Pa)
     */
    ReducedReport
    solve_reduced(const ReducedProblem &problem, Eigen::VectorXd &s) const;

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

    /** A Newton iteration with one globalisation at one lag. */
    struct Attempt
    {
      Globalisation globalisation = Globalisation::line_search;
      double        tolerance     = 0.; ///< relative
      double        friction_lag  = 0.;
      unsigned int  allowed       = 0; ///< iterations, more where it converges
      bool          elastic_first = false;
      bool          moves         = false; ///< solves once at least

      /** Start of s for the natural map (Pa), or null: the return map. */
      const std::vector<Mandel> *natural_map_start = nullptr;
    };

    /** Whether the stresses alone are the unknowns. */
    bool
    is_reduced() const;

    /** Runs an attempt from v; what it spends is added to the report. */
    void
    run(const Attempt &attempt, const StepWorkspace &work) const;

    /** Follows the solutions from `lag` down to 0, or as far as it gets. */
    void
    continue_to_exact_law(const double         lag,
                          const unsigned int   allowed,
                          const Hints         &hints,
                          const StepWorkspace &work) const;

    /** Solves the law with one lag, from friction that is explicit if need be. */
    void
    solve_delayed(const double         lag,
                  const double         tolerance,
                  const Hints         &hints,
                  const StepWorkspace &work) const;

    double       relative_tolerance   = 1e-10;
    double       absolute_tolerance   = 1e-12;
    unsigned int max_iterations       = 0;
    std::string  globalisation        = "automatic";
    std::string  formulation          = "automatic";
    double       rho                  = 0.03;
    std::string  first_iterate        = "none";
    unsigned int first_iterate_sweeps = 10;

    /** Has a section of its own. */
    struct SolverName : dealii::ParameterAcceptor
    {
      SolverName();
      std::string value = "automatic";
    };
    SolverName solver_name;

    /** Part of the time discretisation, and of its section. */
    struct Friction : dealii::ParameterAcceptor
    {
      Friction();
      std::string kind = "automatic";
      double      lag  = 0.5;
    };
    Friction friction;
  };
} // namespace geocone

#endif
