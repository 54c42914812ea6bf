// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/solvers/line_search.h>
#include <geocone/solvers/nonsmooth_newton.h>

#include <deal.II/base/mpi.h>

namespace geocone
{
  using dealii::TimerOutput;

  namespace
  {
    /**
     * Largest (a - b)/a for which the line search alone was seen to be enough
     * on most meshes: theta >= phi/2 is (nearly) 1/2.
     */
    constexpr double hard_flow = 0.51;

    /**
     * Solves [K -H'; H 0] (dv, dlambda) = (rhs, defect) for dv by the Schur
     * complement H K^-1 H'.
     * @param[in,out] rhs owned rows in, dv out
     */
    void
    solve_constrained(const Constraints     &constraints,
                      LinearSolver          &linear_solver,
                      const Eigen::VectorXd &defect,
                      const MPI_Comm         comm,
                      std::vector<double>   &rhs)
    {
      const Multipliers &rows = constraints.multipliers;
      const unsigned int m    = rows.n_rows();
      if (m == 0)
        {
          linear_solver.solve(rhs);
          return;
        }
      using Matrix          = Eigen::MatrixXd;
      const std::size_t   n = rhs.size();
      std::vector<double> columns(n * (m + 1), 0.);
      std::copy(rhs.begin(), rhs.end(), columns.begin());
      std::vector<int> places;
      for (const unsigned int dof : rows.dofs())
        places.push_back(constraints.free_row[dof]);
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int j = 0; j < places.size(); ++j)
          columns[n * (k + 1) + places[j]] = rows.coefficients()(k, j);
      linear_solver.solve(columns, m + 1);

