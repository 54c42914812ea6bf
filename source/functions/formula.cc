// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/functions/formula.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

namespace geocone::GEOCONE_DIM
{
  std::string
  allowed_formula(const FormulaVariables variables)
  {
    const std::string of_place = std::string(coordinates) + " (m)";
    return "a formula in " +
           (variables == FormulaVariables::time    ? ""
            : variables == FormulaVariables::place ? of_place + " and "
                                                   : of_place + ", ") +
           (variables == FormulaVariables::place ? "" : "t (s) and ") +
           "pi, e.g. " +
           (variables == FormulaVariables::place ? "0.25 - x^2"
                                                 : "-0.02*min(1,t/0.1)");
  }

  namespace
  {
    /** The functions of formulas, with their number of arguments; 0: one or
     *  more. The library's random functions are excluded. */
    const std::map<std::string, unsigned int> formula_functions = {
      {"abs", 1},  {"acos", 1},  {"acosh", 1}, {"asin", 1}, {"asinh", 1},
      {"atan", 1}, {"atan2", 2}, {"atanh", 1}, {"avg", 0},  {"ceil", 1},
      {"cos", 1},  {"cosh", 1},  {"cot", 1},   {"csc", 1},  {"erfc", 1},
      {"exp", 1},  {"floor", 1}, {"if", 3},    {"int", 1},  {"ln", 1},
      {"log", 1},  {"log10", 1}, {"log2", 1},  {"max", 0},  {"min", 0},
      {"pow", 2},  {"rint", 1},  {"sec", 1},   {"sign", 1}, {"sin", 1},
      {"sinh", 1}, {"sqrt", 1},  {"sum", 0},   {"tan", 1},  {"tanh", 1}};

    constexpr const char *point_remedy =
      "write decimals with a point, e.g. -0.02: commas separate the arguments "
      "of a function";

    /** Left-to-right parser of a formula, for check_formula(). */
    class FormulaReader
    {
    public:
      FormulaReader(const std::string     &text,
                    const std::string     &parameter,
                    const FormulaVariables variables)
        : text(text)
        , parameter(parameter)
        , variables(variables)
      {}

      void
      read()
      {
        formula();
        if (next() == ',')
          refuse(point_remedy);
        if (next() == ')')
          refuse("a ')' has no '('");
        if (next() != 0)
          refuse_here();
      }

    private:
      static constexpr unsigned int deepest = 100;

      [[noreturn]] void
      refuse(const std::string &remedy) const
      {
        throw InputError(parameter, text, allowed_formula(variables), remedy);
      }

      [[noreturn]] void
      refuse_here() const
      {
        if (place >= text.size())
          refuse("something is missing at its end");
        refuse("it cannot be read from '" + printable(text.substr(place)) +
               "' on");
      }

      /** The next non-blank character; 0 at the end. */
      char
      next()
      {
        while (place < text.size() &&
               (text[place] == ' ' || text[place] == '\t'))
          ++place;
        return place < text.size() ? text[place] : 0;
      }

      /** Consumes a word if it comes next. */
      bool
      take(const std::string &word)
      {
        next();
        if (text.compare(place, word.size(), word) != 0)
          return false;
        place += word.size();
        return true;
      }

      void
      formula()
      {
        if (++depth > deepest)
          refuse("it is nested too deeply");
        operand();
        while (binary_operator())
          operand();
        if (take("?"))
          {
            formula();
            if (!take(":"))
              refuse("the '?' lacks its ':', or write if(..., ..., ...)");
            formula();
          }
        --depth;
      }

      bool
      binary_operator()
      {
        for (const char *two : {"&&", "||", "**"})
          if (take(two))
            refuse(std::string("write ") + (*two == '*'
                                              ? "powers as x^2"
                                              : "& and | for 'and' and 'or'"));
        for (const char *one : {"<=",
                                ">=",
                                "==",
                                "!=",
                                "<",
                                ">",
                                "+",
                                "-",
                                "/",
                                "*",
                                "^",
                                "&",
                                "|"})
          if (take(one))
            {
              divides = *one == '/';
              return true;
            }
        if (take("="))
          refuse("values are compared by '=='; a formula assigns nothing");
        return false;
      }

