// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_stress_formulation_h
#define geocone_newton_stress_formulation_h

#include <geocone/newton/step_workspace.h>

#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Tolerances and maximum number of iterations for the solution of a step. */
  struct StepLimits
  {
    double relative_tolerance = 1e-10; ///< on |R_free|
    double absolute_tolerance = 1e-12; ///< for |R_free| (N/m)
    /** Maximum number of iterations (or Gauss-Seidel sweeps); 0 for the default
     *  of the formulation. */
    unsigned int max_iterations = 0;
  };

  /**
   * Formulation in which stresses are the only unknowns of a step, selectable
   * in NonsmoothNewton.
   */
  struct StressFormulation
  {
    const char *name; ///< value of 'Newton/Formulation'

    /** Rejects problems to which the formulation with stresses as unknowns does
     *  not apply.
     *  @throws InputError */
    std::function<void(const IncrementalProblem &problem)> check;

    std::function<void(const StepLimits &limits, const StepWorkspace &work)>
      solve;
  };

  /** Method that computes the first iterate of a step. */
  struct FirstIterate
  {
    const char *name; ///< value of 'Newton/First iterate'

    /** Rejects problems to which the first-iterate method does not apply.
     *  @throws InputError */
    std::function<void(const IncrementalProblem &problem)> check;

    /** Computes the first iterate v and stores it in the workspace. @return the
     *  stresses at v (Pa) */
    std::function<std::vector<Mandel>(const unsigned int   n_iterations,
                                      const StepWorkspace &work)>
      make;
  };

  /** Available methods with stresses as the only unknowns, for
   *  NonsmoothNewton. */
  struct StressMethods
  {
    std::vector<StressFormulation> formulations;
    std::vector<FirstIterate>      first_iterates;
    std::string                    formulation_help; ///< help on formulations
    std::string                    first_iterate_help;
  };
} // namespace geocone::GEOCONE_DIM

#endif
