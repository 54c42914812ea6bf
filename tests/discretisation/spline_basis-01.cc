// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// B-splines on graded intervals must be what is claimed of them: not negative,
// with the sum 1, with the sum x of Greville abscissae times functions, with
// derivatives that are those of the values, of continuity p - 1 and not more
// (p - 2 at a double knot, also after the intervals have been moved), and with
// one function at each end. The Bernstein polynomials must be the
// binomial ones, and reproduce x by i/p.

#include <geocone/space/spline_basis.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace discretisation_spline_basis_01
{
  using namespace geocone;

  const std::vector<double> breaks = {-1., -0.9, -0.7, -0.3, 0.5, 0.6, 2.};

  void
  print(const char *what, const bool holds)
  {
    std::printf("  %s: %s\n", what, holds ? "yes" : "NO");
  }

  /** What holds on one interval, for N and dN/dxi from @p evaluate. */
  template <typename Evaluate, typename Abscissa>
  void
  check_interval(const unsigned int p,
                 const double       begin,
                 const double       end,
                 const Evaluate    &evaluate,
                 const Abscissa    &abscissa,
                 double (&worst)[4])
  {
    for (double xi = 0.; xi <= 1.; xi += 0.0625)
      {
        double N[max_degree + 1], dN[max_degree + 1];
        evaluate(xi, N, dN);
        double sum = -1., slopes = 0., x = -begin - xi * (end - begin);
        for (unsigned int i = 0; i <= p; ++i)
          {
            sum += N[i];
            slopes += dN[i];
            x += abscissa(i) * N[i];
            worst[0] = std::max(worst[0], -N[i]);
          }
        worst[1]       = std::max({worst[1], std::abs(sum), std::abs(slopes)});
        worst[2]       = std::max(worst[2], std::abs(x));
        const double d = 1e-5;
        double       above[max_degree + 1], below[max_degree + 1];
        double       unused[max_degree + 1];
        evaluate(xi + d, above, unused);
        evaluate(xi - d, below, unused);
        for (unsigned int i = 0; i <= p; ++i)
          worst[3] = std::max(
            worst[3], std::abs((above[i] - below[i]) / (2 * d) - dN[i]));
      }
  }

  void
  print_interval(const double (&worst)[4])
  {
    print("not negative", worst[0] <= 0.);
    print("the sum is 1, that of the derivatives 0", worst[1] < 1e-14);
    print("x is reproduced", worst[2] < 1e-14);
    print("derivatives are those of the values", worst[3] < 1e-8);
  }

  /** The derivatives of order 0 to 3 by x at an end of an interval. */
  void
  derivatives(const SplineBasis &basis,
              const unsigned int p,
              const unsigned int interval,
              const double       xi,
              double (&D)[4][max_degree + 1])
  {
    const double length = breaks[interval + 1] - breaks[interval];
    // Slopes are of degree p - 1 <= 2: their differences are exact, and do not
    // leave the interval.
    const double d = xi == 0. ? 0.25 : -0.25;
    double       slope[3][max_degree + 1], unused[max_degree + 1];
    basis.evaluate(interval, xi, D[0], slope[0]);
    basis.evaluate(interval, xi + d, unused, slope[1]);
    basis.evaluate(interval, xi + 2 * d, unused, slope[2]);
    for (unsigned int i = 0; i <= p; ++i)
      {
        const double *s[] = {slope[0], slope[1], slope[2]};
        D[1][i]           = s[0][i] / length;
        D[2][i] = (-1.5 * s[0][i] + 2. * s[1][i] - 0.5 * s[2][i]) / d /
                  (length * length);
        D[3][i] = (s[0][i] - 2. * s[1][i] + s[2][i]) / (d * d) /
                  (length * length * length);
      }
  }

  /** Checks splines on the intervals between the breaks, and their continuity
   *  at the breaks from @p first to @p last. */
  void
  check_splines(const unsigned int p,
                const SplineBasis &basis,
                const unsigned int first,
                const unsigned int last)
  {
    const unsigned int n        = basis.n_intervals();
    double             worst[4] = {};
    for (unsigned int k = 0; k < n; ++k)
      check_interval(
        p,
        breaks[k],
        breaks[k + 1],
        [&](const double xi, double *N, double *dN) {
          basis.evaluate(k, xi, N, dN);
        },
        [&](const unsigned int i) {
          return basis.greville(basis.first_function(k) + i);
        },
        worst);
    print_interval(worst);

    // Jumps of the derivatives at the inner breaks, where function i of the
    // interval after the break is i + s of the one before.
    double jump[4] = {};
    for (unsigned int k = first; k <= last; ++k)
      {
        const unsigned int s = basis.n_entering(k);
        double             left[4][max_degree + 1], right[4][max_degree + 1];
        derivatives(basis, p, k - 1, 1., left);
        derivatives(basis, p, k, 0., right);
        for (unsigned int d = 0; d <= p; ++d)
          for (unsigned int i = 0; i <= p; ++i)
            jump[d] =
              std::max({jump[d],
                        std::abs(left[d][i] - (i < s ? 0. : right[d][i - s])),
                        i + s > p ? std::abs(right[d][i]) : 0.});
      }
    for (unsigned int d = 0; d <= p; ++d)
      std::printf("  derivative %u is continuous: %s\n",
                  d,
                  jump[d] < 1e-9 ? "yes" : "no");

    double N[max_degree + 1], dN[max_degree + 1];
    basis.evaluate(0, 0., N, dN);
    bool ends = N[0] == 1.;
    for (unsigned int i = 1; i <= p; ++i)
      ends &= N[i] == 0.;
    basis.evaluate(n - 1, 1., N, dN);
    ends &= std::abs(N[p] - 1.) < 1e-15;
    for (unsigned int i = 0; i < p; ++i)
      ends &= std::abs(N[i]) < 1e-15;
    print("one function at each end", ends);
    print("Greville abscissae from end to end",
          std::abs(basis.greville(0) - breaks.front()) < 1e-15 &&
            std::abs(basis.greville(basis.n_functions() - 1) - breaks.back()) <
              1e-15);
  }

  void
  test()
  {
    for (unsigned int p = 1; p <= max_degree; ++p)
      {
        const SplineBasis basis(p, breaks);
        std::printf("splines of degree %u: %u functions on %u intervals\n",
                    p,
                    basis.n_functions(),
                    basis.n_intervals());
        check_splines(p, basis, 1, basis.n_intervals() - 1);
      }

    for (unsigned int p = 2; p <= max_degree; ++p)
      {
        std::vector<double> knots = breaks, elsewhere = breaks;
        knots.insert(knots.begin() + 3, breaks[3]);
        for (double &x : elsewhere)
          x = 2. * x + 1.; // back by move()
        elsewhere.insert(elsewhere.begin() + 3, elsewhere[3]);
        SplineBasis basis(p, elsewhere);
        basis.move(breaks);
        std::printf("splines of degree %u with a double knot: %u functions on "
                    "%u intervals\n",
                    p,
                    basis.n_functions(),
                    basis.n_intervals());
        check_splines(p, basis, 3, 3);
        bool is_same = true;
        for (unsigned int i = 0; i < basis.n_functions(); ++i)
          is_same &= basis.greville(i) == SplineBasis(p, knots).greville(i);
        print("moved like built there", is_same);
        unsigned int entering = 0, leaving = 0;
        bool         is_inside = true;
        for (unsigned int k = 0; k < basis.n_intervals(); ++k)
          {
            entering += basis.n_entering(k);
            leaving += basis.n_leaving(k);
          }
        for (unsigned int i = 0; i < basis.n_functions(); ++i)
          {
            const unsigned int at =
              basis.first_function(basis.middle_interval(i));
            is_inside &= at <= i && i <= at + p;
          }
        print("each function enters and leaves once",
              entering == basis.n_functions() &&
                leaving == basis.n_functions());
        print("the middle of a support is in it", is_inside);
      }

    for (unsigned int p = 1; p <= max_degree; ++p)
      {
        std::printf("Bernstein polynomials of degree %u\n", p);
        double worst[4] = {};
        check_interval(
          p,
          0.,
          1.,
          [&](const double xi, double *N, double *dN) {
            bernstein(p, xi, N, dN);
          },
          [&](const unsigned int i) { return double(i) / p; },
          worst);
        print_interval(worst);
        const unsigned int choose[4][4] = {{}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
        bool               binomial     = true;
        for (const double xi : {0., 0.2, 0.7, 1.})
          {
            double N[max_degree + 1], dN[max_degree + 1];
            bernstein(p, xi, N, dN);
            for (unsigned int i = 0; i <= p; ++i)
              binomial &= std::abs(N[i] - choose[p][i] * std::pow(xi, i) *
                                            std::pow(1. - xi, p - i)) < 1e-15;
          }
        print("binomial", binomial);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_spline_basis_01
