// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/stop_request.h>
#include <geocone/mechanics/reduction.h>
#include <geocone/solvers/first_iterate.h>
#include <geocone/solvers/gauss_seidel.h>
#include <geocone/solvers/line_search.h>
#include <geocone/solvers/nonsmooth_newton.h>
#include <geocone/solvers/reduced_formulation.h>
#include <geocone/solvers/reduced_newton.h>

#include <algorithm>

namespace geocone
{
  using dealii::TimerOutput;
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;
  using dealii::Patterns::Selection;

  namespace
  {
    /**
     * Largest (a - b)/a for which the line search alone was seen to be enough
     * on most meshes: theta >= phi/2 is (nearly) 1/2.
     */
    constexpr double hard_flow = 0.51;

    /**
     * Relative residual at which an iterate is near enough to a solution to go on
     * from: with another lag, or beyond the iterations that were allowed.
     */
    constexpr double path_tolerance = 1e-3;

    /** c in the elastic blend w = min(1/2, c |R|/|B'V s|). */
    constexpr double blend_of_return_map = 0.3, blend_of_natural_map = 0.05;
  } // namespace

  NonsmoothNewton::SolverName::SolverName()
    : dealii::ParameterAcceptor("/Linear solver")
  {
    add_parameter("Name",
                  value,
                  "automatic | Cholmod | Umfpack | Mumps. Automatic: Cholmod "
                  "for associated flow and Umfpack otherwise on one rank, "
                  "Mumps on several.",
                  prm,
                  Selection("automatic|Cholmod|Umfpack|Mumps"));
  }

  NonsmoothNewton::Friction::Friction()
    : dealii::ParameterAcceptor("/Time stepping")
  {
    add_parameter(
      "Friction",
      kind,
      "automatic | exact | delayed. Exact: strength depends on the normal "
      "stress at the end of the step; steps that are not solved are cut. "
      "Delayed: a part of that stress ('Friction lag') is of the step's start, "
      "which makes steps without dilatancy as cheap as associated ones, at an "
      "error of first order in the step. Automatic: exact, but single steps "
      "that are not solved keep the least lag that is, and are counted. "
      "Nothing changes for associated flow.",
      prm,
      Selection("automatic|exact|delayed"));
    add_parameter("Friction lag",
                  lag,
                  "The part for delayed friction, 0 to 1: 0 is exact, 1 takes "
                  "all of it from the start.",
                  prm,
                  Double(0., 1.));
  }

