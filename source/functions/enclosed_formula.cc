// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/functions/enclosed_formula.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    using Evaluation = std::function<Enclosure(const IntervalBox &)>;

    /** Recursive descent through a formula that check_formula() has accepted. */
    class EnclosureReader
    {
    public:
      explicit EnclosureReader(const std::string &text)
        : text(text)
      {}

      /** A formula, up to its end, a ',' , ':' or ')'. */
      Evaluation
      formula()
      {
        const Evaluation a = binary(0);
        if (!take("?"))
          return a;
        const Evaluation b = formula();
        take(":");
        const Evaluation c = formula();
        return [a, b, c](const IntervalBox &box) {
          return enclosures::choice(a(box).value, b(box), c(box));
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

      Evaluation
      binary(const std::size_t level)
      {
        if (level == levels().size())
          return signed_power();
        Evaluation a     = binary(level + 1);
        bool       again = true;
        while (again)
          {
            again = false;
            for (const std::string &name : levels()[level])
              if (take(name))
                {
                  const Evaluation b = binary(level + 1);
                  a = [f = enclosures::operator_of(name), a, b](
                        const IntervalBox &box) { return f(a(box), b(box)); };
                  again = true;
                  break;
                }
          }
        return a;
      }

      /** A sign precedes powers: -x^2 is -(x^2). */
      Evaluation
      signed_power()
      {
        if (take("-"))
          {
            const Evaluation a = signed_power();
            return [a](const IntervalBox &box) {
              return enclosures::negative(a(box));
            };
          }
        take("+");
        const Evaluation a = operand();
        if (!take("^"))
          return a;
        const Evaluation b = signed_power(); // from the right
        return [f = enclosures::operator_of("^"), a, b](
                 const IntervalBox &box) { return f(a(box), b(box)); };
      }

      Evaluation
      operand()
      {
        if (take("("))
          {
            const Evaluation a = formula();
            take(")");
            return a;
          }
        const char c = text[place];
        if (std::isdigit(static_cast<unsigned char>(c)) || c == '.')
          {
            char        *end   = nullptr;
            const double value = std::strtod(&text[place], &end);
            place              = end - text.data();
            return [value](const IntervalBox &) {
              return enclosures::constant(RealInterval(value));
            };
          }
        const std::size_t first = place;
        while (place < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[place])) ||
                text[place] == '_'))
          ++place;
        return named(text.substr(first, place - first));
      }

      Evaluation
      named(const std::string &name)
      {
        if (name == "pi" || name == "_pi")
          return [](const IntervalBox &) {
            return enclosures::constant(RealInterval(pi));
          };
        if (name == "_e")
          return [](const IntervalBox &) {
            return enclosures::constant(RealInterval(std::exp(1.)));
          };
        for (int d = 0; d < dim; ++d)
          if (name == std::string(1, coordinate[d]))
            return [d](const IntervalBox &box) {
              Enclosure e   = enclosures::constant(box[d]);
              e.gradient[d] = RealInterval(1.);
              return e;
            };
        std::vector<Evaluation> arguments;
        take("(");
        do
          arguments.push_back(formula());
        while (take(","));
        take(")");
        return [f = enclosures::function_of(name),
                arguments](const IntervalBox &box) {
          std::vector<Enclosure> values;
          for (const Evaluation &argument : arguments)
            values.push_back(argument(box));
          return f(values);
        };
      }

      const std::string &text;
      std::size_t        place = 0;
    };

    using SimplexVertices = std::array<Point<dim>, dim + 1>;

    IntervalBox
    box_of(const Point<dim> &x)
    {
      IntervalBox box;
      for (int d = 0; d < dim; ++d)
        box[d] = RealInterval(x[d]);
      return box;
    }

    IntervalBox
    box_around(const SimplexVertices &vertices)
    {
      IntervalBox box = box_of(vertices[0]);
      for (const Point<dim> &x : vertices)
        for (int d = 0; d < dim; ++d)
          box[d] = hull(box[d], RealInterval(x[d]));
      return box;
    }

    /** Parts of a simplex: bisected at its longest edge @p n times. */
    std::vector<SimplexVertices>
    parts_of(const SimplexVertices &vertices, const unsigned int n)
    {
      std::vector<SimplexVertices> parts = {vertices};
      for (unsigned int i = 0; i < n; ++i)
        {
          std::vector<SimplexVertices> halves;
          for (const SimplexVertices &part : parts)
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
                  halves.back()[replaced] =
                    Point<dim>((part[a] + part[b]) / 2.);
                }
            }
          parts = std::move(halves);
        }
      return parts;
    }

    /** Gradient of the linear function with given values at the vertices. */
    dealii::Tensor<1, dim>
    gradient_of(const SimplexVertices             &vertices,
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

    /** Intersection of two bounds of the same values, which rounding may part. */
    RealInterval
    common_part(const RealInterval &a, const RealInterval &b)
    {
      return overlap(a, b) ? intersect(a, b) : hull(a, b);
    }
  } // namespace

  EnclosedFormula::EnclosedFormula(const std::string &text)
    : function(EnclosureReader(text).formula())
  {}

  EnclosedFormula::OnSimplex
  EnclosedFormula::on_simplex(
    const std::array<Point<dim>, dim + 1> &vertices) const
  {
    constexpr unsigned int      n_bisections = 3;
    constexpr double            rounding     = 1e-13;
    std::array<double, dim + 1> values;
    for (int i = 0; i <= dim; ++i)
      values[i] = median(function(box_of(vertices[i])).value);
    const auto   slope = gradient_of(vertices, values);
    RealInterval all, error; // of the values; of the linear interpolation
    bool         is_first = true;
    for (const SimplexVertices &part : parts_of(vertices, n_bisections))
      {
        const IntervalBox box  = box_around(part);
        const Enclosure   here = function(box);
        IntervalBox       centre;
        RealInterval      linear_at_centre(values[0]), linear(values[0]);
        for (int d = 0; d < dim; ++d)
          {
            centre[d] = RealInterval(median(box[d]));
            linear_at_centre += slope[d] * (centre[d] - vertices[0][d]);
            linear += slope[d] * (box[d] - vertices[0][d]);
          }
        RealInterval own = here.value - linear, range = here.value;
        if (here.is_lipschitz)
          {
            const Enclosure at_centre   = function(centre);
            RealInterval    mean        = at_centre.value - linear_at_centre,
                         values_by_mean = at_centre.value;
            for (int d = 0; d < dim; ++d)
              {
                mean += (here.gradient[d] - slope[d]) * (box[d] - centre[d]);
                values_by_mean += here.gradient[d] * (box[d] - centre[d]);
              }
            own   = common_part(own, mean);
            range = common_part(range, values_by_mean);
          }
        error    = is_first ? own : hull(error, own);
        all      = is_first ? range : hull(all, range);
        is_first = false;
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
