// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/newton/first_iterate.h>
#include <geocone/newton/lag_continuation.h>
#include <geocone/newton/nonsmooth_newton.h>

#include <algorithm>

#include <cmath>

namespace geocone
{
  using dealii::TimerOutput;
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;

  namespace
  {
    /** Words with the names of @p methods behind them, the first of which is
     *  @p first, and so on. */
    template <typename Enum, typename Method>
    typename Choice<Enum>::Words
    with_names_of(const std::vector<Method>   &methods,
                  typename Choice<Enum>::Words words,
                  const Enum                   first)
    {
      for (std::size_t i = 0; i < methods.size(); ++i)
        words.emplace_back(methods[i].name,
                           Enum(static_cast<std::size_t>(first) + i));
      return words;
    }

    /** The one of @p methods that is chosen, or null. */
    template <typename Enum, typename Method>
    const Method *
    chosen(const Enum                 value,
           const Enum                 first,
           const std::vector<Method> &methods)
    {
      return value < first ? nullptr
                           : &methods[static_cast<std::size_t>(value) -
                                      static_cast<std::size_t>(first)];
    }
  } // namespace

  NonsmoothNewton::Friction::Friction()
    : dealii::ParameterAcceptor("/Time stepping")
  {
    kind.declare(
      *this,
      "Friction",
      ". Exact: strength depends on the normal "
      "stress at the end of the step; steps that are not solved are cut. "
      "Automatic: exact, but in single steps that are not solved a part of "
      "that stress, the least that is solved, lags: it is of the step's start. "
      "They are counted. Nothing changes for associated flow, and nothing lags "
      "where friction has a memory ('Materials/NAME/Friction memory').");
  }

  NonsmoothNewton::NonsmoothNewton(const StressMethods &others)
    : dealii::ParameterAcceptor("/Newton")
    , others(others)
    , formulation(with_names_of(others.formulations,
                                {{"automatic", Formulation::automatic},
                                 {"return map", Formulation::return_map},
                                 {"natural map", Formulation::natural_map}},
                                Formulation::of_stresses))
    , first_iterate(with_names_of(
        others.first_iterates,
        {{"none", Start::at_t_n}, {"fixed point", Start::fixed_point}},
        Start::of_stresses))
  {
    formulation.declare(
      *this,
      "Formulation",
      std::string(
        ": what is solved for, by which method. Return "
        "map: the velocities, with the closed-form law. Natural map: "
        "velocities, "
        "stresses and plastic strains with the natural map of the law, which "
        "each iteration linearises. Automatic: the return map for theta >= "
        "phi/2 > 0 and for friction with memory, and the natural map otherwise "
        "and where that fails.") +
        others.formulation_help);
    add_parameter("Rho",
                  rho,
                  "Rho of the formulation 'natural map', in units of 2G of "
                  "each point, 1e-6 to 1e6.",
                  prm,
                  Double(1e-6, 1e6));
    first_iterate.declare(*this,
                          "First iterate",
                          std::string(": what makes the start of the "
                                      "formulations 'return map' and 'natural "
                                      "map' from the velocities of t_n. "
                                      "Fixed point: iterations with the "
                                      "elastic stiffness, factorised once.") +
                            others.first_iterate_help);
    add_parameter("First iterate sweeps",
                  first_iterate_sweeps,
                  "Number of these iterations or sweeps, 1 to 10000.",
                  prm,
                  Integer(1, 10000));
    add_parameter(
      "Tolerance",
      relative_tolerance,
      "A step is solved when the norm of the free residual is below this times "
      "the norm of the internal (or external) forces, 1e-15 to 0.1; or when "
      "the rest is rounding alone; 'newton/steps_at_rounding_floor' in "
      "summary.json counts such steps.",
      prm,
      Double(1e-15, 0.1));
    add_parameter("Absolute tolerance",
                  absolute_tolerance,
                  "... or below this (N/m), 0 to 1, which ends steps without "
                  "load.",
                  prm,
                  Double(0., 1.));
    add_parameter(
      "Maximum iterations",
      max_iterations,
      "Linear systems to solve before an attempt at a step is given up, at "
      "most 1000000; twice as many where it converges. 0: 30 for the elastic "
      "blend with the return map, 150 for the line search and associated flow "
      "(slow starts are worth waiting for) but 30 for phi = 0, 20 for it and "
      "FEM with friction that remembers, 100 for the natural map where nothing "
      "would follow and otherwise 40, and 60 for all else.",
      prm,
      Integer(0, 1000000));
    globalisation.declare(
      *this,
      "Globalisation",
      ". Automatic: the line search for the return map "
      "and theta >= phi/2, otherwise the elastic blend; and the lag "
      "continuation for what is not solved so. Lag continuation: where flow is "
      "associated nothing can lag, and this is the line search. None: plastic "
      "steps often fail. Line search, merit search and lag continuation need "
      "the return map; choosing one of them selects it.");
  }