      const Eigen::Map<const Matrix> solved(columns.data(), n, m + 1);
      Matrix                         touched(places.size(), m + 1);
      for (unsigned int j = 0; j < places.size(); ++j)
        touched.row(j) = solved.row(places[j]);
      Matrix products = rows.coefficients() * touched;
      dealii::Utilities::MPI::sum(
        dealii::ArrayView<const double>(products.data(), products.size()),
        comm,
        dealii::ArrayView<double>(products.data(), products.size()));
      const Eigen::VectorXd change =
        products.rightCols(m).partialPivLu().solve(defect - products.col(0));
      Eigen::Map<Eigen::VectorXd>(rhs.data(), n) =
        solved.col(0) + solved.rightCols(m) * change;
    }
  } // namespace

  NonsmoothNewton::SolverName::SolverName()
    : dealii::ParameterAcceptor("/Linear solver")
  {
    add_parameter(
      "Name",
      value,
      "automatic | Cholmod | Umfpack | Mumps. Automatic: Cholmod "
      "for associated flow and Umfpack otherwise on one rank, Mumps "
      "on several.");
  }

  NonsmoothNewton::NonsmoothNewton()
    : dealii::ParameterAcceptor("/Newton")
  {
    add_parameter(
      "Tolerance",
      relative_tolerance,
      "A step is solved when the norm of the free residual is below "
      "this times the norm of the internal (or external) forces.");
    add_parameter("Absolute tolerance",
                  absolute_tolerance,
                  "... or below this (N/m), which ends steps without load.");
    add_parameter(
      "Maximum iterations",
      max_iterations,
      "Linear systems to solve before the step is given up and cut. "
      "0: 150 for associated flow (slow starts are worth waiting "
      "for), 60 for theta >= phi/2 and for the merit search, otherwise "
      "15 with the line search (30 with MPM) and 30 with the elastic blend.");
    add_parameter(
      "Globalisation",
      globalisation,
      "automatic | line search | elastic blend | merit search | none. "
      "Automatic: for MPM the line search, and for theta < phi/2 the merit "
      "search from the second start; for FEM "
      "the elastic blend for theta < phi/2 without inertia, the "
      "line search otherwise; where that fails the other one, but "
      "for theta < phi/2 with inertia. None: plastic steps often fail.");
  }

  void
  NonsmoothNewton::prepare()
  {
    if (!(relative_tolerance > 0. && relative_tolerance < 1.))
      throw InputError("Newton/Tolerance",
                       relative_tolerance,
                       "between 0 and 1",
                       "1e-10 is reached in all scenes");
    if (globalisation != "automatic" && globalisation != "line search" &&
        globalisation != "elastic blend" && globalisation != "merit search" &&
        globalisation != "none")
      throw InputError("Newton/Globalisation",
                       globalisation,
                       "automatic | line search | elastic blend | merit "
                       "search | none",
                       "take automatic");
    if (!(absolute_tolerance >= 0.))
      throw InputError("Newton/Absolute tolerance",
                       absolute_tolerance,
                       ">= 0 N/m",
                       "1e-12 is usual");
  }

  SolverReport
  NonsmoothNewton::solve(IncrementalProblem &problem,
                         SparseMatrix       &matrix,
                         LinearSolver       &linear_solver,
                         TimerOutput        &timer,
                         Vector             &v,
                         Vector             &residual,
                         const Hints        &hints) const
  {
    SolverReport report;
    const auto   solve_with = [&](const Globalisation kind) {
      attempt(kind,
              hints,
              problem,
              matrix,
              linear_solver,
              timer,
              v,
              residual,
              report);
    };
    const bool hard = problem.non_associativity() > hard_flow;
    if (globalisation != "automatic")
      {
        solve_with(
          globalisation == "line search"     ? Globalisation::line_search
          : globalisation == "elastic blend" ? Globalisation::elastic_blend
          : globalisation == "merit search"  ? Globalisation::merit_search
                                             : Globalisation::none);
        return report;
      }
    if (hints.particles)
      {
        solve_with(hard && hints.elastic_first ? Globalisation::merit_search
                                               : Globalisation::line_search);
        return report;
      }

    const bool   blend_first = hard && !problem.has_inertia();
    const Vector start       = v;
    solve_with(blend_first ? Globalisation::elastic_blend
                           : Globalisation::line_search);
    // With mass a shorter step makes the hard flow easy, for less than a second
    // attempt costs.
    const bool cut_at_once = hard && problem.has_inertia();
    if (!report.converged && !problem.is_symmetric() && !cut_at_once)
      {
        v = start;
        solve_with(blend_first ? Globalisation::line_search
                               : Globalisation::elastic_blend);
      }
    return report;
  }

  void
  NonsmoothNewton::attempt(const Globalisation globalisation,
                           const Hints        &hints,
                           IncrementalProblem &problem,
                           SparseMatrix       &matrix,
                           LinearSolver       &linear_solver,
                           TimerOutput        &timer,
                           Vector             &v,
                           Vector             &residual,
                           SolverReport       &report) const
  {
    const Constraints &constraints = problem.free_dofs();
    const unsigned int n_owned     = v.locally_owned_size();
    const bool         blend   = globalisation == Globalisation::elastic_blend;
    const bool         search  = globalisation == Globalisation::line_search;
    const bool         merit   = globalisation == Globalisation::merit_search;
    const bool         hard    = problem.non_associativity() > hard_flow;
    const unsigned int allowed = max_iterations > 0        ? max_iterations
                                 : merit                   ? 60
                                 : hints.particles && hard ? 30
                                 : problem.is_symmetric()  ? 150
                                 : !hard                   ? 60
                                 : blend                   ? 30
                                                           : 15;
    const unsigned int limit   = report.iterations + allowed;

    Vector         direction = problem.make_vector();
    Vector         start     = problem.make_vector();
    ResidualReport state;

    const auto evaluate = [&]() {
      TimerOutput::Scope scope(timer, "residual");
      v.update_ghost_values();
      state = problem.residual(residual, v);
    };
    const auto record = [&](const double length, const double weight) {
      report.residual =
        state.norm /
        std::max(state.force_norm, std::numeric_limits<double>::min());
      report.table.push_back({report.residual,
                              length,
                              weight,
                              state.n_cone,
                              state.n_apex,
                              state.n_switched});
    };

    // The change of the prescribed velocities over the step.
    Vector jump = v;
    problem.set_prescribed(jump);
    jump -= v;
    const Multipliers &rows   = constraints.multipliers;
    Eigen::VectorXd    defect = rows.defect(v);
    const bool         jumps =
      jump.linfty_norm() > 0. || (defect.size() > 0 && defect.norm() > 0.);

    evaluate();
    record(0., 0.);
    double              damping = 0.; // the blend of the merit search
    std::vector<double> rhs(matrix.n_owned);
    for (bool first = true;; first = false)
      {
        if (!std::isfinite(state.norm))
          {
            report.reason =
              "the residual is not a number" + problem.not_a_number();
            return;
          }
        if (!(first && jumps) &&
            state.norm <= std::max(relative_tolerance * state.force_norm,
                                   absolute_tolerance))
          {
            report.converged = true;
            return;
          }
        if (report.iterations >= limit)
          {
            report.reason = format(
              "the residual stopped at %.1e after %u iterations (%u points on "
              "the cone, %u at the apex, %u of them switching)",
              report.residual,
              report.iterations,
              state.n_cone,
              state.n_apex,
              state.n_switched);
            return;
          }

        // A few apex points can make a Jacobian without mass singular: blend
        // in as little of the elastic stiffness as makes it regular.
        bool         regular = false;
        const double wanted  = first && hints.elastic_first ? 1.
                               : merit                      ? damping
                               : blend && !first ? std::min(0.5, report.residual)
                                                 : 0.;
        double       weight  = wanted;
        for (const double least : {0., 1e-6, 1e-3, 0.1})
          {
            if (least > 0. && least <= wanted)
              continue;
            {
              TimerOutput::Scope scope(timer, "assemble");
              weight = std::max(wanted, least);
              problem.linearise(matrix, weight);
            }
            TimerOutput::Scope scope(timer, "factorise");
            regular = linear_solver.factorise(matrix);
            ++report.factorisations;
            if (regular)
              {
                report.regularised += least > 0.;
                break;
              }
          }
        if (!regular)
          {
            report.reason = "the Jacobian is singular";
            return;
          }

        if (first && jumps)
          {
            TimerOutput::Scope scope(timer, "residual");
            jump.update_ghost_values();
            problem.apply_tangent(direction, jump);
          }
        for (unsigned int i = 0; i < n_owned; ++i)
          if (constraints.is_free(i))
            rhs[constraints.free_row[i]] =
              -residual.local_element(i) -
              (first && jumps ? direction.local_element(i) : 0.);
        {
          TimerOutput::Scope scope(timer, "solve");
          solve_constrained(
            constraints, linear_solver, defect, v.get_mpi_communicator(), rhs);
        }
        ++report.iterations;
        for (unsigned int i = 0; i < n_owned; ++i)
          direction.local_element(i) =
            constraints.is_free(i)
              ? rhs[constraints.free_row[i]]
              : (first && jumps ? jump.local_element(i) : 0.);

        double     length = 1.;
        const auto move   = [&](const double x) {
          for (unsigned int i = 0; i < n_owned; ++i)
            v.local_element(i) =
              start.local_element(i) + x * direction.local_element(i);
          evaluate();
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
        defect = rows.defect(v);
        record(length, weight);
      }
  }
} // namespace geocone
