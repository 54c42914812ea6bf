// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_first_iterate_h
#define geocone_newton_first_iterate_h

#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Computes the initial guess for the velocities v by fixed-point iterations v
   * -= K^-1 R(v), with the elastic Jacobian K and the residual R. The Jacobian
   * is factorised once. Each iteration is an elastic step with the plastic
   * strain of the previous iterate. Prescribed velocities and H v = q are
   * imposed at the end of the step.
   * @return stresses of the return mapping at v (Pa)
   */
  std::vector<Mandel>
  fixed_point_iterate(const unsigned int   n_iterations,
                      const StepWorkspace &work);
} // namespace geocone::GEOCONE_DIM

#endif
