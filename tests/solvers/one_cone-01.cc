// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, a Gauss-Seidel sweep could leave a cone unsolved. The problem
// of one cone always has a solution: 100000 random ones, over 12 orders of
// magnitude of W and 8 of the stress, must be solved to rounding, with the edges
// of the law among them (a = 0, a = 1e-6, k = 0, b = 0, b = a, isotropic W, q on
// the axis, q = 0). For b = a the solution is unique: it must not depend on the
// guess. For b = 0 there can be several: all must be found, and each must be the
// answer to a guess next to it.

#include <geocone/reduced/one_cone.h>
#include <geocone/reduced/reduced_problem.h>

#include "../cone/cone_tests.h"
#include "../test.h"

namespace solvers_one_cone_01
{
  using namespace cone_tests;
  using namespace geocone;

  /** |s - P_C(s - rho Psi(z))| over the size of what is subtracted in it. */
  double
  error(const FlowCone     &cone,
        const MandelMatrix &W,
        const Mandel       &q,
        const Mandel       &s)
  {
    const double rho = natural_scale(W);
    const double map = natural_map_norm(cone, s, Mandel(W * s + q), rho);
    return map > 0. ? map / (s.norm() + cone.k + rho * q.norm()) : 0.;
  }

  /** R R' + ridge I for a random R. */
  MandelMatrix
  positive_definite(const double ridge, Random &random)
  {
    MandelMatrix R;
    for (int j = 0; j < 3; ++j)
      R.col(j) = random.vector<Mandel>(1.);
    return R * R.transpose() + ridge * MandelMatrix::Identity();
  }

  void
  check_errors()
  {
    Random       random;
    Largest      of_all, of_one, dependence;
    unsigned int inside = 0, surface = 0, apex = 0;
    const auto   power = [&](const double begin, const double end) {
      return std::pow(10., random(begin, end));
    };
    for (unsigned int i = 0; i < 100000; ++i)
      {
        const double stress = power(-3., 5.), scale = power(-9., 3.);
        const bool   flat = i % 5 == 1, stiff = i % 4 == 0;
        FlowCone     cone;
        cone.a = i % 5 == 0 ? 0. : flat ? power(-6., 0.) : random(0., 1.);
        cone.b = i % 3 == 0   ? cone.a
                 : i % 3 == 1 ? 0.
                              : cone.a * random(0., 1.);
        cone.k = i % 7 == 0 ? 0. : stress * power(-2., 1.);
        MandelMatrix W = positive_definite(stiff ? 1e-4 : 0.1, random);
        if (i % 11 == 0)
          W.setIdentity();
        W *= scale;
        Mandel q = 3. * stress * scale * random.vector<Mandel>(1.);
        if (i % 13 == 0)
          q.tail<2>().setZero();
        if (i % 17 == 0)
          q[0] = 0.;

        const OneConeSolutions solutions = one_cone_solutions(cone, W, q);
        for (int j = 0; j < solutions.cols(); ++j)
          of_all.add(error(cone, W, q, solutions.col(j)));
        const Mandel first  = solutions.col(0);
        const double radius = cone.a * first[0] + cone.k;
        const double T      = FlowCone::tangential_norm(first);
        ++(T < (1. - 1e-9) * radius ? inside : T > 0. ? surface : apex);

        Mandel deep = Mandel::Zero(), tip = Mandel::Zero();
        deep[0] = 5. * stress;
        if (cone.a > 0.)
          tip[0] = -cone.k / cone.a;
        for (const Mandel &guess :
             {deep, tip, Mandel(3. * stress * random.vector<Mandel>(1.))})
          {
            const Mandel s = solve_one_cone(cone, W, q, guess);
            of_one.add(error(cone, W, q, s));
            // Where the solution is badly conditioned rounding moves it.
            if (cone.b == cone.a && !flat && !stiff)
              dependence.add((s - first).norm() / (stress + first.norm()));
          }
      }
    print("more than 10000 inside, on the surface, and at the apex",
          inside > 10000 && surface > 10000 && apex > 10000);
    print_below("error of all solutions", of_all, "1e-13");
    print_below("error of the one for a guess", of_one, "1e-13");
    print_below("b = a: dependence on the guess", dependence, "1e-9");
  }

  void
  check_several()
  {
    Random       random;
    unsigned int several = 0, lost = 0, left = 0;
    for (unsigned int i = 0; i < 20000; ++i)
      {
        const FlowCone         cone{i % 2 == 0 ? 0.9 : 3., 0., random(0., 1.)};
        const MandelMatrix     W         = positive_definite(1e-3, random);
        const Mandel           q         = random.vector<Mandel>(1.);
        const OneConeSolutions solutions = one_cone_solutions(cone, W, q);
        const auto             is_among  = [&](const Mandel &s) {
          return (solutions.colwise() - s).colwise().norm().minCoeff() <
                 1e-6 * (1. + s.norm());
        };
        several += solutions.cols() > 1;
        for (int j = 0; j < solutions.cols(); ++j)
          {
            const Mandel s = solutions.col(j);
            left += (solve_one_cone(cone, W, q, s) - s).norm() >
                    1e-6 * (1. + s.norm());
          }
        // Newton's method for f from many angles knows nothing of the quartic.
        for (unsigned int j = 0; j < 32; ++j)
          {
            const double x = 2. * pi * j / 32;
            lost += !is_among(
              solve_one_cone(cone, W, q, {-10., std::cos(x), std::sin(x)}));
          }
      }
    print("b = 0: more than 500 problems with several solutions",
          several > 500);
    print("all that Newton's method finds are among them", lost == 0);
    print("each is the answer to itself as a guess", left == 0);
  }

  void
  test()
  {
    check_errors();
    check_several();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_one_cone_01
