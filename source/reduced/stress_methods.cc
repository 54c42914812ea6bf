// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/reduced/gauss_seidel.h>
#include <geocone/reduced/reduced_formulation.h>
#include <geocone/reduced/reduction.h>
#include <geocone/reduced/stress_methods.h>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Sets v to the velocities that correspond to the stresses after Gauss-Seidel
     *  sweeps, started from the stress at t_n. @return these stresses (Pa) */
    std::vector<Mandel>
    gauss_seidel_iterate(const unsigned int n_sweeps, const StepWorkspace &work)
    {
      dealii::TimerOutput::Scope scope(work.timer, "solve");
      const Reduction            reduction(work.problem);
      Eigen::VectorXd            s = reduction.stress_at_start();
      GaussSeidel                sweeps;
      sweeps.tolerance  = 0.;
      sweeps.max_sweeps = n_sweeps;
      sweeps.solve(reduction.problem(), s);
      reduction.recover_velocity(s, work.v);
      std::vector<Mandel> stress;
      for (unsigned int p = 0; p < reduction.problem().n_cones(); ++p)
        stress.push_back(
          from_cone_axes(Mandel(s.segment<n_mandel>(n_mandel * p))));
      return stress;
    }

    StressFormulation
    reduced(const char                      *name,
            const ReducedFormulation::Solver solver,
            const unsigned int               max_iterations)
    {
      const auto check = [=](const IncrementalProblem &problem) {
        Reduction::check(problem,
                         "Newton/Formulation",
                         name,
                         solver == ReducedFormulation::Solver::newton);
      };
      const auto solve = [=](const StepLimits    &limits,
                             const StepWorkspace &work) {
        ReducedFormulation{solver,
                           limits.relative_tolerance,
                           limits.absolute_tolerance,
                           limits.max_iterations > 0 ? limits.max_iterations
                                                     : max_iterations}
          .solve(work);
      };
      return {name, check, solve};
    }
  } // namespace

  StressMethods
  stress_methods()
  {
    using Solver = ReducedFormulation::Solver;
    StressMethods result;
    result.formulations = {
      reduced("reduced", Solver::newton, 60),
      reduced("reduced with multipliers", Solver::newton_with_multipliers, 60),
      reduced(gauss_seidel, Solver::gauss_seidel, 100000)};
    result.formulation_help =
      " For comparison: Reduced: stresses only, by Newton's method; "
      "constraints on particles are eliminated, or enforced by multipliers. "
      "Gauss-Seidel: stresses only, point by point. These three need a lumped "
      "mass and one rank, and at most 3000 points if constraints are "
      "eliminated.";
    result.first_iterates = {
      {gauss_seidel,
       [](const IncrementalProblem &problem) {
         Reduction::check(problem, "Newton/First iterate", gauss_seidel, false);
       },
       gauss_seidel_iterate}};
    result.first_iterate_help =
      " Gauss-Seidel: sweeps over the stresses, with the restrictions of the "
      "formulation of this name.";
    return result;
  }
} // namespace geocone::GEOCONE_DIM
