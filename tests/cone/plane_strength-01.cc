// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The closed forms of the strength laws in plane strain agree with the elimination by QR
// factors, for the matrix A of the same law.

#include <geocone/bounds/plane_strength.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_plane_strength_01
{
  using namespace cone_tests;
  using namespace geocone;
  using Eigen::Vector3d;
  using AnyLaw = StrengthLaw<SecondOrderCone<3>, 3, 0>;

  template <typename Law>
  void
  check(const std::string &name, const Law &law, const AnyLaw &same)
  {
    Random     random;
    Largest    stiffness, given, response, stress, cone, flow;
    const auto difference = [](const auto &a, const auto &b) {
      return (a - b).norm() / std::max(b.norm(), 1.);
    };
    for (unsigned int i = 0; i < 2000; ++i)
      {
        using Cone        = SecondOrderCone<3>;
        const auto inside = [&]() {
          return Cone::raised(random.vector<Vector3d>(1.), random(0.01, 1.));
        };
        const Vector3d x = inside(), z = inside(),
                       d = random.vector<Vector3d>(1.),
                       r = random.vector<Vector3d>(1.),
                       e = random.vector<Vector3d>(1.);
        const double w   = random(0.1, 10.);

        typename Law::Elimination closed;
        AnyLaw::Elimination       any;
        closed.scale(law, x, z, w);
        any.scale(same, x, z, w);
        stiffness.add(difference(closed.stiffness(w), any.stiffness(w)));
        given.add(difference(closed.given(d, r, w), any.given(d, r, w)));
        response.add(difference(closed.response(e, w), any.response(e, w)));
        Vector3d dy, dx, dz, dy_any, dx_any, dz_any;
        if constexpr (Law::x_is_variable)
          {
            closed.complete(law, d, r, e, w, dx, dz);
            dy = dx;
          }
        else
          closed.complete(law, d, r, e, w, dy, dx, dz);
        any.complete(same, d, r, e, w, dy_any, dx_any, dz_any);
        stress.add(difference(dy, dy_any));
        cone.add(difference(dx, dx_any));
        flow.add(difference(dz, dz_any));
        flow.add(difference(law.flow(z), same.flow(z)));
        flow.add(difference(law.rates_of_cone(e), same.rates_of_cone(e)));
      }
    std::cout << name << "\n";
    print_below("stiffness", stiffness, "1e-9");
    print_below("given stress", given, "1e-9");
    print_below("response", response, "1e-9");
    print_below("stress increment", stress, "1e-9");
    print_below("increment of X", cone, "1e-9");
    print_below("increment of Z, and flow", flow, "1e-9");
  }

  void
  test()
  {
    AnyLaw same;
    same.A    = -Eigen::Matrix3d::Identity();
    same.o[0] = 1.;
    same.finish();
    check("cone", PlaneCone{{}, 0.5}, same);
    same.A(0, 0)        = 0.;
    same.null_vector[0] = 1.;
    same.finish();
    check("cylinder", PlaneCylinder(), same);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_plane_strength_01
