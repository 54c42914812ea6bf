// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/functions/enclosed_formula.h>

#include <boost/numeric/interval.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    namespace enclosing
    {
      /** Interval of real numbers. Bounds are rounded to nearest; linear bounds are widened
     *  by more than the rounding errors. */
      using RealInterval = boost::numeric::interval<
        double,
        boost::numeric::interval_lib::policies<
          boost::numeric::interval_lib::rounded_transc_exact<double>,
          boost::numeric::interval_lib::checking_base<double>>>;

      using Box = std::array<RealInterval, dim>;

      /** Enclosure in intervals. */
      struct Enclosed
      {
        RealInterval                  value;
        std::array<RealInterval, dim> gradient;
        bool                          is_lipschitz = true;
      };

      constexpr double infinity = std::numeric_limits<double>::infinity();

      using Function  = std::function<Enclosed(const Box &)>;
      using Arguments = std::vector<Function>;

      Enclosed
      constant(const RealInterval &value)
      {
        Enclosed e;
        e.value = value;
        e.gradient.fill(RealInterval(0.));
        return e;
      }

      /** A value that may jump between bounds. */
      Enclosed
      jump(const RealInterval &value)
      {
        Enclosed e     = constant(value);
        e.is_lipschitz = lower(value) == upper(value);
        return e;
      }

      bool
      is_bounded(const RealInterval &x)
      {
        return std::isfinite(lower(x)) && std::isfinite(upper(x));
      }

      /** The same, with all numbers where a bound is none, e.g. infinity less infinity. */
      Enclosed
      tidy(Enclosed e)
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
      Enclosed
      chained(const Enclosed     &x,
              const RealInterval &f,
              const RealInterval &slope)
      {
        Enclosed e = constant(f);
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = slope * x.gradient[d];
        e.is_lipschitz = x.is_lipschitz && is_bounded(slope);
        return tidy(e);
      }

      Enclosed
      sum(const Enclosed &a, const Enclosed &b, const double sign = 1.)
      {
        Enclosed e = constant(a.value + sign * b.value);
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = a.gradient[d] + sign * b.gradient[d];
        e.is_lipschitz = a.is_lipschitz && b.is_lipschitz;
        return tidy(e);
      }

      Enclosed
      product(const Enclosed &a, const Enclosed &b)
      {
        Enclosed e = constant(a.value * b.value);
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = a.gradient[d] * b.value + a.value * b.gradient[d];
        e.is_lipschitz = a.is_lipschitz && b.is_lipschitz;
        return tidy(e);
      }

      Enclosed
      reciprocal(const Enclosed &x)
      {
        if (zero_in(x.value))
          return jump(RealInterval(-infinity, infinity));
        const RealInterval f = RealInterval(1.) / x.value;
        return chained(x, f, -square(f));
      }

      /** One of several branches, not known which. */
      Enclosed
      any_of(const Enclosed &a, const Enclosed &b, const bool continuous)
      {
        Enclosed e = constant(hull(a.value, b.value));
        for (int d = 0; d < dim; ++d)
          e.gradient[d] = hull(a.gradient[d], b.gradient[d]);
        e.is_lipschitz = continuous && a.is_lipschitz && b.is_lipschitz;
        return e;
      }

      Enclosed
      larger(const Enclosed &a, const Enclosed &b)
      {
        if (lower(a.value) >= upper(b.value))
          return a;
        if (lower(b.value) >= upper(a.value))
          return b;
        Enclosed e = any_of(a, b, true);
        e.value    = max(a.value, b.value);
        return e;
      }

      Enclosed
      negative(const Enclosed &x)
      {
        return product(constant(RealInterval(-1.)), x);
      }

      Enclosed
      smaller(const Enclosed &a, const Enclosed &b)
      {
        return negative(larger(negative(a), negative(b)));
      }

      /** An increasing function between its values at both ends, and its slope. Where it
     *  is not defined, its values are NaN: nothing is known. */
      Enclosed
      increasing(const Enclosed &x,
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
      Enclosed
      steps(const Enclosed &x, double (*f)(double))
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

      Enclosed
      sine_of(const Enclosed &x)
      {
        return chained(x, sine(x.value), cosine(x.value));
      }

      Enclosed
      cosine_of(const Enclosed &x)
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

      Enclosed
      exponential(const Enclosed &x)
      {
        const RealInterval slope =
          between(std::exp(lower(x.value)), std::exp(upper(x.value)));
        return increasing(x, std::exp, slope);
      }

      Enclosed
      logarithm(const Enclosed &x)
      {
        if (lower(x.value) <= 0.)
          return jump(RealInterval(-infinity, infinity));
        return increasing(x, std::log, reciprocal_of(x.value));
      }

      Enclosed
      scaled(const Enclosed &x, const double factor)
      {
        return product(x, constant(RealInterval(factor)));
      }

      Enclosed
      root(const Enclosed &x)
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

      Enclosed
      magnitude(const Enclosed &x)
      {
        Enclosed e = larger(x, negative(x));
        e.value    = RealInterval(std::max(lower(e.value), 0.), upper(e.value));
        return e;
      }

      Enclosed
      power(const Enclosed &x, const Enclosed &exponent)
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
            Enclosed     e    = constant(
              RealInterval(0.,
                           std::max(std::pow(most, lower(exponent.value)),
                                    std::pow(most, upper(exponent.value)))));
            e.is_lipschitz = false;
            return tidy(e);
          }
        return jump(RealInterval(-infinity, infinity));
      }

      Enclosed
      angle(const Enclosed &y, const Enclosed &x)
      {
        const auto tangent = [](const Enclosed &t) {
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

      Enclosed
      choice(const RealInterval &condition,
             const Enclosed     &a,
             const Enclosed     &b)
      {
        if (lower(truth(condition)) == 1.)
          return a;
        if (upper(truth(condition)) == 0.)
          return b;
        return any_of(a, b, false);
      }

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

      using Unary = Enclosed (*)(const Enclosed &);

      /** Functions of one argument, with their slopes. */
      const std::map<std::string, Unary> &
      functions_of_one()
      {
        using E                                       = const Enclosed &;
        static const std::map<std::string, Unary> all = {
          {"abs", magnitude},
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
          {"acosh",
           [](E x) {
             const RealInterval s = square(x.value) - RealInterval(1.);
             return increasing(x,
                               std::acosh,
                               lower(x.value) > 1.
                                 ? reciprocal_of(sqrt(s))
                                 : RealInterval(-infinity, infinity));
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
          {"asinh",
           [](E x) {
             return increasing(
               x,
               std::asinh,
               reciprocal_of(sqrt(square(x.value) + RealInterval(1.))));
           }},
          {"atan",
           [](E x) {
             return increasing(
               x, std::atan, reciprocal_of(RealInterval(1.) + square(x.value)));
           }},
          {"atanh",
           [](E x) {
             return increasing(
               x,
               std::atanh,
               reciprocal_of(RealInterval(1.) - square(x.value)));
           }},
          {"ceil", [](E x) { return steps(x, std::ceil); }},
          {"cos", cosine_of},
          {"cosh",
           [](E x) {
             return scaled(sum(exponential(x), exponential(negative(x))), 0.5);
           }},
          {"cot",
           [](E x) { return product(cosine_of(x), reciprocal(sine_of(x))); }},
          {"csc", [](E x) { return reciprocal(sine_of(x)); }},
          {"erfc",
           [](E x) {
             const Enclosed bell = exponential(negative(product(x, x)));
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
          {"sec", [](E x) { return reciprocal(cosine_of(x)); }},
          {"sign", [](E x) { return steps(x, sign); }},
          {"sin", sine_of},
          {"sinh",
           [](E x) {
             const RealInterval slope =
               (between(std::exp(lower(x.value)), std::exp(upper(x.value))) +
                between(std::exp(-lower(x.value)), std::exp(-upper(x.value)))) *
               0.5;
             return increasing(x, std::sinh, slope);
           }},
          {"sqrt", root},
          {"tan",
           [](E x) { return product(sine_of(x), reciprocal(cosine_of(x))); }},
          {"tanh", [](E x) {
             const RealInterval t =
               between(std::tanh(lower(x.value)), std::tanh(upper(x.value)));
             return increasing(x, std::tanh, RealInterval(1.) - square(t));
           }}};
        return all;
      }

      Enclosed
      function_of_several(const std::string           &name,
                          const std::vector<Enclosed> &x)
      {
        if (name == "atan2")
          return angle(x[0], x[1]);
        if (name == "if")
          return choice(rounded_truth(x[0].value), x[1], x[2]);
        if (name == "pow")
          return power(x[0], x[1]);
        Enclosed e = x[0];
        for (unsigned int i = 1; i < x.size(); ++i)
          e = name == "max"   ? larger(e, x[i])
              : name == "min" ? smaller(e, x[i])
                              : sum(e, x[i]);
        return name == "avg" ? scaled(e, 1. / double(x.size())) : e;
      }

      Enclosed
      result_of_operator(const std::string &name,
                         const Enclosed    &a,
                         const Enclosed    &b)
      {
        if (name == "+" || name == "-")
          return sum(a, b, name == "+" ? 1. : -1.);
        if (name == "*")
          return product(a, b);
        if (name == "/")
          return product(a, reciprocal(b));
        if (name == "^")
          return power(a, b);
        const RealInterval difference = a.value - b.value;
        if (name == "<" || name == "<=")
          return jump(is_positive(-difference, name == "<="));
        if (name == ">" || name == ">=")
          return jump(is_positive(difference, name == ">="));
        if (name == "!=")
          return jump(truth(difference));
        if (name == "==")
          return jump(RealInterval(1.) - truth(difference));
        const RealInterval s = rounded_truth(a.value),
                           t = rounded_truth(b.value);
        return jump(name == "&" ? min(s, t) : max(s, t));
      }

      /** Recursive descent through a formula that check_formula() has accepted. */
      class Reader
      {
      public:
        explicit Reader(const std::string &text)
          : text(text)
        {}

        /** A formula, up to its end, a ',' , ':' or ')'. */
        Function
        formula()
        {
          const Function a = binary(0);
          if (!take("?"))
            return a;
          const Function b = formula();
          take(":");
          const Function c = formula();
          return [a, b, c](const Box &box) {
            return choice(a(box).value, b(box), c(box));
          };
        }

      private:
        /** Operators by increasing precedence. */
        static const std::vector<std::vector<std::string>> &
        levels()
        {
          static const std::vector<std::vector<std::string>> all = {
            {"|"},
            {"&"},
            {"<=", ">=", "==", "!=", "<", ">"},
            {"+", "-"},
            {"*", "/"}};
          return all;
        }

        bool
        take(const std::string &word)
        {
          while (place < text.size() &&
                 (text[place] == ' ' || text[place] == '\t'))
            ++place;
          if (text.compare(place, word.size(), word) != 0)
            return false;
          place += word.size();
          return true;
        }

        Function
        binary(const std::size_t level)
        {
          if (level == levels().size())
            return signed_power();
          Function a     = binary(level + 1);
          bool     again = true;
          while (again)
            {
              again = false;
              for (const std::string &name : levels()[level])
                if (take(name))
                  {
                    const Function b = binary(level + 1);
                    a                = [name, a, b](const Box &box) {
                      return result_of_operator(name, a(box), b(box));
                    };
                    again = true;
                    break;
                  }
            }
          return a;
        }

        /** A sign precedes powers: -x^2 is -(x^2). */
        Function
        signed_power()
        {
          if (take("-"))
            {
              const Function a = signed_power();
              return [a](const Box &box) { return negative(a(box)); };
            }
          take("+");
          const Function a = operand();
          if (!take("^"))
            return a;
          const Function b = signed_power(); // from the right
          return [a, b](const Box &box) { return power(a(box), b(box)); };
        }

        Function
        operand()
        {
          if (take("("))
            {
              const Function a = formula();
              take(")");
              return a;
            }
          const char c = text[place];
          if (std::isdigit(static_cast<unsigned char>(c)) || c == '.')
            {
              char        *end   = nullptr;
              const double value = std::strtod(&text[place], &end);
              place              = end - text.data();
              return
                [value](const Box &) { return constant(RealInterval(value)); };
            }
          const std::size_t first = place;
          while (place < text.size() &&
                 (std::isalnum(static_cast<unsigned char>(text[place])) ||
                  text[place] == '_'))
            ++place;
          return named(text.substr(first, place - first));
        }

        Function
        named(const std::string &name)
        {
          if (name == "pi" || name == "_pi")
            return [](const Box &) { return constant(RealInterval(pi)); };
          if (name == "_e")
            return
              [](const Box &) { return constant(RealInterval(std::exp(1.))); };
          for (int d = 0; d < dim; ++d)
            if (name == std::string(1, coordinate[d]))
              return [d](const Box &box) {
                Enclosed e    = constant(box[d]);
                e.gradient[d] = RealInterval(1.);
                return e;
              };
          Arguments arguments;
          take("(");
          do
            arguments.push_back(formula());
          while (take(","));
          take(")");
          const auto one = functions_of_one().find(name);
          if (one != functions_of_one().end())
            return [f = one->second, a = arguments[0]](const Box &box) {
              return f(a(box));
            };
          return [name, arguments](const Box &box) {
            std::vector<Enclosed> values;
            for (const Function &argument : arguments)
              values.push_back(argument(box));
            return function_of_several(name, values);
          };
        }

        const std::string &text;
        std::size_t        place = 0;
      };

      using Vertices = std::array<Point<dim>, dim + 1>;

      Box
      box_of(const Point<dim> &x)
      {
        Box box;
        for (int d = 0; d < dim; ++d)
          box[d] = RealInterval(x[d]);
        return box;
      }

      Box
      box_around(const Vertices &vertices)
      {
        Box box = box_of(vertices[0]);
        for (const Point<dim> &x : vertices)
          for (int d = 0; d < dim; ++d)
            box[d] = hull(box[d], RealInterval(x[d]));
        return box;
      }

      Point<dim>
      middle(const Point<dim> &a, const Point<dim> &b)
      {
        return Point<dim>((a + b) / 2.);
      }

      /** Parts of a simplex: bisected at its longest edge @p n times. */
      std::vector<Vertices>
      parts_of(const Vertices &vertices, const unsigned int n)
      {
        std::vector<Vertices> parts = {vertices};
        for (unsigned int i = 0; i < n; ++i)
          {
            std::vector<Vertices> halves;
            for (const Vertices &part : parts)
              {
                unsigned int a = 0, b = 1;
                for (unsigned int j = 0; j <= dim; ++j)
                  for (unsigned int k = j + 1; k <= dim; ++k)
                    if (part[j].distance(part[k]) > part[a].distance(part[b]))
                      {
                        a = j;
                        b = k;
                      }
                for (const unsigned int replaced : {a, b})
                  {
                    halves.push_back(part);
                    halves.back()[replaced] = middle(part[a], part[b]);
                  }
              }
            parts = std::move(halves);
          }
        return parts;
      }

      /** Gradient of the linear function with given values at the vertices. */
      dealii::Tensor<1, dim>
      gradient_of(const Vertices                    &vertices,
                  const std::array<double, dim + 1> &values)
      {
        dealii::Tensor<2, dim> edges;
        dealii::Tensor<1, dim> differences;
        for (int i = 0; i < dim; ++i)
          {
            edges[i]       = vertices[i + 1] - vertices[0];
            differences[i] = values[i + 1] - values[0];
          }
        return invert(edges) * differences;
      }
    } // namespace enclosing
  }   // namespace

  class EnclosedFormula::Evaluation
  {
  public:
    enclosing::Function function;
  };

  EnclosedFormula::EnclosedFormula(const std::string &text)
    : evaluation(std::make_shared<Evaluation>(
        Evaluation{enclosing::Reader(text).formula()}))
  {}

  Enclosure
  EnclosedFormula::in(const std::array<Range, dim> &ranges) const
  {
    enclosing::Box box;
    for (int d = 0; d < dim; ++d)
      box[d] = enclosing::RealInterval(ranges[d].least, ranges[d].most);
    const auto found = evaluation->function(box);
    Enclosure  result;
    result.value = {lower(found.value), upper(found.value)};
    for (int d = 0; d < dim; ++d)
      result.gradient[d] = {lower(found.gradient[d]), upper(found.gradient[d])};
    result.is_lipschitz = found.is_lipschitz;
    return result;
  }

  EnclosedFormula::OnSimplex
  EnclosedFormula::on_simplex(
    const std::array<Point<dim>, dim + 1> &vertices) const
  {
    using namespace enclosing;
    const Function             &function     = evaluation->function;
    constexpr unsigned int      n_bisections = 3;
    constexpr double            rounding     = 1e-13;
    std::array<double, dim + 1> values;
    for (int i = 0; i <= dim; ++i)
      values[i] = median(function(box_of(vertices[i])).value);
    const auto   slope = gradient_of(vertices, values);
    RealInterval all, error; // of the values; of the linear interpolation
    bool         is_first = true, is_lipschitz = true;
    for (const Vertices &part : parts_of(vertices, n_bisections))
      {
        const Box      box  = box_around(part);
        const Enclosed here = function(box);
        Box            centre;
        RealInterval   linear_at_centre(values[0]), linear(values[0]);
        for (int d = 0; d < dim; ++d)
          {
            centre[d] = RealInterval(median(box[d]));
            linear_at_centre += slope[d] * (centre[d] - vertices[0][d]);
            linear += slope[d] * (box[d] - vertices[0][d]);
          }
        RealInterval own = here.value - linear, range = here.value;
        if (here.is_lipschitz)
          {
            const Enclosed at_centre    = function(centre);
            RealInterval   mean         = at_centre.value - linear_at_centre,
                         values_by_mean = at_centre.value;
            for (int d = 0; d < dim; ++d)
              {
                mean += (here.gradient[d] - slope[d]) * (box[d] - centre[d]);
                values_by_mean += here.gradient[d] * (box[d] - centre[d]);
              }
            own   = intersect(own, mean);
            range = intersect(range, values_by_mean);
          }
        is_lipschitz = is_lipschitz && here.is_lipschitz;
        error        = is_first ? own : hull(error, own);
        all          = is_first ? range : hull(all, range);
        is_first     = false;
      }
    const double widen =
      rounding * std::max(std::abs(lower(all)), std::abs(upper(all)));
    OnSimplex bounds;
    for (int i = 0; i <= dim; ++i)
      {
        bounds.below[i] = values[i] + lower(error) - widen;
        bounds.above[i] = values[i] + upper(error) + widen;
      }
    double mean_below = 0., mean_above = 0.;
    for (int i = 0; i <= dim; ++i)
      {
        mean_below += bounds.below[i] / (dim + 1);
        mean_above += bounds.above[i] / (dim + 1);
      }
    const double least = lower(all) - widen, most = upper(all) + widen;
    // A formula that is nowhere negative has no negative bounds.
    if (!(mean_below > least) ||
        (least >= 0. &&
         *std::min_element(bounds.below.begin(), bounds.below.end()) < 0.))
      bounds.below.fill(least);
    if (!(mean_above < most))
      bounds.above.fill(most);
    return bounds;
  }
} // namespace geocone::GEOCONE_DIM
