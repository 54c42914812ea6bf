// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/newton/step_workspace.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  using dealii::TimerOutput;

  namespace
  {
    /**
     * Factor c of c N, twice the value measured after one linear solve
     * (doc/theory/newton.md), and largest residual relative to the forces that
     * may count as rounding.
     */
    constexpr double floor_factor = 0.5, largest_floor = 1e-6;
  } // namespace

  void
  SolverReport::add_earlier(const SolverReport &earlier)
  {
    iterations += earlier.iterations;
    factorisations += earlier.factorisations;
    regularised += earlier.regularised;
    table.insert(table.begin(), earlier.table.begin(), earlier.table.end());
  }

  ResidualReport
  StepWorkspace::evaluate(const LocalLaw &law) const
  {
    TimerOutput::Scope scope(timer, "residual");
    v.update_ghost_values();
    return problem.residual(residual, v, law);
  }

  void
  StepWorkspace::record(const ResidualReport &state,
                        const double          length,
                        const double          blend,
                        const double          friction_lag) const
  {
    report.residual = state.norm / std::max(state.force_norm,
                                            std::numeric_limits<double>::min());
    report.table.push_back({report.residual,
                            length,
                            blend,
                            friction_lag,
                            state.n_cone,
                            state.n_apex,
                            state.n_switched});
  }

  bool
  StepWorkspace::is_balanced(const ResidualReport &state,
                             const double          tolerance,
                             const double          absolute) const
  {
    const auto within = [&](const double floor) {
      return state.norm <=
               std::max({tolerance * state.force_norm, absolute, floor}) &&
             state.contact_norm <=
               std::max({tolerance * state.contact_size, absolute, floor});
    };
    report.at_rounding_floor = false;
    if (within(0.))
      return true;
    // Near a solution only: the pass over the points is expensive otherwise.
    if (!(state.norm <= largest_floor * state.force_norm))
      return false;
    report.at_rounding_floor =
      within(floor_factor * problem.internal_forces().rounding_floor(v));
    return report.at_rounding_floor;
  }

  void
  StepWorkspace::report_not_a_number() const
  {
    report.reason =
      "the residual is not a number" + problem.internal_forces().not_a_number();
    report.remedy =
      "values of the scene overflow or are not numbers: check formulas, the "
      "initial stress, stiffnesses, loads and velocities there, and 'Newton/"
      "Rho'; or take smaller steps";
  }

  StepWorkspace::Jump
  StepWorkspace::jump() const
  {
    Jump result{v, problem.free_dofs().multipliers.defect(v)};
    problem.set_prescribed(result.prescribed);
    result.prescribed -= v;
    return result;
  }

  bool
  StepWorkspace::Jump::is_zero() const
  {
    return prescribed.linfty_norm() == 0. &&
           (defect.size() == 0 || defect.norm() == 0.);
  }

  bool
  StepWorkspace::factorise(const double elastic_blend) const
  {
    ++report.factorisations;
    return system.factorise(problem, elastic_blend, timer);
  }

  void
  StepWorkspace::solve(const Vector          *prescribed,
                       const Eigen::VectorXd &defect,
                       Vector                &direction) const
  {
    if (prescribed != nullptr)
      {
        TimerOutput::Scope scope(timer, "residual");
        prescribed->update_ghost_values();
        problem.apply_tangent(direction, *prescribed);
      }
    const Unknowns     &unknowns = problem.free_dofs();
    std::vector<double> rhs(system.n_owned_rows());
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        rhs[unknowns.free_row[i]] =
          -residual.local_element(i) -
          (prescribed != nullptr ? direction.local_element(i) : 0.);
    {
      TimerOutput::Scope scope(timer, "solve");
      system.solve(unknowns, defect, rhs);
    }
    ++report.iterations;
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      direction.local_element(i) =
        unknowns.is_free(i)
          ? rhs[unknowns.free_row[i]]
          : (prescribed != nullptr ? prescribed->local_element(i) : 0.);
  }
} // namespace geocone::GEOCONE_DIM
