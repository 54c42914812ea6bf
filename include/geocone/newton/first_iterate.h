// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_first_iterate_h
#define geocone_newton_first_iterate_h

#include <geocone/newton/step_workspace.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Fixed-point iterations v -= K^-1 R(v), with K the elastic Jacobian
   * factorised once: each is an elastic step with the plastic strain of the
   * previous one. Prescribed velocities and H v = q are those at the end of the
   * step.
   * @return the stresses of the return map at v (Pa)
   */
  std::vector<Mandel>
  fixed_point_iterate(const unsigned int   n_iterations,
                      const StepWorkspace &work);
} // namespace geocone::GEOCONE_DIM

#endif
