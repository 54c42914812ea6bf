// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_cone_varying_cone_h
#define geocone_cone_varying_cone_h

#include <geocone/cone/second_order_cone.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cstdint>

namespace geocone::GEOCONE_DIM
{
  /**
   * Return mapping for a yield cone whose size depends nonlinearly on the
   * plastic shear strain increment g = |z_t|. Stress and plastic strain, s and
   * z, satisfy the law of cone_of(g). Let f(g) be the plastic shear strain of
   * the return map to a fixed cone_of(g); g is the root of
   *   f(g) - g = 0   in [0, T/2G],
   * where f(0) >= 0 and f(T/2G) <= T/2G. The root is unique unless the soil softens
   * faster than it unloads elastically. The tangent is extended by
   *   ds/dg (df/de) / (1 - df/dg),
   * where ds/dg is a difference quotient of return_map() at fixed t.
   *
   * @param cone_of the cone as a function of g, without FlowCone::hardening
   * @param[out] slip plastic shear strain g
   */
  template <typename ConeOf>
  Mode
  return_map_varying(const ConeOf &cone_of,
                     const double  K,
                     const double  two_G,
                     const Mandel &t,
                     Mandel       &s,
                     MandelMatrix *tangent,
                     double       &slip)
  {
    MandelMatrix *const none = nullptr;
    const auto          map  = [&](const double g, MandelMatrix *C) {
      return return_map(cone_of(g), K, two_G, t, s, C);
    };
    const auto shear = [&]() {
      return FlowCone::tangential_norm(Mandel(t - s)) / two_G;
    };
    Mode         mode  = map(0., tangent);
    const double first = shear();
    slip               = 0.;
    if (first == 0.)
      return mode;

    const auto difference = [&](const double g) {
      map(g, none);
      return shear() - g;
    };
    const double most = FlowCone::tangential_norm(t) / two_G;
    const double last = difference(most);
    if (last >= 0.) // at the apex
      slip = most;
    else
      {
        std::uintmax_t n_tries = 100;
        const auto     between = boost::math::tools::toms748_solve(
          difference,
          0.,
          most,
          first,
          last,
          [](const double low, const double high) {
            return high - low <= 1e-15 * high;
          },
          n_tries);
        slip = between.second;
      }
    mode = map(slip, tangent);
    if (tangent != nullptr)
      {
        const Mandel u    = tangential_direction(Mandel(t - s));
        const double step = 1e-6 * most, below = std::min(step, slip);
        const Mandel at = s;
        map(slip + step, none);
        Mandel by_g = s;
        map(slip - below, none);
        by_g              = (by_g - s) / (step + below);
        s                 = at;
        MandelMatrix lost = -*tangent; // D - C
        lost(0, 0) += K;
        lost(1, 1) += two_G;
        lost(2, 2) += two_G;
        const double rest = 1. + u.dot(by_g) / two_G;
        if (rest > 1e-8)
          *tangent += by_g * (u.transpose() * lost) / (two_G * rest);
      }
    return mode;
  }
} // namespace geocone::GEOCONE_DIM

#endif
