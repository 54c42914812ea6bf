// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_nonsmooth_newton_h
#define geocone_newton_nonsmooth_newton_h

#include <geocone/base/choice.h>
#include <geocone/linear/linear_solver.h>
#include <geocone/newton/plan.h>
#include <geocone/newton/step_workspace.h>
#include <geocone/newton/stress_formulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nonsmooth solver of a step, which runs the attempts of its plan() until one
   * succeeds. NewtonLoop is the iteration; Globalisation and LagContinuation
   * extend its convergence.
   *
   * Friction, by name:
   * - exact: the law at t_{n+1}; otherwise the step is not solved;
   * - automatic: exact if the continuation succeeds, otherwise with the least
   *   lag reached, which is reported.
   */
  class NonsmoothNewton : public dealii::ParameterAcceptor
  {
  public:
    /** @param others additional formulations in the stresses alone */
    explicit NonsmoothNewton(const StressMethods &others = {});

    /** Checks the consistency of the parameters. */
    void
    prepare();

    /**
     * Checks that the formulation applies to this problem, before a step is
     * attempted. Collective.
     * @throws InputError
     */
    void
    check(const IncrementalProblem &problem) const;

    /** Hints of the time stepper for a solve. */
    struct Hints
    {
      bool elastic_first = false; ///< use the elastic tangent once

      /** Largest SolverReport::excess_share of a solved step. */
      double accepted_excess = std::numeric_limits<double>::infinity();
    };

    /**
     * Solves a step.
     * @param[in,out] v in: initial guess, velocities of t_n; out: the solution
     * @param[out] residual R(v) in all rows: reactions at prescribed dofs
     */
    SolverReport
    solve(IncrementalProblem  &problem,
          LinearSystem        &system,
          dealii::TimerOutput &timer,
          Vector              &v,
          Vector              &residual,
          const Hints         &hints) const;

    /** Tolerances and numbers of iterations by the parameters. */
    StepLimits
    limits() const
    {
      return {relative_tolerance, absolute_tolerance, max_iterations};
    }

    /** Value of 'Newton/Formulation'. */
    std::string
    formulation_name() const
    {
      return formulation.word();
    }

    /** Whether only the exact law is acceptable: by parameter, or because a
     *  formulation in stresses alone has no other. */
    bool
    wants_exact_friction() const
    {
      return friction.kind == Friction::Kind::exact || of_stresses() ||
             first_iterate_of_stresses();
    }

    /** Parameters of the linear solver. */
    const LinearSolverParameters &
    linear_solver() const
    {
      return linear;
    }

  private:
    const StressMethods others;

    Choice<Formulation> formulation;

    Choice<GlobalisationMethod> globalisation = {
      {{"automatic", GlobalisationMethod::automatic},
       {"line search", GlobalisationMethod::line_search},
       {"elastic blend", GlobalisationMethod::elastic_blend},
       {"merit search", GlobalisationMethod::merit_search},
       {"lag continuation", GlobalisationMethod::lag_continuation},
       {"none", GlobalisationMethod::none}}};

    enum class Start
    {
      at_t_n,
      fixed_point,
      of_stresses ///< the first of StressMethods::first_iterates; others follow
    };
    Choice<Start> first_iterate;

    double       relative_tolerance   = 1e-10;
    double       absolute_tolerance   = 1e-12;
    unsigned int max_iterations       = 0;
    double       rho                  = 0.03;
    unsigned int first_iterate_sweeps = 10;

    LinearSolverParameters linear;

    /** Friction parameters, in the section of the time discretisation. */
    struct Friction : dealii::ParameterAcceptor
    {
      Friction();
      enum class Kind
      {
        automatic,
        exact
      };
      Choice<Kind> kind = {
        {{"automatic", Kind::automatic}, {"exact", Kind::exact}}};
    };
    Friction friction;

    /** Chosen formulation if the stresses are its only unknowns. */
    const StressFormulation *
    of_stresses() const;

    /** Chosen first iterate if it solves for the stresses alone. */
    const FirstIterate *
    first_iterate_of_stresses() const;

    /** Newton iterations by a line of the plan, from the iterate.
     *  @param start_of_s initial s of the natural map (Pa) */
    void
    iterate(const Try                 &next,
            const bool                 elastic_first,
            const std::vector<Mandel> &start_of_s,
            const StepWorkspace       &work) const;

    /** Lag continuation by a line of the plan, from the iterate.
     *  @param accepted_excess see Hints */
    void
    continue_from_lag(const Try           &next,
                      const bool           elastic_first,
                      const double         accepted_excess,
                      const StepWorkspace &work) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
