// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_nonsmooth_newton_h
#define geocone_newton_nonsmooth_newton_h

#include <geocone/base/choice.h>
#include <geocone/linear/linear_solver.h>
#include <geocone/newton/step_workspace.h>
#include <geocone/newton/stress_formulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>

namespace geocone
{
  struct LagContinuation;

  /**
   * The nonsmooth solver of a step: which formulation, globalisation and law are
   * tried, and in which order. NewtonLoop is the iteration, Globalisation and
   * LagContinuation make it converge from afar.
   * Formulation and globalisation automatic: for theta >= phi/2 the return map
   * with the line search. Otherwise, and where that fails, the natural map with
   * the elastic blend: the stress is an unknown that obeys the law at the end
   * only, and iterations that would cycle between modes of points get around.
   * What is not solved so, without associated flow, the lag continuation tries
   * (doc/performance.md compares them).
   *
   * Friction, by name:
   *  - exact: the law at t_{n+1}, or the step is not solved;
   *  - automatic: exact where the continuation gets there, and otherwise with the
   *    least lag that it has reached, which the report tells.
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

    /** What a time stepper knows of its problem. */
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

    enum class Formulation
    {
      automatic,
      return_map,
      natural_map,
      of_stresses ///< the first of StressMethods::formulations; others follow
    };
    Choice<Formulation> formulation;

    enum class Method
    {
      automatic,
      line_search,
      elastic_blend,
      merit_search,
      lag_continuation,
      none
    };
    Choice<Method> globalisation = {
      {{"automatic", Method::automatic},
       {"line search", Method::line_search},
       {"elastic blend", Method::elastic_blend},
       {"merit search", Method::merit_search},
       {"lag continuation", Method::lag_continuation},
       {"none", Method::none}}};

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

    /** The iterations that are allowed, unless the file says so. */
    unsigned int
    allowed(const unsigned int automatic) const
    {
      return max_iterations > 0 ? max_iterations : automatic;
    }

    /** The tries for friction that remembers, whose tangent is nearly elliptic. */
    void
    solve_with_memory(const LagContinuation &continuation,
                      const StepWorkspace   &work) const;

    /** A try at the exact law from the iterate, by one globalisation.
     *  @param natural_map_start start of s for the natural map (Pa), or null: the
     *  return map */
    void
    attempt(const Method               method,
            const std::vector<Mandel> *natural_map_start,
            const unsigned int         automatic,
            const bool                 elastic_first,
            const StepWorkspace       &work) const;
  };
} // namespace geocone

#endif
