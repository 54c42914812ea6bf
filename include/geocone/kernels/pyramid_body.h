// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_pyramid_body_h
#define geocone_kernels_pyramid_body_h

#include <geocone/base/simd_scalar.h>
#include <geocone/base/types.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Return mapping of the three-dimensional Mohr-Coulomb model in principal
   * stresses. The trial stresses t of one material point, or of several, are
   * ordered.
   * @tparam P double or Pack
   */
  template <typename P>
  class PyramidReturn
  {
  public:
    /** Computes the constants of the return mapping from strength and elastic
     *  moduli. @param sine,flow sines of the friction and dilatancy angles */
    PyramidReturn(const double sine,
                  const double flow,
                  const double lambda,
                  const double two_G)
      : more(1. + sine)
      , less(sine - 1.)
      , flow_more(1. + flow)
      , flow_less(1. - flow)
    {
      const double f[2] = {1. + sine, sine - 1.};
      // D g_ij: with g_i at i, g_j at j, and lambda tr g in the third
      // direction.
      const double third = 2. * lambda * flow;
      const double D[2]  = {third + two_G * (1. + flow),
                            third + two_G * (flow - 1.)};
      const double H     = f[0] * D[0] + f[1] * D[1];
      per_H              = P(1. / H);
      Dg[0]              = P(D[0]);
      Dg[1]              = P(D[1]);
      Dg_third           = P(third);
      // The edges: f_13 of D g_12 and D g_23, equal to f_12 and f_23 of D g_13.
      const double cross[2] = {f[0] * D[0] + f[1] * third,
                               f[0] * third + f[1] * D[1]};
      for (int e = 0; e < 2; ++e)
        {
          const double determinant = H * H - cross[e] * cross[e];
          own[e]                   = P(H / determinant);
          other[e]                 = P(-cross[e] / determinant);
        }
    }

    /** Yield function f_ij of the principal stresses s_i and s_j (Pa). */
    template <typename V>
    P
    yield_function(const V &t, const int i, const int j, const P &size) const
    {
      return more * t[i] + less * t[j] - size;
    }

    /** Component k of the vector D g_ij: elastic stiffness times flow direction
     *  of the yield plane f_ij = 0. */
    const P &
    stiff_flow(const int i, const int j, const int k) const
    {
      return k == i ? Dg[0] : k == j ? Dg[1] : Dg_third;
    }

    /** Maps the trial stress back to the yield plane f_13 = 0. @param f f_13 at
     *  t */
    template <typename V>
    void
    to_plane(const V &t, const P &f, V &s) const
    {
      for (int i = 0; i < 3; ++i)
        s[i] = t[i] - (f * per_H) * stiff_flow(0, 2, i);
    }

    /** Maps the trial stress back to an edge of the Mohr-Coulomb pyramid. Edge
     *  e = 0 is f_13 = f_12 = 0 (s_2 = s_3), edge e = 1 is f_13 = f_23 = 0 (s_1
     *  = s_2). */
    template <typename V>
    void
    to_edge(const int e, const V &t, const P &f, const P &size, V &s) const
    {
      const P f_e        = yield_function(t, e, e + 1, size);
      const P gamma      = own[e] * f + other[e] * f_e,
              more_gamma = other[e] * f + own[e] * f_e;
      for (int i = 0; i < 3; ++i)
        s[i] = t[i] - gamma * stiff_flow(0, 2, i) -
               more_gamma * stiff_flow(e, e + 1, i);
      // Exactly equal, despite rounding.
      const P mean = P(0.5) * (s[1 - e] + s[2 - e]);
      s[1 - e] = s[2 - e] = mean;
    }

    /** Indicator of the pyramid edge to which a trial stress is mapped back:
     *  edge 0 if positive, otherwise edge 1. */
    template <typename V>
    P
    edge_indicator(const V &t) const
    {
      return flow_less * t[0] - (t[1] + t[1]) + flow_more * t[2];
    }

    /** Maps principal trial stresses back to the Mohr-Coulomb pyramid.
     *  @param t principal trial stresses with f_13 = f
     *  @param[out] s principal stresses after the return, if f > 0 */
    void
    operator()(const P (&t)[3],
               const P &f,
               const P &size,
               const P &apex,
               P (&s)[3]) const
    {
      const P zero(0.);
      P       plane[3], edge[2][3];
      to_plane(t, f, plane);
      const P in_order = min(plane[0] - plane[1], plane[1] - plane[2]);
      for (int e = 0; e < 2; ++e)
        to_edge(e, t, f, size, edge[e]);
      const P at  = edge_indicator(t);
      const P end = where_greater(at, zero, edge[0][0], edge[1][0]) +
                    where_greater(at, zero, edge[0][2], edge[1][2]);
      for (int i = 0; i < 3; ++i)
        {
          const P at_edge = where_greater(at, zero, edge[0][i], edge[1][i]);
          s[i]            = where_greater(zero,
                               in_order,
                               where_greater(end, apex + apex, apex, at_edge),
                               plane[i]);
        }
    }

    P per_H;            ///< 1/(f_13 D g_13)
    P own[2], other[2]; ///< entries of (F' D G)^-1, both edges

  private:
    P more, less, flow_more, flow_less; ///< 1 + sin(phi), sin(phi) - 1, ...
    P Dg[2], Dg_third;
  };
} // namespace geocone::GEOCONE_DIM

#endif
