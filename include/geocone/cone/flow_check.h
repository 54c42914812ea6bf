// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_cone_flow_check_h
#define geocone_cone_flow_check_h

#include <geocone/cone/second_order_cone.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace geocone::GEOCONE_DIM
{
  /**
   * Residuals of a plasticity law (yield condition and flow rule) at the end of
   * a step. All residuals are zero if and only if the law is satisfied. They
   * refer to one point or are maxima over several points. The law has a change
   * of variable y that maps plastic flow to normals of the yield surface.
   * Residuals are dimensional; reference scales are included.
   */
  struct FlowCheck
  {
    double natural_map   = 0.; ///< residual |s - P_C(s - 2G y)| (Pa)
    double violation     = 0.; ///< violation of the solved yield condition (Pa)
    double dual      = 0.; ///< violation of the dual cone by y (-)
    double complementary = 0.; ///< product |<y, s - apex>| (J/m^3)
    double excess        = 0.; ///< violation of the exact yield condition (Pa)
    double exact_map     = 0.; ///< natural-map residual, exact law (Pa)

    double stress     = 0.; ///< scale |s| (Pa)
    double size       = 0.; ///< scale k, strength at zero normal stress (Pa)
    double flow       = 0.; ///< scale |y| (-)
    double compliance = 0.; ///< scale 1/2G (1/Pa)

    /** Number of values (residuals and their scales) in FlowCheck. Each is
     *  reduced over points and ranks by its maximum. */
    static constexpr std::size_t n_numbers = 10;
    static constexpr std::array<double FlowCheck::*, n_numbers>
    numbers()
    {
      return {{&FlowCheck::natural_map,
               &FlowCheck::violation,
               &FlowCheck::dual,
               &FlowCheck::complementary,
               &FlowCheck::excess,
               &FlowCheck::exact_map,
               &FlowCheck::stress,
               &FlowCheck::size,
               &FlowCheck::flow,
               &FlowCheck::compliance}};
    }

    void
    take_worse(const FlowCheck &other)
    {
      for (const auto member : numbers())
        this->*member = std::max(this->*member, other.*member);
    }

    /**
     * Evaluates the yield, flow and complementarity residuals of a law with a
     * yield cone at a point. The complementarity law assumes a cone without a
     * cut-off: at a cut-off of the normal stress only the strength is checked;
     * at Rankine's cut-off also the plastic strain, see flow_at_cut_off().
     * @param solved,exact cones of the solved and the exact law at the end of the step
     * @param z,s negative plastic strain increment, and stress, in cone axes
     */
    template <typename Vector>
    static FlowCheck
    of_cone(const FlowCone &solved,
            const FlowCone &exact,
            const Vector   &z,
            const Vector   &s,
            const double    two_G)
    {
      const Vector y = solved.psi(z);
      FlowCheck    here;
      here.stress           = s.norm();
      here.size             = exact.k;
      here.flow             = y.norm();
      here.compliance       = 1. / two_G;
      here.violation        = solved.yield_function(s);
      here.excess           = exact.yield_function(s);
      const double rounding = 1e-12 * (here.stress + here.size);
      if (solved.is_cut() && solved.beyond_cut_off(s) > -rounding)
        here.natural_map = here.exact_map =
          two_G * flow_at_cut_off(solved, z, s, rounding);
      else if (s[0] > -solved.tension + rounding)
        {
          here.natural_map = geocone::natural_map(solved, s, y, two_G).norm();
          here.exact_map =
            geocone::natural_map(exact, s, exact.psi(z), two_G).norm();
          here.dual          = solved.dual_violation(y);
          here.complementary = std::abs(solved.complementarity_product(y, s));
        }
      return here;
    }

  private:
    /**
     * Residual (-) of the flow rule for the negative plastic strain increment
     * z, at a stress s on the Rankine tension cut-off. It is the sum of
     * negative plastic multipliers of the cone and of the cut-off,
     *   g_1 + g_2 = -z_t.u,  b g_1 + g_2 = z_n,  u = s_t/|s_t|,
     * of a nonzero multiplier of the cone if s is inside the cone, and of strain
     * increments orthogonal to u; at the tip of the cut-off, |z_t| - z_n.
     */
    template <typename Vector>
    static double
    flow_at_cut_off(const FlowCone &cone,
                    const Vector   &z,
                    const Vector   &s,
                    const double    rounding)
    {
      constexpr int n_tangential = Vector::RowsAtCompileTime - 1;
      const double  radius       = FlowCone::tangential_norm(s);
      if (radius <= rounding)
        return std::max(0., FlowCone::tangential_norm(z) - z[0]);
      const auto   u       = (s.template tail<n_tangential>() / radius).eval();
      const double w       = -z.template tail<n_tangential>().dot(u);
      const double across  = (z.template tail<n_tangential>() + w * u).norm();
      const double of_cut  = (z[0] - cone.b * w) / (1. - cone.b);
      const double of_cone = w - of_cut;
      const bool   is_on_cone = radius > cone.a * s[0] + cone.k - rounding;
      return across + std::max(0., -of_cut) +
             (is_on_cone ? std::max(0., -of_cone) : std::abs(of_cone));
    }
  };

  /** Stresses and strain increment of a point in one step, as full tensors. */
  struct PointStep
  {
    SpatialMandel strain;    ///< strain increment (-)
    SpatialMandel stress_n;  ///< stress at t_n (Pa)
    SpatialMandel stress;    ///< stress at t_{n+1} (Pa)
    const double *history_n; ///< history variables at t_n
  };
} // namespace geocone::GEOCONE_DIM

#endif