  void
  NonsmoothNewton::prepare()
  {
    if (formulation == Formulation::automatic ||
        formulation == Formulation::return_map)
      return;
    const bool        natural = formulation == Formulation::natural_map;
    const std::string with =
      " with the formulation '" + formulation.word() + "'";
    if (globalisation != Method::automatic && globalisation != Method::none &&
        !(natural && globalisation == Method::elastic_blend))
      throw InputError(
        "Newton/Globalisation",
        globalisation.word(),
        (natural ? "automatic | elastic blend | none" : "automatic | none") +
          with,
        "take automatic, or the formulation 'return map'");
    if (!natural && first_iterate != Start::at_t_n)
      throw InputError("Newton/First iterate",
                       first_iterate.word(),
                       "none" + with,
                       "take none, or the formulation 'return map' or "
                       "'natural map'");
  }

  const StressFormulation *
  NonsmoothNewton::of_stresses() const
  {
    return chosen(
      formulation.get(), Formulation::of_stresses, others.formulations);
  }

  const FirstIterate *
  NonsmoothNewton::first_iterate_of_stresses() const
  {
    return chosen(
      first_iterate.get(), Start::of_stresses, others.first_iterates);
  }

  void
  NonsmoothNewton::check(const IncrementalProblem &problem) const
  {
    const bool pressures = problem.has_cell_pressures();
    if (problem.needs_return_map() && formulation == Formulation::natural_map)
      throw InputError(
        "Newton/Formulation",
        formulation.word(),
        std::string("automatic | return map with ") +
          (pressures ? "B-bar for soil that dilates"
                     : "laws of all principal stresses in the plane, and caps"),
        "set it to automatic");
    if (pressures && (of_stresses() || first_iterate_of_stresses()))
      throw InputError(
        "Discretisation/B-bar",
        "true",
        "false for soil that dilates where stresses are unknowns "
        "(reduced formulations, Gauss-Seidel)",
        "set it to false, or Newton/Formulation = automatic and "
        "First iterate = none");
    if (const auto *const stresses = of_stresses())
      stresses->check(problem);
    if (const auto *const first = first_iterate_of_stresses())
      first->check(problem);
  }

