// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_line_search_h
#define geocone_newton_line_search_h

#include <cmath>

namespace geocone
{
  /**
   * Computes the step length x in (0, 1] along a Newton direction d from the
   * directional residual G(x) = R(v + x d).d. For associated flow G is the
   * derivative of a convex function along d, and the root of G is the minimum,
   * needed only approximately:
   * - x = 1 if G(0) >= 0 (no descent direction: full step), or if G(1) <=
   *   reduction |G(0)|;
   * - otherwise regula falsi on [0, 1], with each trial at least 10 % of the
   *   bracket away from the ends, until |G| < reduction |G(0)| or
   *   max_evaluations are reached. A non-finite G counts as G > 0.
   *
   * @param G directional residual; last evaluated at the returned length
   */
  template <typename Function>
  double
  line_search(const double       G0,
              const Function    &G,
              const double       reduction       = 0.5,
              const unsigned int max_evaluations = 6)
  {
    double x  = 1.;
    double Gx = G(x);
    if (G0 >= 0. || (std::isfinite(Gx) && Gx <= reduction * std::abs(G0)))
      return x;
    double a = 0., Ga = G0, b = 1., Gb = Gx;
    for (unsigned int n = 1; n < max_evaluations; ++n)
      {
        x  = std::isfinite(Gb) ? a - Ga * (b - a) / (Gb - Ga) : (a + b) / 2.;
        x  = std::fmin(std::fmax(x, a + 0.1 * (b - a)), b - 0.1 * (b - a));
        Gx = G(x);
        if (std::abs(Gx) < reduction * std::abs(G0))
          break;
        if (std::isfinite(Gx) && Gx < 0.)
          {
            a  = x;
            Ga = Gx;
          }
        else
          {
            b  = x;
            Gb = Gx;
          }
      }
    return x;
  }
} // namespace geocone

#endif
