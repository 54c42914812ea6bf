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
  /** Accuracy and cost limits of a step. */
  struct StepLimits
  {
    double relative_tolerance = 1e-10; ///< on |R_free|
    double absolute_tolerance = 1e-12; ///< on |R_free| (N/m)
    /** Iterations or sweeps; 0: default of the formulation. */
    unsigned int max_iterations = 0;
  };

  /**
   * A formulation of a step with its stresses as the only unknowns, an
   * alternative in NonsmoothNewton.
   */
  struct StressFormulation
  {
    const char *name; ///< a word of 'Newton/Formulation'

    /** Rejects problems that it cannot solve. @throws InputError */
    std::function<void(const IncrementalProblem &problem)> check;

    std::function<void(const StepLimits &limits, const StepWorkspace &work)>
      solve;
  };

  /** Iterations for the first iterate of a step. */
  struct FirstIterate
  {
    const char *name; ///< a word of 'Newton/First iterate'

    /** Rejects problems that it does not apply to. @throws InputError */
    std::function<void(const IncrementalProblem &problem)> check;

    /** Changes v. @return the stresses at the iterate (Pa) */
    std::function<std::vector<Mandel>(const unsigned int   n_iterations,
                                      const StepWorkspace &work)>
      make;
  };

  /** Methods in the stresses alone, for a NonsmoothNewton. */
  struct StressMethods
  {
    std::vector<StressFormulation> formulations;
    std::vector<FirstIterate>      first_iterates;
    std::string                    formulation_help; ///< text on these words
    std::string                    first_iterate_help;
  };
} // namespace geocone::GEOCONE_DIM

#endif
