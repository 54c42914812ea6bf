// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, directions of the interior-point method of three-dimensional bounds
// would not be those of the central path. Checked are the identities that define the
// product and the scaling of each cone, for random pairs whose eigenvalues spread over six
// orders of magnitude, and that a step ends on the boundary.

#include <geocone/conic/symmetric_cones.h>

#include "../test.h"
#include "cone_tests.h"

namespace cone_symmetric_cones_01
{
  using namespace cone_tests;
  using geocone::ProductCone;
  using geocone::SecondOrderCone;
  using geocone::SemidefiniteCone;

  /** Smallest eigenvalue, by a step from the identity. */
  template <typename Cone>
  double
  least(const typename Cone::V &x)
  {
    // With x shifted and divided to be unit + step d on the boundary.
    const typename Cone::Scaling of_unit(Cone::unit(), Cone::unit());
    const double                 large = 10. * x.norm();
    const typename Cone::V       d     = x / large - Cone::unit();
    const double                 s     = of_unit.step(d); // unit + s d
    // The smallest eigenvalue of d is -1/s.
    return s < 1. / 0.99 ? large * (1. - 1. / s) : large;
  }

  template <typename Cone>
  void
  check(const std::string &name)
  {
    using V = typename Cone::V;
    Random  random;
    Largest scaling, division, inner, transpose, sum, boundary, identity,
      raised, excess, corrected, uncorrected;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const auto inside = [&]() {
          return Cone::raised(random.vector<V>(1.),
                              std::pow(10., random(-6., 0.)));
        };
        const V x = inside(), z = inside(), u = random.vector<V>(1.),
                v = random.vector<V>(1.);
        const typename Cone::Scaling W(x, z);
        const double                 size = W.lambda.norm();
        scaling.add((W.z_hat(z) - W.lambda).norm() / size);
        scaling.add((W.x_hat(x) - W.lambda).norm() / size);
        division.add((Cone::product(W.lambda, W.divide(u)) - u).norm());
        inner.add(std::abs(Cone::unit().dot(Cone::product(u, v)) - u.dot(v)));
        inner.add((Cone::product(Cone::unit(), u) - u).norm());
        inner.add(std::abs(Cone::unit().dot(Cone::unit()) - Cone::degree));
        // x_hat.z_hat = x.z, and z_of inverts z_hat.
        const V a = W.x_hat(u), b = W.z_hat(v);
        transpose.add(std::abs(a.dot(b) - u.dot(v)) / (a.norm() * b.norm()));
        transpose.add((W.z_hat(W.z_of(u)) - u).norm());
        sum.add(std::abs(x.dot(z) / W.lambda.squaredNorm() - 1.));
        // A step from the identity to the boundary.
        const typename Cone::Scaling one(Cone::unit(), Cone::unit());
        const V                      d = 3. * u;
        const double                 s = one.step(d);
        if (s < 1. / 0.99)
          boundary.add(std::abs(least<Cone>(Cone::unit() + s * d)));
        else
          boundary.add(-least<Cone>(Cone::unit() + 0.999 / 0.99 * d));
        const V r = Cone::raised(u, 0.3);
        raised.add(0.3 - least<Cone>(r));
        excess.add(-least<Cone>(u + Cone::excess(u) * Cone::unit()));
        excess.add(Cone::excess(x));
        const double target = std::pow(10., random(-2., 1.));
        corrected.add(0.1 * target -
                      least<Cone>(u + Cone::correction(u, target)));
        uncorrected.add(
          Cone::correction(target * Cone::unit() + 0.2 * target / u.norm() * u,
                           target)
            .norm());
      }
    std::cout << name << "\n";
    print_below("W z = W^-T x = lambda", scaling, "1e-9");
    print_below("product(lambda, divide(d)) = d", division, "1e-9");
    print_below(
      "unit.product(u, v) = u.v, product(unit, u) = u", inner, "1e-14");
    print_below("x_hat.z_hat = dx.dz, z_hat(z_of(d)) = d", transpose, "1e-9");
    print_below("x.z = lambda.lambda", sum, "1e-9");
    print_below("a step ends on the boundary", boundary, "1e-12");
    print_below("raised eigenvalues", raised, "1e-12");
    print_below("x + excess(x) unit in the cone", excess, "1e-12");
    print_below("corrected eigenvalues", corrected, "1e-12");
    print_below("no correction near the target", uncorrected, "1e-12");
  }

  void
  test()
  {
    check<SecondOrderCone<1>>("half-line");
    check<SecondOrderCone<3>>("second order, 3 components");
    check<SecondOrderCone<6>>("second order, 6 components");
    check<SemidefiniteCone>("semidefinite 3 x 3");
    check<ProductCone<SemidefiniteCone, SemidefiniteCone>>(
      "two semidefinite 3 x 3");
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace cone_symmetric_cones_01
