// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/subloading_curves.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /**
     * The curve fbar(a + (sigma - a)/R) = 0 with sigma = p I + q sqrt(2/3) d: a
     * quadratic in q for each p.
     */
    template <int n>
    YieldCurve
    section(const SubloadingModel<n>                  &model,
            const SubloadingState<n>                  &y,
            const double                               R,
            const typename SubloadingModel<n>::Vector &d)
    {
      using Vector    = typename SubloadingModel<n>::Vector;
      Vector identity = Vector::Zero();
      identity.template head<3>().setOnes();
      const double pa    = y.a.dot(identity) / 3.;
      const double xi    = model.constants().xi;
      const auto   value = [&](const double p, const double q) {
        const Vector sigma = p * identity + q * std::sqrt(2. / 3.) * d;
        return model.yield_function(y.a + (sigma - y.a) / R, y.beta, y.pcb);
      };
      YieldCurve         upper, lower;
      const unsigned int n_points = 120;
      for (unsigned int i = 0; i <= n_points; ++i)
        {
          const double part = (1. - std::cos(pi * i / n_points)) / 2.;
          const double p    = pa + R * ((part - xi) * y.pcb - pa);
          const double q = y.pcb, f = value(p, 0.);
          const double plus = value(p, q), minus = value(p, -q);
          const double A = (plus + minus - 2. * f) / (2. * q * q);
          const double B = (plus - minus) / (2. * q);
          // At both ends of p the roots coincide, within rounding.
          const double D = B * B - 4. * A * f;
          if (!(D >= -1e-9 * (B * B + std::abs(4. * A * f))))
            continue;
          const double root = std::sqrt(std::max(0., D));
          upper.emplace_back(p, (-B + root) / (2. * A));
          lower.emplace_back(p, (-B - root) / (2. * A));
        }
      YieldCurve curve = upper;
      curve.insert(curve.end(), lower.rbegin(), lower.rend());
      if (!upper.empty())
        curve.push_back(upper.front());
      return curve;
    }
  } // namespace

  template <int n>
  std::vector<YieldCurve>
  subloading_curves(const SubloadingModel<n> &model,
                    const SubloadingState<n> &state,
                    const SectionPlane       &plane)
  {
    typename SubloadingModel<n>::Vector d    = to_model<n>(plane.stress);
    const unsigned int                  axis = plane.axis;
    const double                        p    = (d[0] + d[1] + d[2]) / 3.;
    d.template head<3>().array() -= p;
    if (d.norm() < 1e-9 * std::abs(p))
      {
        d.setZero();
        d.template head<3>().setConstant(-0.5);
        d[axis < 3 ? axis : 1] = 1.;
      }
    d *= (axis < 3 && d[axis] < 0. ? -1. : 1.) / d.norm();
    std::vector<YieldCurve> curves = {section(model, state, 1., d)};
    const double            R      = model.ratio(state);
    if (R > 1e-6)
      curves.push_back(section(model, state, R, d));
    return curves;
  }

  template std::vector<YieldCurve>
  subloading_curves(const SubloadingModel<4> &,
                    const SubloadingState<4> &,
                    const SectionPlane &);
  template std::vector<YieldCurve>
  subloading_curves(const SubloadingModel<6> &,
                    const SubloadingState<6> &,
                    const SectionPlane &);
} // namespace geocone::GEOCONE_DIM