  void
  NonsmoothNewton::attempt(const Method               method,
                           const std::vector<Mandel> *natural_map_start,
                           const unsigned int         automatic,
                           const bool                 elastic_first,
                           const StepWorkspace       &work) const
  {
    NewtonLoop newton;
    newton.tolerance          = relative_tolerance;
    newton.absolute_tolerance = absolute_tolerance;
    newton.elastic_first      = elastic_first;
    const auto run            = [&](const unsigned int most, const bool rubs) {
      std::optional<NaturalMap> map;
      newton.allowed           = allowed(most);
      newton.law.obstacles_rub = rubs;
      newton.law.natural_map   = nullptr;
      if (natural_map_start != nullptr)
        newton.law.natural_map =
          &map.emplace(work.problem.make_natural_map(rho, *natural_map_start));
      LineSearch    search;
      ElasticBlend  blend(map ? ElasticBlend::with_natural_map
                             : ElasticBlend::with_return_map);
      MeritSearch   merit;
      Globalisation full_steps;
      newton.run(method == Method::line_search     ? search
                 : method == Method::elastic_blend ? blend
                 : method == Method::merit_search
                   ? static_cast<Globalisation &>(merit)
                   : full_steps,
                 work);
    };
    const Vector start = work.v;
    const bool   can_be_exact =
      work.problem.free_dofs().multipliers.n_rows() == 0;
    // Where obstacles are free, their motions follow from all of the contact, and steps
    // in which its states change much wander. Without inertia nothing else bears their
    // loads: the laws are solved exactly from the start, in a tenth of the iterations.
    // Where they only follow a try without that comes first, which costs less.
    const bool moves_obstacles = work.problem.has_contact() &&
                                 work.problem.contact().motions().n_free() > 0;
    const bool bears_obstacles = moves_obstacles &&
                                 !work.problem.has_inertia() &&
                                 work.problem.contact().motions().are_loaded();
    // An obstacle that gives way leaves nodes of an iterate without a support, soil flows
    // there, and the search does not find back. So what touches it stays in touch until
    // the iterate is near, or far even after three iterations: then it parts.
    if (work.problem.has_contact() && work.problem.may_flow() &&
        !moves_obstacles && !work.problem.contact().is_of_bodies() &&
        natural_map_start == nullptr)
      {
        newton.law.contact_holds = true;
        newton.tolerance         = NewtonLoop::near;
        newton.allowed_if_far    = 3;
        run(10, true);
        newton.law.contact_holds = false;
        newton.tolerance         = relative_tolerance;
        newton.allowed_if_far    = NewtonLoop().allowed_if_far;
        if (std::isfinite(work.report.residual))
          newton.elastic_first = false;
        else
          work.v = start;
      }
    const auto run_with_exact_contact = [&]() {
      newton.exact_contact = true;
      run(automatic, true);
      newton.exact_contact = false;
    };
    if (bears_obstacles && can_be_exact)
      {
        run_with_exact_contact();
        if (work.report.converged)
          return;
        work.v = start;
      }
    if (!work.problem.has_contact_friction())
      {
        run(automatic, true);
        return;
      }
    // Where many nodes come down in a step, those that would stick hinder each other:
    // then, too, the laws of contact are solved exactly in each iteration; or else the
    // step without friction may be a better start.
    newton.allowed_without_flow = 6;
    if (moves_obstacles)
      newton.allowed_if_far = 20;
    run(std::min(automatic, 30U), true);
    newton.allowed_without_flow = NewtonLoop().allowed_without_flow;
    newton.allowed_if_far       = NewtonLoop().allowed_if_far;
    if (work.report.converged)
      return;
    if (can_be_exact && !bears_obstacles)
      {
        // Where points flow much is won already, but with obstacles that went astray.
        const NewtonIteration &last = work.report.table.back();
        if (moves_obstacles || last.n_cone + last.n_apex == 0)
          work.v = start;
        run_with_exact_contact();
        if (work.report.converged)
          return;
      }
    work.v = start;
    run(30, false);
    newton.elastic_first = false;
    run(automatic, true);
  }

  void
  NonsmoothNewton::solve_with_memory(const LagContinuation &continuation,
                                     const StepWorkspace   &work) const
  {
    // A step that the line search does not solve soon it hardly ever does. The
    // natural map then may, but not for particles at their apex; these start
    // from explicit friction. What neither solves soon is better cut.
    const bool   points_move = work.problem.points_move();
    const bool   elastic     = continuation.elastic_first;
    const Vector start       = work.v;
    attempt(Method::line_search, nullptr, points_move ? 40 : 20, elastic, work);
    if (work.report.converged)
      return;
    work.v = start;
    if (points_move)
      continuation.solve_from_explicit_friction(work);
    else
      attempt(Method::elastic_blend,
              &work.problem.stress_at_start(),
              30,
              elastic,
              work);
  }

