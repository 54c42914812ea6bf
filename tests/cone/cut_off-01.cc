// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, soil would carry more tension than its tensile strength, or flow in
// another direction at the cut-off. Returned stresses are admissible and obey the flow
// rules of cone and cut-off, found independently of the return map; associated ones are
// the nearest in the elastic metric; the tangent is that of differences.

#include <geocone/cone/flow_check.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_cut_off_01
{
  using namespace cone_tests;
  using geocone::FlowCheck;
  using geocone::FlowCone;
  using geocone::Mode;

  FlowCone
  cone_of(const double a, const double b, const double cut_off)
  {
    FlowCone cone{a, b, 1.};
    cone.cut_off = cut_off;
    return cone;
  }

  /** In which part a stress is: within, on the cone, on the cut-off, on both, at the tip. */
  unsigned int
  part_of(const FlowCone &cone, const Vector3 &s)
  {
    const double T       = FlowCone::tangential_norm(s);
    const bool   on_cone = T > cone.a * s[0] + cone.k - 1e-12;
    const bool   on_cut  = cone.beyond_cut_off(s) > -1e-12;
    return T < 1e-12 && on_cut ? 4 : on_cone + 2 * on_cut;
  }

  void
  check(const FlowCone &cone)
  {
    constexpr double K = 3., two_G = 1.3;
    const Vector3    D(K, two_G, two_G);
    Random           random;
    unsigned int     counts[5] = {0, 0, 0, 0, 0};
    Largest          beyond, flow, farther, difference, asymmetry;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const Vector3   t = random.vector<Vector3>(4.);
        Vector3         s;
        Eigen::Matrix3d C, differences, *none = nullptr;
        C.setConstant(std::nan(""));
        geocone::return_map(cone, K, two_G, t, s, &C);
        ++counts[part_of(cone, s)];
        beyond.add(cone.yield_function(s));
        const Vector3   z    = (s - t).cwiseQuotient(D);
        const FlowCheck here = FlowCheck::of_cone(cone, cone, z, s, two_G);
        flow.add(here.natural_map);
        if (cone.b == cone.a)
          for (unsigned int j = 0; j < 20; ++j)
            {
              const Vector3 x =
                geocone::project(cone, random.vector<Vector3>(4.));
              farther.add(z.dot(s - x));
            }
        // Where a small step does not lead to another part.
        bool smooth = true;
        for (int j = 0; j < 3; ++j)
          {
            Vector3 step = Vector3::Zero(), plus, minus;
            step[j]      = 1e-5;
            geocone::return_map(cone, K, two_G, Vector3(t + step), plus, none);
            geocone::return_map(cone, K, two_G, Vector3(t - step), minus, none);
            differences.col(j) = (plus - minus) / 2e-5 * D[j];
            smooth = smooth && part_of(cone, plus) == part_of(cone, s) &&
                     part_of(cone, minus) == part_of(cone, s);
          }
        if (smooth && FlowCone::tangential_norm(t) > 0.1)
          {
            difference.add((C - differences).norm() / K);
            asymmetry.add((C - C.transpose()).norm() / K);
          }
      }
    std::cout << "a = " << cone.a << ", b = " << cone.b
              << ", opening = " << cone.cut_off << ", h = " << cone.hardening
              << ": " << counts[0] << " within, " << counts[1] << " cone, "
              << counts[2] << " cut-off, " << counts[3] << " both, "
              << counts[4] << " tip" << std::endl;
    if (cone.hardening == 0.)
      print_below("  beyond the strength", beyond, "1e-14");
    if (cone.hardening == 0.)
      print_below("  flow", flow, "1e-12");
    if (cone.b == cone.a)
      print_below("  nearer points", farther, "1e-12");
    print_below("  tangent against differences", difference, "1e-6");
    print("  symmetric", asymmetry.value < 1e-14);
  }

  void
  test()
  {
    check(cone_of(0.423, 0.423, 0.5));
    check(cone_of(0.423, 0.2, 0.5));
    check(cone_of(0.423, 0., 0.));
    check(cone_of(0., 0., 0.5));
    check(cone_of(0., 0., 0.));
    FlowCone hard  = cone_of(0.423, 0.2, 0.5);
    hard.hardening = 0.7;
    check(hard);
    // A cut-off beyond the tip of the cone changes nothing.
    const FlowCone far = cone_of(0.423, 0.2, 2.5), none{0.423, 0.2, 1.};
    Random         random;
    Largest        other;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const Vector3    t = random.vector<Vector3>(4.);
        Vector3          s, expected;
        Eigen::Matrix3d *no_tangent = nullptr;
        geocone::return_map(far, 2., 1., t, s, no_tangent);
        geocone::return_map(none, 2., 1., t, expected, no_tangent);
        other.add((s - expected).norm());
      }
    print("a cut-off beyond the tip changes nothing", other.value == 0.);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_cut_off_01
