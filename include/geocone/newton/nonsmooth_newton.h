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
   * Nonsmooth Newton solver for the incremental problem of a step. The attempts
   * of the plan() are executed until one converges. NewtonLoop is the
   * iteration; Globalisation and LagContinuation extend the range of
   * convergence.
   *
   * Values of the parameter for friction:
   * - exact: the law with friction at t_{n+1}; without convergence, the step
   *   fails;
   * - automatic: exact if the lag continuation converges, otherwise with the
   *   smallest lag reached (reported).
   */
  class NonsmoothNewton : public dealii::ParameterAcceptor
  {
  public:
    /** Declares the parameters of the nonsmooth Newton solver. @param others
     *  additional formulations with stresses as the only unknowns */
    explicit NonsmoothNewton(const StressMethods &others = {});

    /** Checks the parameters of the solver for consistency. */
    void
    prepare();

    /**
     * Checks that the selected formulation (return mapping, natural map or
     * stresses as unknowns) applies to the problem. To be called before the
     * first attempt at a step. Collective.
     * @throws InputError
     */
    void
    check(const IncrementalProblem &problem) const;

    /** Hints from the time stepper to the solver for the solution of a step. */
    struct Hints
    {
      bool elastic_first = false; ///< elastic tangent in iteration 1

      /** Largest accepted fraction of the plastic work that is due to lagged
       *  friction (SolverReport::excess_share). It applies to converged
       *  steps. */
      double accepted_excess = std::numeric_limits<double>::infinity();
    };

    /**
     * Solves the incremental problem of a step.
     * @param[in,out] v in: initial guess, velocities of t_n; out: the solution
     * @param[out] residual R(v) at all degrees of freedom; at prescribed dofs
     * the reactions
     */
    SolverReport
    solve(IncrementalProblem  &problem,
          LinearSystem        &system,
          dealii::TimerOutput &timer,
          Vector              &v,
          Vector              &residual,
          const Hints         &hints) const;

    /** Tolerances and maximum number of iterations from the parameter file. */
    StepLimits
    limits() const
    {
      return {relative_tolerance, absolute_tolerance, max_iterations};
    }

    /** Value of the parameter 'Newton/Formulation' that selects return mapping,
     *  natural map or stresses as unknowns. */
    std::string
    formulation_name() const
    {
      return formulation.word();
    }

    /** Returns true if lagged friction is excluded, by a parameter or by the
     *  formulation. Reasons are the parameter for friction, or a formulation
     *  with stresses as the only unknowns, which admits the exact law only. */
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

    /** Parameters that select the exact friction law or lagged friction, in the
     *  section of the time discretisation. */
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

    /** Selected formulation with stresses as the only unknowns; null if another
     *  formulation is selected. */
    const StressFormulation *
    of_stresses() const;

    /** Selected first-iterate method with stresses as the only unknowns; null
     *  if another method is selected. */
    const FirstIterate *
    first_iterate_of_stresses() const;

    /** Performs the Newton iterations of one of the planned attempts at solving
     *  the step, from the current iterate.
     *  @param start_of_s initial stresses s of the natural map (Pa) */
    void
    iterate(const Attempt             &next,
            const bool                 elastic_first,
            const std::vector<Mandel> &start_of_s,
            const StepWorkspace       &work) const;

    /** Performs a numerical continuation from lagged friction to the exact
     *  friction law in one of the planned attempts at solving the step.
     *  @param accepted_excess see Hints */
    void
    continue_from_lag(const Attempt       &next,
                      const bool           elastic_first,
                      const double         accepted_excess,
                      const StepWorkspace &work) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