  SolverReport
  NonsmoothNewton::solve(IncrementalProblem &problem,
                         LinearSystem       &system,
                         TimerOutput        &timer,
                         Vector             &v,
                         Vector             &residual,
                         const Hints        &hints) const
  {
    SolverReport        report;
    const StepWorkspace work{problem, system, timer, v, residual, report};
    if (const auto *const stresses = of_stresses())
      {
        stresses->solve(limits(), work);
        return report;
      }

    const Formulation formulation = problem.needs_return_map()
                                      ? Formulation::return_map
                                      : Formulation(this->formulation);
    const bool        associated  = problem.non_associativity() == 0.;
    const bool        hard = problem.non_associativity() > Material::hard_flow;
    bool              elastic_first = hints.elastic_first;
    std::vector<Mandel>        first_stress; // of the first iterate
    const std::vector<Mandel> *start_of_s = &problem.stress_at_start();
    if (first_iterate != Start::at_t_n)
      {
        elastic_first = false;
        first_stress =
          first_iterate == Start::fixed_point
            ? fixed_point_iterate(first_iterate_sweeps, work)
            : first_iterate_of_stresses()->make(first_iterate_sweeps, work);
        start_of_s = &first_stress;
      }
    LagContinuation continuation;
    continuation.tolerance          = relative_tolerance;
    continuation.absolute_tolerance = absolute_tolerance;
    continuation.allowed            = allowed(40);
    continuation.allowed_on_path    = allowed(60);
    continuation.elastic_first      = elastic_first;
    continuation.keeps_lag = friction.kind == Friction::Kind::automatic &&
                             !problem.remembers_friction();
    const Vector start    = v;
    const auto   try_with = [&](const Method               method,
                              const std::vector<Mandel> *natural_map_start,
                              const unsigned int         automatic) {
      v = start;
      attempt(method, natural_map_start, automatic, elastic_first, work);
    };
    // Where flow is associated, friction does not lag: the first point of the
    // path is its end.
    const Method chosen =
      globalisation == Method::lag_continuation && associated
        ? Method::line_search
        : Method(globalisation);
    if (chosen != Method::automatic && chosen != Method::lag_continuation)
      {
        try_with(chosen,
                 formulation == Formulation::natural_map ? start_of_s : nullptr,
                 associated ? 150 : 60);
        return report;
      }
    if (chosen == Method::automatic && problem.remembers_friction() &&
        formulation == Formulation::automatic)
      {
        solve_with_memory(continuation, work);
        return report;
      }
    if (chosen == Method::automatic)
      {
        const bool both = formulation == Formulation::automatic;
        // Tresca's law, which has no apex.
        const bool natural_first = both && problem.yields_without_friction();
        if (natural_first)
          try_with(Method::elastic_blend, start_of_s, 40);
        if (report.converged)
          return report;
        if (formulation == Formulation::return_map || (both && !hard))
          try_with(hard ? Method::elastic_blend : Method::line_search,
                   nullptr,
                   hard || natural_first                 ? 30
                   : associated && !problem.is_spatial() ? 150
                                                         : 60);
        if (!report.converged && !natural_first &&
            formulation != Formulation::return_map)
          try_with(Method::elastic_blend, start_of_s, both ? 40 : 100);
      }
    if (!report.converged && !associated &&
        formulation != Formulation::natural_map)
      {
        v = start;
        continuation.solve_on_path(work);
        report.excess_share =
          report.converged ? problem.internal_forces().excess_share() : 0.;
        report.exceeds = report.excess_share > hints.accepted_excess;
        if (report.exceeds)
          {
            report.converged = false;
            report.reason =
              format("the exact law was not reached: a friction lag of %.2g is "
                     "left, by which the strength is off by %.2g %% of the "
                     "plastic work",
                     report.friction_lag,
                     100. * report.excess_share);
          }
      }
    return report;
  }
} // namespace geocone
