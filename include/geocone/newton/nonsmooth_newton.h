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
   * The nonsmooth solver of a step, which runs the tries of its plan() until one is
   * solved. NewtonLoop is the iteration, Globalisation and LagContinuation make it
   * converge from afar.
   *
   * Friction, by name:
   *  - exact: the law at t_{n+1}, or the step is not solved;
   *  - automatic: exact where the continuation gets there, and otherwise with the
   *    least lag that it has reached, which is reported.
   */
  class NonsmoothNewton : public dealii::ParameterAcceptor
  {
  public:
    /** @param others formulations in the stresses alone that are offered, too */
    explicit NonsmoothNewton(const StressMethods &others = {});

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

    /** Hints of the time stepper for a solve. */
    struct Hints
    {
      bool elastic_first = false; ///< take the elastic tangent once

      /** Largest SolverReport::excess_share of a step that counts as solved. */
      double accepted_excess = std::numeric_limits<double>::infinity();
    };

    /**
     * @param[in,out] v in: the start, velocities of t_n; out: the solution
     * @param[out] residual R(v) in all rows: reactions where prescribed
     */
    SolverReport
    solve(IncrementalProblem  &problem,
          LinearSystem        &system,
          dealii::TimerOutput &timer,
          Vector              &v,
          Vector              &residual,
          const Hints         &hints) const;

    /** Tolerances and iterations that are asked for. */
    StepLimits
    limits() const
    {
      return {relative_tolerance, absolute_tolerance, max_iterations};
    }

    /** The word of 'Newton/Formulation'. */
    std::string
    formulation_name() const
    {
      return formulation.word();
    }

    /** Whether nothing but the exact law will do: it is asked for, or what solves
     *  for stresses alone, which knows no other. */
    bool
    wants_exact_friction() const
    {
      return friction.kind == Friction::Kind::exact || of_stresses() ||
             first_iterate_of_stresses();
    }

    /** The linear solver that is asked for. */
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

    /** Part of the time discretisation, and of its section. */
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

    /** The formulation that is asked for, if the stresses are its only unknowns. */
    const StressFormulation *
    of_stresses() const;

    /** The first iterate that is asked for, if it solves for the stresses alone. */
    const FirstIterate *
    first_iterate_of_stresses() const;

    /** Newton iterations by a line of the plan, from the iterate.
     *  @param start_of_s start of s for the natural map (Pa) */
    void
    iterate(const Try                 &next,
            const bool                 elastic_first,
            const std::vector<Mandel> &start_of_s,
            const StepWorkspace       &work) const;

    /** The lag continuation of a line of the plan, from the iterate.
     *  @param accepted_excess see Hints */
    void
    continue_from_lag(const Try           &next,
                      const bool           elastic_first,
                      const double         accepted_excess,
                      const StepWorkspace &work) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
