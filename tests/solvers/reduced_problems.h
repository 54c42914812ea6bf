// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Random reduced problems of the structure of eq (71).

#ifndef geocone_tests_solvers_reduced_problems_h
#define geocone_tests_solvers_reduced_problems_h

#include <geocone/reduced/reduced_problem.h>

#include "../cone/cone_tests.h"

namespace reduced_problems
{
  /** W = 1e-6 (B B' + ridge I), C = 1e-6 B H', L = 1e-6 H H', all random. */
  inline geocone::ReducedProblem
  coupled(const unsigned int       n_cones,
          const unsigned int       n_multipliers,
          const geocone::FlowCone &cone,
          const double             ridge,
          cone_tests::Random      &random)
  {
    const auto matrix = [&](const unsigned int rows,
                            const unsigned int columns) {
      Eigen::MatrixXd X(rows, columns);
      for (unsigned int j = 0; j < columns; ++j)
        for (unsigned int i = 0; i < rows; ++i)
          X(i, j) = random(-1., 1.);
      return X;
    };
    const unsigned int    size = 3 * n_cones, n_velocities = size / 2 + 3;
    const Eigen::MatrixXd B = matrix(size, n_velocities);
    const Eigen::MatrixXd H = matrix(n_multipliers, n_velocities);

    geocone::ReducedProblem problem;
    problem.cones.assign(n_cones, cone);
    problem.W = (1e-6 * (B * B.transpose() +
                         ridge * Eigen::MatrixXd::Identity(size, size)))
                  .sparseView();
    problem.q = 1e-2 * matrix(size, 1);
    problem.C = 1e-6 * B * H.transpose();
    problem.L = 1e-6 * H * H.transpose();
    problem.d = 1e-2 * matrix(n_multipliers, 1);
    return problem;
  }
} // namespace reduced_problems

#endif
