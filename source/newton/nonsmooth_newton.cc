// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/newton/first_iterate.h>
#include <geocone/newton/lag_continuation.h>
#include <geocone/newton/nonsmooth_newton.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::TimerOutput;
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;

  namespace
  {
    const UsedWhere used_nonsmooth_newton[] = {
      {"Newton/*", "Discretisation/Method", {"FEM", "MPM"}},
      {"Newton/First iterate sweeps",
       "Newton/First iterate",
       {"fixed point", "Gauss-Seidel"}}};
  } // namespace

  namespace
  {
    /** Values of the parameter, followed by the names of @p methods, the first
     *  of which is
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

    /** Chosen one of @p methods, or null. */
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
      ". Exact: the strength depends on the normal stress at the end of the "
      "step; steps that do not converge are subdivided. Automatic: exact, "
      "except in single steps that do not converge: there the smallest "
      "sufficient part of this stress is lagged, i.e. taken from the start of "
      "the step. Such steps are counted. It has no effect for associated flow, "
      "and nothing is lagged for friction with memory "
      "('Materials/NAME/Friction memory').");
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
      std::string(". Unknowns and method. Return map: velocities, with the "
                  "closed-form return map of the law. Natural map: velocities, "
                  "stresses and plastic strains; each iteration linearises the "
                  "natural map of the law. Automatic: return map for theta >= "
                  "phi/2 > 0 and for friction with memory, otherwise natural "
                  "map; also natural map if the return map fails.") +
        others.formulation_help);
    add_parameter("Rho",
                  rho,
                  "Parameter rho of the natural map [-], in units of 2G of "
                  "each point, 1e-6 to 1e6.",
                  prm,
                  Double(1e-6, 1e6));
    first_iterate.declare(
      *this,
      "First iterate",
      std::string(
        ". Initial guess of the formulations 'return map' and 'natural map', "
        "from the velocities of the last step. None: these velocities. Fixed "
        "point: iterations with the elastic stiffness, factorised once.") +
        others.first_iterate_help);
    add_parameter(
      "First iterate sweeps",
      first_iterate_sweeps,
      "Number of iterations or sweeps of the first iterate, 1 to 10000.",
      prm,
      Integer(1, 10000));
    add_parameter(
      "Tolerance",
      relative_tolerance,
      "Relative tolerance [-], 1e-15 to 0.1: norm of the residual of free "
      "unknowns over the norm of the internal (or external) forces. A residual "
      "at rounding level is accepted as well; 'newton/steps_at_rounding_floor' "
      "in summary.json counts such steps.",
      prm,
      Double(1e-15, 0.1));
    add_parameter("Absolute tolerance",
                  absolute_tolerance,
                  "Absolute tolerance of the norm of the residual [N/m], 0 to "
                  "1, for steps without load.",
                  prm,
                  Double(0., 1.));
    add_parameter(
      "Maximum iterations",
      max_iterations,
      "Maximum number of linear solves of an attempt at a step, <= 1000000; "
      "twice as many while it converges. 0: automatic, by the strategies of "
      "Newton's method, which 'geocone --help Newton' lists.",
      prm,
      Integer(0, 1000000));
    globalisation.declare(
      *this,
      "Globalisation",
      ". Automatic: line search for the return map and theta >= phi/2, "
      "otherwise elastic blend; lag continuation for steps that do not "
      "converge. Lag continuation: line search if flow is associated, as "
      "nothing can be lagged. None: plastic steps often fail. Line search, "
      "merit search and lag continuation select the return map.");
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
    if (globalisation != GlobalisationMethod::automatic &&
        globalisation != GlobalisationMethod::none &&
        !(natural && globalisation == GlobalisationMethod::elastic_blend))
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
    const StepTraits traits    = problem.traits();
    const bool       pressures = traits.has_cell_pressures;
    if (traits.needs_return_map() && formulation == Formulation::natural_map)
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
  NonsmoothNewton::iterate(const Attempt             &next,
                           const bool                 elastic_first,
                           const std::vector<Mandel> &start_of_s,
                           const StepWorkspace       &work) const
  {
    NewtonLoop newton;
    newton.tolerance =
      next.is_rough ? NewtonLoop::near_tolerance : relative_tolerance;
    newton.absolute_tolerance   = absolute_tolerance;
    newton.allowed              = next.iterations;
    newton.allowed_without_flow = next.iterations_without_flow;
    newton.allowed_if_far       = next.iterations_if_far;
    newton.elastic_first        = elastic_first && next.elastic_first;
    newton.exact_contact        = next.contact == ContactLaw::exact;
    newton.law.contact_is_bilateral = next.contact == ContactLaw::bilateral;
    newton.law.contact_friction = next.contact != ContactLaw::without_friction;
    std::optional<NaturalMap> map;
    if (next.natural_map)
      newton.law.natural_map =
        &map.emplace(work.problem.make_natural_map(rho, start_of_s));
    LineSearch    search;
    ElasticBlend  blend(map ? ElasticBlend::with_natural_map
                           : ElasticBlend::with_return_map);
    MeritSearch   merit;
    Globalisation full_steps;
    switch (next.globalisation)
      {
        case GlobalisationMethod::line_search:
          newton.run(search, work);
          break;
        case GlobalisationMethod::elastic_blend:
          newton.run(blend, work);
          break;
        case GlobalisationMethod::merit_search:
          newton.run(merit, work);
          break;
        default:
          newton.run(full_steps, work);
      }
  }

  void
  NonsmoothNewton::continue_from_lag(const Attempt       &next,
                                     const bool           elastic_first,
                                     const double         accepted_excess,
                                     const StepWorkspace &work) const
  {
    LagContinuation continuation;
    continuation.tolerance          = relative_tolerance;
    continuation.absolute_tolerance = absolute_tolerance;
    continuation.allowed            = next.with_one_lag;
    continuation.allowed_on_path    = next.iterations;
    continuation.elastic_first      = elastic_first;
    continuation.keeps_lag = friction.kind == Friction::Kind::automatic &&
                             !work.traits.law.has_friction_memory();
    if (next.globalisation == GlobalisationMethod::explicit_friction)
      {
        continuation.solve_from_explicit_friction(work);
        return;
      }
    continuation.solve_on_path(work);
    SolverReport &report = work.report;
    if (!report.converged)
      return;
    const InternalForces &forces = work.problem.internal_forces();
    report.excess_share          = forces.excess_share(forces.excess_work());
    report.lag_error_too_large   = report.excess_share > accepted_excess;
    if (report.lag_error_too_large)
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

  SolverReport
  NonsmoothNewton::solve(IncrementalProblem &problem,
                         LinearSystem       &system,
                         TimerOutput        &timer,
                         Vector             &v,
                         Vector             &residual,
                         const Hints        &hints) const
  {
    SolverReport        report;
    const StepTraits    traits = problem.traits();
    const StepWorkspace work{
      problem, traits, system, timer, v, residual, report};
    if (const auto *const stresses = of_stresses())
      {
        stresses->solve(limits(), work);
        return report;
      }

    bool                elastic_first = hints.elastic_first;
    std::vector<Mandel> first_stress; // of the first iterate
    if (first_iterate != Start::at_t_n)
      {
        elastic_first = false;
        first_stress =
          first_iterate == Start::fixed_point
            ? fixed_point_iterate(first_iterate_sweeps, work)
            : first_iterate_of_stresses()->make(first_iterate_sweeps, work);
      }
    const Vector start = v;
    for (const Attempt &next :
         plan(traits, {formulation, globalisation, max_iterations}))
      {
        const auto is_good = [&]() { // iterate of the previous try
          const NewtonIteration &last = report.table.back();
          return std::isfinite(report.residual) &&
                 (next.start == Attempt::Start::iterate ||
                  last.n_cone + last.n_apex > 0);
        };
        if (next.start == Attempt::Start::of_step || !is_good())
          v = start;
        if (next.with_one_lag > 0)
          continue_from_lag(next, elastic_first, hints.accepted_excess, work);
        else
          iterate(next,
                  elastic_first,
                  first_stress.empty() ? problem.stress_at_start()
                                       : first_stress,
                  work);
        if (report.converged && !next.prepares)
          break;
      }
    return report;
  }
} // namespace geocone::GEOCONE_DIM
