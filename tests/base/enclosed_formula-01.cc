// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Bounds of formulas by interval arithmetic. In random boxes the values of muParser
// and their differences must be inside the bounds of values and gradients, in a box
// without extent both must agree, and on random triangles the formula must lie between
// its linear bounds, whose distance must fall with the square of the triangle's size
// where the formula is smooth.

#include <geocone/functions/enclosed_formula.h>
#include <geocone/functions/expression.h>
#include <geocone/functions/formula.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace base_enclosed_formula_01
{
  using namespace geocone;
  using dealii::Point;

  std::mt19937 random_bits(1);

  double
  uniform(const double a, const double b)
  {
    return std::uniform_real_distribution<double>(a, b)(random_bits);
  }

  RealInterval
  around(const double x, const double size)
  {
    return {x - size * uniform(0., 1.), x + size * uniform(0., 1.)};
  }

  bool
  is_in(const double value, const RealInterval &bounds, const double rounding)
  {
    return value >= lower(bounds) - rounding &&
           value <= upper(bounds) + rounding;
  }

  /** Counts values outside of the bounds. */
  unsigned int
  outside(const EnclosedFormula &enclosed, const Expression &exact)
  {
    unsigned int n = 0;
    for (unsigned int i = 0; i < 300; ++i)
      {
        const double      size = std::pow(10., uniform(-6., 0.));
        const Point<2>    x(uniform(0.2, 2.), uniform(0.3, 2.));
        const IntervalBox point = {{RealInterval(x[0]), RealInterval(x[1])}},
                          box   = {{around(x[0], 0.1 * size),
                                    around(x[1], 0.1 * size)}};
        const Enclosure here = enclosed.in(point), all = enclosed.in(box);
        const double    value = exact.value(x, 0.),
                     rounding = 1e-12 * (1. + std::abs(value));
        n += !is_in(value, here.value, rounding);
        n += here.is_lipschitz && width(here.value) > 2. * rounding;
        const auto in_box = [&]() {
          return Point<2>(uniform(lower(box[0]), upper(box[0])),
                          uniform(lower(box[1]), upper(box[1])));
        };
        for (unsigned int j = 0; j < 10; ++j)
          {
            const Point<2> a = in_box(), b = in_box();
            const double   of_a = exact.value(a, 0.), of_b = exact.value(b, 0.);
            n += !is_in(of_a, all.value, rounding);
            if (!all.is_lipschitz)
              continue;
            const RealInterval change =
              all.gradient[0] * (b[0] - a[0]) + all.gradient[1] * (b[1] - a[1]);
            n += !is_in(of_b - of_a, change, rounding);
          }
      }
    return n;
  }

  using Triangle = std::array<Point<2>, 3>;

  Triangle
  triangle(const Point<2> &x, const double size, const Triangle &shape)
  {
    Triangle t;
    for (unsigned int i = 0; i < 3; ++i)
      t[i] = x + size * (shape[i] - Point<2>());
    return t;
  }

  /** Counts values beyond the linear bounds. */
  unsigned int
  beyond(const EnclosedFormula &enclosed,
         const Expression      &exact,
         const Triangle        &t)
  {
    const auto   bounds = enclosed.on_simplex(t);
    unsigned int n      = 0;
    for (unsigned int j = 0; j < 50; ++j)
      {
        double a = uniform(0., 1.), b = uniform(0., 1.);
        if (a + b > 1.)
          {
            a = 1. - a;
            b = 1. - b;
          }
        const double   c = 1. - a - b;
        const Point<2> x(c * t[0] + a * t[1] + b * t[2]);
        const double   value = exact.value(x, 0.);
        const auto     at    = [&](const std::array<double, 3> &v) {
          return c * v[0] + a * v[1] + b * v[2];
        };
        n += !(at(bounds.below) <= value && value <= at(bounds.above));
      }
    return n;
  }

  double
  distance(const EnclosedFormula &enclosed, const Triangle &t)
  {
    const auto bounds = enclosed.on_simplex(t);
    double     sum    = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      sum += (bounds.above[i] - bounds.below[i]) / 3.;
    return sum;
  }

  void
  test()
  {
    for (const char *text :
         {"1000",
          "2 + 3*x - y",
          "x^2 - 2*x*y + -y^2/3",
          "2^-x^2 + x^0.5 - (x - y)^3 + 2^3^x/10",
          "-x^2*3 - -y",
          "exp(-x) + ln(x + y) + log(x) + log10(y) + log2(x*y)",
          "sin(3*x)*cos(5*y) + tan(x/2) + sec(x/3) + csc(x) + cot(y)",
          "sqrt(x^2 + y^2) + abs(x - y)",
          "max(x, y, 1) - min(x, 2*y) + avg(x, y, 3) + sum(x, y)",
          "if(x < 1, 3, 3 + 10*(x - 1))",
          "x > y ? 5 : 7 - x",
          "(x > 1) & (y < 1) | (x*y == 1)",
          "floor(4*x) + ceil(y) - int(3*x) + rint(y) + sign(x - 1)",
          "atan2(y - 1, x) + atan(x) + asin(x/3) + acos(y/3) + atanh(y/4)",
          "sinh(x) + cosh(y) + tanh(x*y) + asinh(x - y) + acosh(1.5 + x)",
          "erfc(x - 1) + pow(x, y) + pow(y, 3) + _e - pi",
          "20e3*(1 + 0.3*sin(2*pi*x/5)) + 2.5e3*max(0, 2 - y)",
          "1/(x + 0.1) + x/y/2 - 3/(2 + cos(x))",
          "y <= 1 != (x >= 1)",
          "if(0.4*x, 1, 2) + (x & 1) + (0.3 | y) + (0.4 ? 1 : 2)",
          "int(x - 1.5)*int(5*y - 6.5) + sqrt(abs(x - 1)) + 3"})
      {
        check_formula(text, "test", FormulaVariables::place);
        Expression exact;
        exact.prepare(text, "test");
        const EnclosedFormula enclosed{std::string(text)};
        unsigned int          n_beyond = 0;
        double                fine = 0., coarse = 0.;
        for (unsigned int i = 0; i < 20; ++i)
          {
            Triangle shape;
            for (Point<2> &x : shape)
              x = Point<2>(uniform(0., 1.), uniform(0., 1.));
            const Point<2> x(uniform(0.2, 1.), uniform(0.3, 1.));
            n_beyond += beyond(enclosed, exact, triangle(x, 0.2, shape)) +
                        beyond(enclosed, exact, triangle(x, 1e-3, shape));
            fine += distance(enclosed, triangle(x, 1e-3, shape));
            coarse += distance(enclosed, triangle(x, 1e-2, shape));
          }
        std::printf("%s: %u and %u outside, %s\n",
                    text,
                    outside(enclosed, exact),
                    n_beyond,
                    coarse < 1e-7           ? "exact"
                    : fine < 0.013 * coarse ? "second order"
                                            : "kinks or jumps");
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace base_enclosed_formula_01
