// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_reduced_formulation_h
#define geocone_reduced_reduced_formulation_h

#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Formulation of a time step with stresses as the only unknowns (Reduction).
   * Convergence is checked by R(v) of the return map at the corresponding velocities.
   * The required tolerance of the reduced problem depends on the step size: the
   * tolerance is divided by ten while R(v) is too large.
   */
  struct ReducedFormulation
  {
    enum class Solver
    {
      newton,                  ///< ReducedNewton, H v = q eliminated (eq 75)
      newton_with_multipliers, ///< ReducedNewton, H v = q with multipliers
      gauss_seidel             ///< GaussSeidel, H v = q eliminated
    };

    Solver       solver             = Solver::newton;
    double       tolerance          = 1e-10; ///< for |R_free|, relative
    double       absolute_tolerance = 1e-12; ///< for |R_free| (N/m)
    unsigned int max_iterations     = 60;    ///< iterations or sweeps

    /** Solves the step with the stresses at t_n as the initial guess. @throws InputError
     *  as Reduction::check() */
    void
    solve(const StepWorkspace &work) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
