// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_one_cone_h
#define geocone_reduced_one_cone_h

#include <geocone/cone/second_order_cone.h>

namespace geocone::GEOCONE_DIM
{
  /** Stresses (Pa) that solve the complementarity problem of a single cone, one
   *  solution per column. There is at most one inside the cone, one at the apex
   *  and four on the surface. */
  using OneConeSolutions = Eigen::
    Matrix<double, n_mandel, Eigen::Dynamic, Eigen::ColMajor, n_mandel, 6>;

  /**
   * Computes all solutions s of the complementarity problem of a single cone. They
   * satisfy
   *   z = W s + q, (s, z) satisfies the law of FlowCone,
   * within rounding. Solutions are of three kinds:
   *  - inside: z = 0;
   *  - apex: s = (-k/a, 0), b |z_t| <= z_n;
   *  - surface: s = s_n e_n + (a s_n + k) u and z = g d, d = b e_n - u, g >= 0,
   *    with a tangential unit vector u = (0, cos x, sin x). Eliminating s_n and g from
   *    the three equations
   *      s_n W (e_n + a u) + k W u + q = g d
   *    and dividing by a yields
   *      f(x) = det(d, W (e_n + a u), q) + k det(d, W e_n, W u) = 0,
   *    a trigonometric polynomial of degree 2: up to four angles.
   * A solution always exists, and is unique for b = a.
   *
   * @param W symmetric positive definite 3 x 3 matrix, in cone axes
   */
  OneConeSolutions
  one_cone_solutions(const FlowCone     &cone,
                     const MandelMatrix &W,
                     const Mandel       &q);

  /**
   * Computes a solution of the complementarity problem of a single cone near a
   * given guess. If a solution of the same kind as the guess exists (on the
   * surface: if Newton's method for f converges from the angle of the guess),
   * it is returned, otherwise the nearest of one_cone_solutions() to the guess.
   * The first case is many times faster.
   */
  Mandel
  solve_one_cone(const FlowCone     &cone,
                 const MandelMatrix &W,
                 const Mandel       &q,
                 const Mandel       &guess);
} // namespace geocone::GEOCONE_DIM

#endif