  NonsmoothNewton::NonsmoothNewton()
    : dealii::ParameterAcceptor("/Newton")
  {
    add_parameter(
      "Formulation",
      formulation,
      "automatic | return map | natural map | reduced | reduced with "
      "multipliers | Gauss-Seidel: what is solved for, by which method. Return "
      "map: the velocities, with the closed-form law. Natural map: velocities, "
      "stresses and plastic strains with the natural map of the law, which "
      "each iteration linearises. Automatic: the return map for theta >= "
      "phi/2, and the natural map otherwise and where that fails. Reduced: the "
      "stresses alone, by Newton's method; constraints on particles are "
      "eliminated or kept with multipliers. Gauss-Seidel: the stresses alone, "
      "point by point. What is reduced needs a lumped mass, one rank and at "
      "most 3000 points. All but the first are there to be compared with it.",
      prm,
      Selection("automatic|return map|natural map|reduced|"
                "reduced with multipliers|Gauss-Seidel"));
    add_parameter("Rho",
                  rho,
                  "Rho of the formulation 'natural map', in units of 2G of "
                  "each point, 1e-6 to 1e6.",
                  prm,
                  Double(1e-6, 1e6));
    add_parameter(
      "First iterate",
      first_iterate,
      "none | fixed point | Gauss-Seidel: what makes the start of the "
      "formulations 'return map' and 'natural map' from the velocities of t_n. "
      "Fixed point: iterations with the elastic stiffness, factorised once. "
      "Gauss-Seidel: sweeps over the stresses, under the conditions of the "
      "formulation of that name.",
      prm,
      Selection("none|fixed point|Gauss-Seidel"));
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
      "(slow starts are worth waiting for), 100 for the natural map where "
      "nothing would follow and otherwise 40, and 60 for all else.",
      prm,
      Integer(0, 1000000));
    add_parameter(
      "Globalisation",
      globalisation,
      "automatic | line search | elastic blend | merit search | "
      "lag continuation | none. Automatic: the line search for the return map "
      "and theta >= phi/2, otherwise the elastic blend; and the lag "
      "continuation for what is not solved so. Lag continuation: where flow is "
      "associated nothing can lag, and this is the line search. None: plastic "
      "steps often fail. Line search, merit search and lag continuation need "
      "the return map; choosing one of them selects it.",
      prm,
      Selection("automatic|line search|elastic blend|merit search|"
                "lag continuation|none"));
  }

  void
  NonsmoothNewton::prepare()
  {
    if (formulation == "automatic" || formulation == "return map")
      return;
    const bool natural = formulation == "natural map";
    if (globalisation != "automatic" && globalisation != "none" &&
        !(natural && globalisation == "elastic blend"))
      throw InputError("Newton/Globalisation",
                       globalisation,
                       std::string(natural ? "automatic | elastic blend | none"
                                           : "automatic | none") +
                         " with the formulation '" + formulation + "'",
                       "take automatic, or the formulation 'return map'");
    if (friction.kind == "delayed")
      throw InputError("Time stepping/Friction",
                       friction.kind,
                       "automatic | exact with the formulation '" +
                         formulation + "'",
                       "take exact, or the formulation 'return map'");
    if (!natural && first_iterate != "none")
      throw InputError("Newton/First iterate",
                       first_iterate,
                       "none with the formulation '" + formulation + "'",
                       "take none, or the formulation 'return map' or "
                       "'natural map'");
  }

  bool
  NonsmoothNewton::is_reduced() const
  {
    return formulation != "automatic" && formulation != "return map" &&
           formulation != "natural map";
  }

  void
  NonsmoothNewton::check(const IncrementalProblem &problem) const
  {
    if (is_reduced())
      Reduction::check(problem, "Newton/Formulation", formulation);
    else if (first_iterate == "Gauss-Seidel")
      Reduction::check(problem, "Newton/First iterate", first_iterate);
  }

  SolverReport
  NonsmoothNewton::solve(IncrementalProblem &problem,
                         SparseMatrix       &matrix,
                         LinearSolver       &linear_solver,
                         TimerOutput        &timer,
                         Vector             &v,
                         Vector             &residual,
                         const Hints        &hints_given) const
  {
    SolverReport        report;
    const StepWorkspace work{
      problem, matrix, linear_solver, timer, v, residual, report};
    const bool associated = problem.non_associativity() == 0.;
    const bool hard       = problem.non_associativity() > hard_flow;
    const auto allowed    = [&](const unsigned int automatic) {
      return max_iterations > 0 ? max_iterations : automatic;
    };

    problem.set_friction_lag(0.);
    problem.use_return_map();
    if (is_reduced())
      {
        using Solver        = ReducedFormulation::Solver;
        const bool   sweeps = formulation == "Gauss-Seidel";
        const Solver solver = sweeps ? Solver::gauss_seidel
                              : formulation == "reduced"
                                ? Solver::newton
                                : Solver::newton_with_multipliers;
        ReducedFormulation{solver,
                           relative_tolerance,
                           absolute_tolerance,
                           allowed(sweeps ? 100000 : 60)}
          .solve(work);
        return report;
      }
    Hints               hints = hints_given;
    std::vector<Mandel> first_stress; // of the first iterate
    if (first_iterate != "none")
      {
        hints.elastic_first = false;
        first_stress        = first_iterate == "fixed point"
                                ? fixed_point_iterate(first_iterate_sweeps, work)
                                : gauss_seidel_iterate(first_iterate_sweeps, work);
      }
    if (friction.kind == "delayed" && !associated)
      {
        solve_delayed(friction.lag, relative_tolerance, hints, work);
        return report;
      }

    const Vector start = v;
    Attempt      attempt;
    attempt.tolerance     = relative_tolerance;
    attempt.elastic_first = hints.elastic_first;
    const auto try_with   = [&](const Globalisation name,
                              const bool          natural_map,
                              const unsigned int  automatic) {
      v                         = start;
      attempt.globalisation     = name;
      attempt.allowed           = allowed(automatic);
      attempt.natural_map_start = !natural_map ? nullptr
                                    : first_iterate == "none"
                                      ? &problem.stress_at_start()
                                      : &first_stress;
      run(attempt, work);
    };
    // Where flow is associated, friction does not lag: the first point of the
    // path is its end.
    const bool nothing_lags = globalisation == "lag continuation" && associated;
    if (nothing_lags ||
        (globalisation != "automatic" && globalisation != "lag continuation"))
      {
        const Globalisation name =
          nothing_lags || globalisation == "line search"
            ? Globalisation::line_search
          : globalisation == "elastic blend" ? Globalisation::elastic_blend
          : globalisation == "merit search"  ? Globalisation::merit_search
                                             : Globalisation::none;
        try_with(name, formulation == "natural map", associated ? 150 : 60);
        return report;
      }
    if (globalisation == "automatic")
      {
        const bool both = formulation == "automatic";
        if (formulation == "return map" || (both && !hard))
          try_with(hard ? Globalisation::elastic_blend
                        : Globalisation::line_search,
                   false,
                   hard         ? 30
                   : associated ? 150
                                : 60);
        if (!report.converged && formulation != "return map")
          try_with(Globalisation::elastic_blend, true, both ? 40 : 100);
      }
    if (!report.converged && !associated && formulation != "natural map")
      {
        v = start;
        continue_to_exact_law(
          friction.lag > 0. ? friction.lag : 0.5, allowed(60), hints, work);
      }
    return report;
  }

  ReducedReport
  NonsmoothNewton::solve_reduced(const ReducedProblem &problem,
                                 Eigen::VectorXd      &s) const
  {
    if (formulation == "Gauss-Seidel")
      {
        GaussSeidel solver;
        solver.tolerance = relative_tolerance;
        if (max_iterations > 0)
          solver.max_sweeps = max_iterations;
        return solver.solve(problem, s);
      }
    ReducedNewton solver;
    solver.tolerance = relative_tolerance;
    if (max_iterations > 0)
      solver.max_iterations = max_iterations;
    if (formulation == "natural map")
      solver.map = ReducedNewton::Map::natural_map;
    return solver.solve(problem, s);
  }

  void
  NonsmoothNewton::solve_delayed(const double         lag,
                                 const double         tolerance,
                                 const Hints         &hints,
                                 const StepWorkspace &work) const
  {
    const Vector start = work.v;
    Attempt      attempt;
    attempt.tolerance     = tolerance;
    attempt.friction_lag  = lag;
    attempt.allowed       = max_iterations > 0 ? max_iterations : 40;
    attempt.elastic_first = hints.elastic_first;
    run(attempt, work);
    if (work.report.converged || lag == 1.)
      return;
    // Friction that is explicit leaves a convex problem.
    work.v               = start;
    attempt.friction_lag = 1.;
    attempt.tolerance    = path_tolerance;
    run(attempt, work);
    if (!work.report.converged)
      return;
    attempt.friction_lag  = lag;
    attempt.tolerance     = tolerance;
    attempt.elastic_first = false;
    run(attempt, work);
  }

  void
  NonsmoothNewton::continue_to_exact_law(const double         lag,
                                         const unsigned int   allowed,
                                         const Hints         &hints,
                                         const StepWorkspace &work) const
  {
    SolverReport      &report = work.report;
    const unsigned int before = report.iterations;
    solve_delayed(lag, path_tolerance, hints, work);
    if (!report.converged)
      return;

    // The last solution that was reached, and its lag.
    const Vector first       = work.v;
    Vector       reached     = work.v;
    double       reached_lag = lag, fall = 0.55 * lag;
    Attempt      attempt;
    attempt.allowed = 15;
    attempt.moves   = true;
    bool shortened  = false;
    while (reached_lag > 0. && report.iterations - before < allowed)
      {
        double next = reached_lag - fall;
        if (next < 0.5 * fall)
          next = 0.;
        attempt.friction_lag = next;
        attempt.tolerance    = next > 0. ? path_tolerance : relative_tolerance;
        const unsigned int spent = report.iterations;
        run(attempt, work);
        if (!report.converged)
          {
            // More than one shorter stage was seen to lead to the end hardly
            // ever: the path turns.
            if (shortened)
              break;
            shortened = true;
            work.v    = reached;
            fall      = 0.4 * (reached_lag - next);
            continue;
          }
        reached     = work.v;
        reached_lag = next;
        // At most 55 % of it at a time: near 0 the path turns most.
        const unsigned int n = report.iterations - spent;
        fall                 = std::min((n <= 2   ? 3.
                                         : n <= 4 ? 2.
                                         : n <= 6 ? 1.2
                                                  : 0.8) *
                          fall,
                        std::max(0.55 * reached_lag, 0.05));
      }
    if (reached_lag == 0.)
      return;
    if (friction.kind != "automatic")
      {
        report.converged = false;
        report.reason    = format("the exact law was not reached in %u "
                                  "iterations: a friction lag of %.2g is left",
                               report.iterations,
                               reached_lag);
        return;
      }

    // Near a turn of the path what has been reached may be no solution.
    attempt.tolerance    = relative_tolerance;
    attempt.friction_lag = reached_lag;
    work.v               = reached;
    run(attempt, work);
    if (report.converged)
      return;
    attempt.friction_lag = lag;
    attempt.allowed      = 40;
    work.v               = first;
    run(attempt, work);
  }

  void
  NonsmoothNewton::run(const Attempt &attempt, const StepWorkspace &work) const
  {
    IncrementalProblem &problem  = work.problem;
    SolverReport       &report   = work.report;
    Vector             &v        = work.v;
    const Vector       &residual = work.residual;
    const bool   blend  = attempt.globalisation == Globalisation::elastic_blend;
    const bool   search = attempt.globalisation == Globalisation::line_search;
    const bool   merit  = attempt.globalisation == Globalisation::merit_search;
    const double blend_factor = attempt.natural_map_start != nullptr
                                  ? blend_of_natural_map
                                  : blend_of_return_map;
    const unsigned int limit  = report.iterations + attempt.allowed;
    report.converged          = false;
    report.friction_lag       = attempt.friction_lag;
    problem.set_friction_lag(attempt.friction_lag);
    if (attempt.natural_map_start != nullptr)
      problem.use_natural_map(rho, *attempt.natural_map_start);
    else
      problem.use_return_map();

    Vector         direction = problem.make_vector();
    Vector         start     = problem.make_vector();
    ResidualReport state;

    StepWorkspace::Jump jump  = work.jump();
    const bool          jumps = !jump.is_zero();
    state                     = work.evaluate();
    work.record(state, 0., 0., attempt.friction_lag);
    double damping = 0.; // the blend of the merit search
    for (bool first = true;; first = false)
      {
        stop_if_asked(v.get_mpi_communicator());
        if (!std::isfinite(state.norm))
          {
            work.report_not_a_number();
            return;
          }
        if (!(first && (jumps || attempt.moves)) &&
            state.natural_map <= attempt.tolerance &&
            work.is_balanced(state, attempt.tolerance, absolute_tolerance))
          {
            report.converged = true;
            report.reason.clear();
            report.remedy.clear();
            return;
          }
        if (report.iterations >=
            limit + (report.residual < path_tolerance ? attempt.allowed : 0))
          {
            report.reason = format(
              "the residual stopped at %.1e after %u iterations (%u points on "
              "the cone, %u at the apex, %u of them switching)",
              report.residual,
              report.iterations,
              state.n_cone,
              state.n_apex,
              state.n_switched);
            report.remedy =
              state.n_cone + state.n_apex > 0
                ? ""
                : format(
                    "no point flows, so that the step is linear and smaller "
                    "ones do not help: its equations are solved to %.1e "
                    "only, by rounding. Stiffnesses differ too much: take a "
                    "Poisson ratio farther from 0.5, or materials or cells "
                    "that differ less; or a 'Newton/Tolerance' above that",
                    report.residual);
            return;
          }

        // A few apex points can make a Jacobian without mass singular: blend
        // in as little of the elastic stiffness as makes it regular.
        bool         regular = false;
        const double wanted  = first && attempt.elastic_first ? 1.
                               : merit                        ? damping
                               : blend && !first
                                 ? std::min(0.5, blend_factor * report.residual)
                                 : 0.;
        double       weight  = wanted;
        for (const double least : {0., 1e-6, 1e-3, 0.1})
          {
            if (least > 0. && least <= wanted)
              continue;
            weight  = std::max(wanted, least);
            regular = work.factorise(weight);
            if (regular)
              {
                report.regularised += least > 0.;
                break;
              }
          }
        if (!regular)
          {
            report.reason = "the Jacobian is singular";
            report.remedy =
              "a part of the body is not held, or its soil has no strength "
              "left: hold it, set 'Time stepping/Inertia' = true, or take "
              "smaller steps; check whether the body can carry its loads";
            return;
          }

        work.solve(
          first && jumps ? &jump.prescribed : nullptr, jump.defect, direction);

        double     length = 1.;
        const auto move   = [&](const double x) {
          for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
            v.local_element(i) =
              start.local_element(i) + x * direction.local_element(i);
          state = work.evaluate();
        };
        start = v;
        if ((first && jumps) || !(search || merit))
          move(length);
        else if (search)
          length = line_search(problem.free_dot(residual, direction),
                               [&](const double x) {
                                 move(x);
                                 return problem.free_dot(residual, direction);
                               });
        else
          {
            const double before   = problem.merit(residual);
            const auto   descends = [&]() {
              const double after = problem.merit(residual);
              return after <= (1. - 1e-4 * length) * before;
            };
            move(length);
            bool falls = descends();
            for (unsigned int halvings = 0; !falls && halvings < 8; ++halvings)
              {
                length /= 2.;
                move(length);
                falls = descends();
              }
            if (!falls)
              {
                length = 0.;
                move(length);
              }
            if (length < 0.05)
              damping = std::min(1., std::max(0.02, 3. * damping));
            else if (length > 0.4)
              damping = damping / 4. < 0.01 ? 0. : damping / 4.;
          }
        jump.defect = problem.free_dofs().multipliers.defect(v);
        work.record(state, length, weight, attempt.friction_lag);
      }
  }
} // namespace geocone
