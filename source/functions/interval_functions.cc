// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/functions/interval_functions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace geocone::GEOCONE_DIM
{
  namespace enclosures
  {
    namespace
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();

    } // namespace

    Enclosure
    constant(const RealInterval &value)
    {
      Enclosure e;
      e.value = value;
      e.gradient.fill(RealInterval(0.));
      return e;
    }

    namespace
    {
      /** A value that may jump between bounds. */
      Enclosure
      jump(const RealInterval &value)
      {
        Enclosure e    = constant(value);
        e.is_lipschitz = lower(value) == upper(value);
        return e;
      }

      bool
      is_bounded(const RealInterval &x)
      {
        return std::isfinite(lower(x)) && std::isfinite(upper(x));
      }

      /** The same, with all numbers where a bound is none, e.g. infinity less infinity. */
      Enclosure
      tidy(Enclosure e)
      {
        const auto is_none = [](const RealInterval &x) {
          return std::isnan(lower(x)) || std::isnan(upper(x));
        };
        if (is_none(e.value))
          e.value = RealInterval(-infinity, infinity);
        for (RealInterval &slope : e.gradient)
          if (is_none(slope))
            slope = RealInterval(-infinity, infinity);
        e.is_lipschitz =
          e.is_lipschitz && is_bounded(e.value) &&
          std::all_of(e.gradient.begin(), e.gradient.end(), is_bounded);
        return e;
      }

      /** The function with the value f and the slope f' of its argument. */
      Enclosure
      chained(const Enclosure    &x,
              const RealInterval &f,
              const RealInterval &slope)
      {
        Enclosure e = constant(f);
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = slope * x.gradient[d];
        e.is_lipschitz = x.is_lipschitz && is_bounded(slope);
        return tidy(e);
      }

      Enclosure
      sum(const Enclosure &a, const Enclosure &b, const double sign = 1.)
      {
        Enclosure e = constant(a.value + sign * b.value);
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = a.gradient[d] + sign * b.gradient[d];
        e.is_lipschitz = a.is_lipschitz && b.is_lipschitz;
        return tidy(e);
      }

      Enclosure
      product(const Enclosure &a, const Enclosure &b)
      {
        Enclosure e = constant(a.value * b.value);
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = a.gradient[d] * b.value + a.value * b.gradient[d];
        e.is_lipschitz = a.is_lipschitz && b.is_lipschitz;
        return tidy(e);
      }

      Enclosure
      reciprocal(const Enclosure &x)
      {
        if (zero_in(x.value))
          return jump(RealInterval(-infinity, infinity));
        const RealInterval f = RealInterval(1.) / x.value;
        return chained(x, f, -square(f));
      }

      /** One of several branches, not known which. */
      Enclosure
      any_of(const Enclosure &a, const Enclosure &b, const bool continuous)
      {
        Enclosure e = constant(hull(a.value, b.value));
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = hull(a.gradient[d], b.gradient[d]);
        e.is_lipschitz = continuous && a.is_lipschitz && b.is_lipschitz;
        return e;
      }

      Enclosure
      larger(const Enclosure &a, const Enclosure &b)
      {
        if (lower(a.value) >= upper(b.value))
          return a;
        if (lower(b.value) >= upper(a.value))
          return b;
        Enclosure e = any_of(a, b, true);
        e.value     = max(a.value, b.value);
        return e;
      }

    } // namespace

    Enclosure
    negative(const Enclosure &x)
    {
      return product(constant(RealInterval(-1.)), x);
    }

    namespace
    {
      Enclosure
      smaller(const Enclosure &a, const Enclosure &b)
      {
        return negative(larger(negative(a), negative(b)));
      }

      /** An increasing function between its values at both ends, and its slope. Where it
   *  is not defined, its values are NaN: nothing is known. */
      Enclosure
      increasing(const Enclosure &x,
                 double (*f)(double),
                 const RealInterval &slope,
                 const bool          is_decreasing = false)
      {
        double a = f(lower(x.value)), b = f(upper(x.value));
        if (is_decreasing)
          std::swap(a, b);
        if (std::isnan(a) || std::isnan(b))
          return jump(RealInterval(-infinity, infinity));
        return chained(x, RealInterval(a, b), slope);
      }

      /** A step function. */
      Enclosure
      steps(const Enclosure &x, double (*f)(double))
      {
        return jump(RealInterval(f(lower(x.value)), f(upper(x.value))));
      }

      /** cos(x) in an interval. */
      RealInterval
      cosine(const RealInterval &x)
      {
        if (!is_bounded(x) || width(x) >= 2. * pi)
          return RealInterval(-1., 1.);
        const double a = std::cos(lower(x)), b = std::cos(upper(x));
        RealInterval f(std::min(a, b), std::max(a, b));
        // Multiples k of pi inside are extrema; near ones are counted, too.
        const double first = std::ceil(lower(x) / pi - 1e-9),
                     last  = std::floor(upper(x) / pi + 1e-9);
        for (double k = first; k <= last; k += 1.)
          f =
            hull(f, RealInterval(std::fmod(std::abs(k), 2.) == 0. ? 1. : -1.));
        return f;
      }

      RealInterval
      sine(const RealInterval &x)
      {
        return cosine(x - RealInterval(pi / 2.));
      }

      Enclosure
      sine_of(const Enclosure &x)
      {
        return chained(x, sine(x.value), cosine(x.value));
      }

      Enclosure
      cosine_of(const Enclosure &x)
      {
        return chained(x, cosine(x.value), -sine(x.value));
      }

      /** RealInterval of a monotone function of the argument, for slopes. */
      RealInterval
      between(const double a, const double b)
      {
        if (std::isnan(a) || std::isnan(b))
          return RealInterval(-infinity, infinity);
        return RealInterval(std::min(a, b), std::max(a, b));
      }

      RealInterval
      reciprocal_of(const RealInterval &x)
      {
        return zero_in(x) ? RealInterval(-infinity, infinity)
                          : RealInterval(1.) / x;
      }

      Enclosure
      exponential(const Enclosure &x)
      {
        const RealInterval slope =
          between(std::exp(lower(x.value)), std::exp(upper(x.value)));
        return increasing(x, std::exp, slope);
      }

      Enclosure
      logarithm(const Enclosure &x)
      {
        if (lower(x.value) <= 0.)
          return jump(RealInterval(-infinity, infinity));
        return increasing(x, std::log, reciprocal_of(x.value));
      }

      Enclosure
      scaled(const Enclosure &x, const double factor)
      {
        return product(x, constant(RealInterval(factor)));
      }

      Enclosure
      root(const Enclosure &x)
      {
        const double a = lower(x.value), b = upper(x.value);
        if (a < 0.)
          return jump(RealInterval(-infinity, infinity));
        return increasing(
          x,
          std::sqrt,
          a > 0. ? RealInterval(0.5 / std::sqrt(b), 0.5 / std::sqrt(a))
                 : RealInterval(0., infinity));
      }

      Enclosure
      magnitude(const Enclosure &x)
      {
        Enclosure e = larger(x, negative(x));
        e.value = RealInterval(std::max(lower(e.value), 0.), upper(e.value));
        return e;
      }

      Enclosure
      power(const Enclosure &x, const Enclosure &exponent)
      {
        const double n = lower(exponent.value);
        if (n == upper(exponent.value) && n == std::round(n) &&
            std::abs(n) <= 1000.)
          {
            if (n < 0.)
              return reciprocal(power(x, constant(RealInterval(-n))));
            const int whole = int(n);
            if (whole == 0)
              return constant(RealInterval(1.));
            return chained(x,
                           pow(x.value, whole),
                           whole == 1
                             ? RealInterval(1.)
                             : double(whole) * pow(x.value, whole - 1));
          }
        if (lower(x.value) > 0.)
          return exponential(product(exponent, logarithm(x)));
        if (lower(x.value) == 0. && lower(exponent.value) > 0.)
          {
            const double most = upper(x.value);
            Enclosure    e    = constant(
              RealInterval(0.,
                           std::max(std::pow(most, lower(exponent.value)),
                                    std::pow(most, upper(exponent.value)))));
            e.is_lipschitz = false;
            return tidy(e);
          }
        return jump(RealInterval(-infinity, infinity));
      }

      Enclosure
      angle(const Enclosure &y, const Enclosure &x)
      {
        const auto tangent = [](const Enclosure &t) {
          return increasing(t,
                            std::atan,
                            RealInterval(1.) /
                              (RealInterval(1.) + square(t.value)));
        };
        if (lower(x.value) > 0.)
          return tangent(product(y, reciprocal(x)));
        if (lower(y.value) > 0. || upper(y.value) < 0.)
          return sum(
            constant(RealInterval(lower(y.value) > 0. ? pi / 2. : -pi / 2.)),
            tangent(product(x, reciprocal(y))),
            -1.);
        return jump(RealInterval(-pi, pi));
      }

      /** Truth of a value, of `?:` that of a number that is not zero: 1, 0, or not
     *  known. */
      RealInterval
      truth(const RealInterval &x)
      {
        if (lower(x) == 0. && upper(x) == 0.)
          return RealInterval(0.);
        return zero_in(x) ? RealInterval(0., 1.) : RealInterval(1.);
      }

      /** Truth in `if`, `&` and `|`: that of the nearest whole number. */
      RealInterval
      rounded_truth(const RealInterval &x)
      {
        return is_bounded(x) ? truth(RealInterval(std::round(lower(x)),
                                                  std::round(upper(x))))
                             : RealInterval(0., 1.);
      }

      /** 1 where all values of x are positive, 0 where none is. */
      RealInterval
      is_positive(const RealInterval &x, const bool or_zero)
      {
        if (or_zero ? lower(x) >= 0. : lower(x) > 0.)
          return RealInterval(1.);
        if (or_zero ? upper(x) < 0. : upper(x) <= 0.)
          return RealInterval(0.);
        return RealInterval(0., 1.);
      }

    } // namespace

    Enclosure
    choice(const RealInterval &condition,
           const Enclosure    &a,
           const Enclosure    &b)
    {
      if (lower(truth(condition)) == 1.)
        return a;
      if (upper(truth(condition)) == 0.)
        return b;
      return any_of(a, b, false);
    }

    namespace
    {
      double
      nearest(const double x)
      {
        return std::floor(x + 0.5);
      }

      double
      sign(const double x)
      {
        return x > 0. ? 1. : x < 0. ? -1. : 0.;
      }

      /** Functions of one argument, with their slopes. */
      using Functions = std::map<std::string, Enclosure (*)(const Enclosure &)>;
      using E         = const Enclosure &;

      /** Trigonometric functions and their inverses. */
      const Functions &
      trigonometric_functions()
      {
        static const Functions all = {
          {"acos",
           [](E x) {
             const RealInterval s = RealInterval(1.) - square(x.value);
             return increasing(x,
                               std::acos,
                               lower(s) > 0.
                                 ? -reciprocal_of(sqrt(s))
                                 : RealInterval(-infinity, infinity),
                               true);
           }},
          {"asin",
           [](E x) {
             const RealInterval s = RealInterval(1.) - square(x.value);
             return increasing(x,
                               std::asin,
                               lower(s) > 0.
                                 ? reciprocal_of(sqrt(s))
                                 : RealInterval(-infinity, infinity));
           }},
          {"atan",
           [](E x) {
             return increasing(
               x, std::atan, reciprocal_of(RealInterval(1.) + square(x.value)));
           }},
          {"cos", cosine_of},
          {"cot",
           [](E x) { return product(cosine_of(x), reciprocal(sine_of(x))); }},
          {"csc", [](E x) { return reciprocal(sine_of(x)); }},
          {"sec", [](E x) { return reciprocal(cosine_of(x)); }},
          {"sin", sine_of},
          {"tan",
           [](E x) { return product(sine_of(x), reciprocal(cosine_of(x))); }}};
        return all;
      }

      /** Hyperbolic functions and their inverses. */
      const Functions &
      hyperbolic_functions()
      {
        static const Functions all = {
          {"acosh",
           [](E x) {
             const RealInterval s = square(x.value) - RealInterval(1.);
             return increasing(x,
                               std::acosh,
                               lower(x.value) > 1.
                                 ? reciprocal_of(sqrt(s))
                                 : RealInterval(-infinity, infinity));
           }},
          {"asinh",
           [](E x) {
             return increasing(
               x,
               std::asinh,
               reciprocal_of(sqrt(square(x.value) + RealInterval(1.))));
           }},
          {"atanh",
           [](E x) {
             return increasing(
               x,
               std::atanh,
               reciprocal_of(RealInterval(1.) - square(x.value)));
           }},
          {"cosh",
           [](E x) {
             return scaled(sum(exponential(x), exponential(negative(x))), 0.5);
           }},
          {"sinh",
           [](E x) {
             const RealInterval slope =
               (between(std::exp(lower(x.value)), std::exp(upper(x.value))) +
                between(std::exp(-lower(x.value)), std::exp(-upper(x.value)))) *
               0.5;
             return increasing(x, std::sinh, slope);
           }},
          {"tanh", [](E x) {
             const RealInterval t =
               between(std::tanh(lower(x.value)), std::tanh(upper(x.value)));
             return increasing(x, std::tanh, RealInterval(1.) - square(t));
           }}};
        return all;
      }

      /** Other functions of one argument. */
      const Functions &
      other_functions_of_one()
      {
        static const Functions all = {
          {"abs", magnitude},
          {"ceil", [](E x) { return steps(x, std::ceil); }},
          {"erfc",
           [](E x) {
             const Enclosure bell = exponential(negative(product(x, x)));
             return increasing(
               x, std::erfc, -2. / std::sqrt(pi) * bell.value, true);
           }},
          {"exp", exponential},
          {"floor", [](E x) { return steps(x, std::floor); }},
          {"int", [](E x) { return steps(x, std::round); }},
          {"ln", logarithm},
          {"log", logarithm},
          {"log10",
           [](E x) { return scaled(logarithm(x), 1. / std::log(10.)); }},
          {"log2", [](E x) { return scaled(logarithm(x), 1. / std::log(2.)); }},
          {"rint", [](E x) { return steps(x, nearest); }},
          {"sign", [](E x) { return steps(x, sign); }},
          {"sqrt", root}};
        return all;
      }

      /** Folds a function of two arguments over several ones. */
      template <typename Pair>
      Function
      folded(const Pair &pair)
      {
        return [pair](const std::vector<Enclosure> &x) {
          Enclosure e = x[0];
          for (unsigned int i = 1; i < x.size(); ++i)
            e = pair(e, x[i]);
          return e;
        };
      }

      /** Functions of several arguments. */
      const std::map<std::string, Function> &
      functions_of_several()
      {
        using All      = const std::vector<Enclosure> &;
        const auto add = [](E a, E b) { return sum(a, b); };
        static const std::map<std::string, Function> all = {
          {"atan2", [](All x) { return angle(x[0], x[1]); }},
          {"avg",
           [total = folded(add)](All x) {
             return scaled(total(x), 1. / double(x.size()));
           }},
          {"if",
           [](All x) { return choice(rounded_truth(x[0].value), x[1], x[2]); }},
          {"max", folded(larger)},
          {"min", folded(smaller)},
          {"pow", [](All x) { return power(x[0], x[1]); }},
          {"sum", folded(add)}};
        return all;
      }

      /** Returns the bounds of a - b. */
      RealInterval
      difference(const Enclosure &a, const Enclosure &b)
      {
        return a.value - b.value;
      }
    } // namespace

    Operator
    operator_of(const std::string &name)
    {
      static const std::map<std::string, Operator> all = {
        {"+", [](E a, E b) { return sum(a, b); }},
        {"-", [](E a, E b) { return sum(a, b, -1.); }},
        {"*", product},
        {"/", [](E a, E b) { return product(a, reciprocal(b)); }},
        {"^", power},
        {"<",
         [](E a, E b) { return jump(is_positive(difference(b, a), false)); }},
        {"<=",
         [](E a, E b) { return jump(is_positive(difference(b, a), true)); }},
        {">",
         [](E a, E b) { return jump(is_positive(difference(a, b), false)); }},
        {">=",
         [](E a, E b) { return jump(is_positive(difference(a, b), true)); }},
        {"!=", [](E a, E b) { return jump(truth(difference(a, b))); }},
        {"==",
         [](E a, E b) {
           return jump(RealInterval(1.) - truth(difference(a, b)));
         }},
        {"&",
         [](E a, E b) {
           return jump(min(rounded_truth(a.value), rounded_truth(b.value)));
         }},
        {"|", [](E a, E b) {
           return jump(max(rounded_truth(a.value), rounded_truth(b.value)));
         }}};
      return all.at(name);
    }

    Function
    function_of(const std::string &name)
    {
      for (const Functions *all : {&trigonometric_functions(),
                                   &hyperbolic_functions(),
                                   &other_functions_of_one()})
        if (const auto one = all->find(name); one != all->end())
          return [f = one->second](const std::vector<Enclosure> &x) {
            return f(x[0]);
          };
      return functions_of_several().at(name);
    }
  } // namespace enclosures
} // namespace geocone::GEOCONE_DIM