      void
      operand()
      {
        const bool is_divisor = divides;
        divides               = false;
        if (!take("-"))
          take("+");
        const char c = next();
        if (std::isdigit(static_cast<unsigned char>(c)) || c == '.')
          number(is_divisor);
        else if (std::isalpha(static_cast<unsigned char>(c)) || c == '_')
          name();
        else if (take("("))
          {
            formula();
            if (next() == ',')
              refuse(point_remedy);
            close();
          }
        else
          refuse_here();
      }

      void
      close()
      {
        if (!take(")"))
          {
            if (next() == 0)
              refuse("a ')' is missing");
            refuse_here();
          }
      }

      void
      number(const bool is_divisor)
      {
        const auto digits = [&]() {
          const std::size_t first = place;
          while (place < text.size() &&
                 std::isdigit(static_cast<unsigned char>(text[place])))
            ++place;
          return place - first;
        };
        const std::size_t first   = place;
        const std::size_t n_whole = digits();
        if (n_whole > 1 && text[first] == '0')
          refuse("a number begins with zeros; " + std::string(point_remedy));
        std::size_t n = n_whole;
        if (place < text.size() && text[place] == '.')
          {
            ++place;
            n += digits();
          }
        if (n == 0)
          refuse_here();
        if (place < text.size() && (text[place] == 'e' || text[place] == 'E'))
          {
            ++place;
            if (place < text.size() &&
                (text[place] == '+' || text[place] == '-'))
              ++place;
            if (digits() == 0)
              refuse_here();
          }
        const double value =
          std::strtod(text.substr(first, place - first).c_str(), nullptr);
        if (!std::isfinite(value))
          refuse("numbers are finite");
        if (is_divisor && value == 0.)
          refuse("it divides by zero; " + std::string(point_remedy));
      }

      void
      name()
      {
        const std::size_t first = place;
        while (place < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[place])) ||
                text[place] == '_'))
          ++place;
        const std::string name     = text.substr(first, place - first);
        const auto        function = formula_functions.find(name);
        const bool        is_place =
          name == "x" || name == "y" || (dim == 3 && name == "z");
        if (function != formula_functions.end())
          arguments(name, function->second);
        else if (name == "rand" || name == "rand_seed")
          refuse("random numbers differ from run to run: give a formula, or a "
                 "record");
        else if (name == "t" && variables == FormulaVariables::place)
          refuse("it does not depend on t");
        else if (is_place && variables == FormulaVariables::time)
          refuse("it does not depend on " + name);
        else if (!is_place && name != "t" && name != "pi" && name != "_pi" &&
                 name != "_e")
          {
            std::string all;
            for (const auto &[known, n] : formula_functions)
              all += (all.empty() ? "" : ", ") + known;
            refuse("'" + printable(name) + "' is unknown; functions are " +
                   all);
          }
      }

      void
      arguments(const std::string &name, const unsigned int n_asked)
      {
        if (!take("("))
          refuse("'" + name + "' is a function: " + name + "(...)");
        unsigned int n = 0;
        do
          {
            formula();
            ++n;
          }
        while (take(","));
        close();
        if (n_asked != 0 && n != n_asked)
          refuse(name + " takes " + std::to_string(n_asked) +
                 (n_asked == 1 ? " argument, not " : " arguments, not ") +
                 std::to_string(n) + "; " + point_remedy);
      }

      const std::string     &text, &parameter;
      const FormulaVariables variables;
      std::size_t            place   = 0;
      unsigned int           depth   = 0;
      bool                   divides = false; ///< the last operator consumed
    };
  } // namespace

  void
  check_formula(const std::string     &text,
                const std::string     &parameter,
                const FormulaVariables variables)
  {
    FormulaReader(text, parameter, variables).read();
  }
} // namespace geocone::GEOCONE_DIM
