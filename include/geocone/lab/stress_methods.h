// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_lab_stress_methods_h
#define geocone_lab_stress_methods_h

#include <geocone/lab/reduced_problem.h>
#include <geocone/lab/reduced_report.h>
#include <geocone/newton/nonsmooth_newton.h>

namespace geocone::GEOCONE_DIM
{
  /** Reduced formulations, by Newton's method and by Gauss-Seidel, and first iterates
   *  of sweeps. */
  StressMethods
  stress_methods();

  /**
   * Solves a reduced problem that is given as such: by Gauss-Seidel if that is
   * the formulation that @p newton is asked for, by Newton's method with the natural
   * map or, for all other formulations, with the return map.
   * @param[in,out] s stresses in cone axes (Pa)
   */
  ReducedReport
  solve_reduced(const NonsmoothNewton &newton,
                const ReducedProblem  &problem,
                Eigen::VectorXd       &s);
} // namespace geocone::GEOCONE_DIM

#endif
