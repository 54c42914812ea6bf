// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/declared_parameters.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/number_in.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

namespace geocone
{
  using dealii::ParameterAcceptor;
  using dealii::ParameterHandler;

  namespace
  {
    using dealii::Utilities::trim;

    constexpr double largest_value = 1e100;

    /** Parses the output of ParameterHandler, with names as declared; only
     *  names with a dot are split there. */
    Declared
    from_json(const nlohmann::json &json)
    {
      Declared declared;
      for (const auto &[key, value] : json.items())
        if (const auto pattern = value.find("pattern_description");
            pattern != value.end() && pattern->is_string())
          declared.entries[key] = {value.at("value").get<std::string>(),
                                   value.at("default_value").get<std::string>(),
                                   pattern->get<std::string>()};
        else
          declared.sections[key] = from_json(value);
      return declared;
    }

    /** The bounds of a pattern in words. */
    std::string
    bounds(const std::string &pattern)
    {
      const auto [from, to] = bounds_of(pattern);
      return from && to ? " from " + *from + " to " + *to
             : from     ? " >= " + *from
             : to       ? " <= " + *to
                        : "";
    }

    /** Whether a text may contain decimal commas: a comma between two digits,
     *  in a list next to a comma that a blank follows. */
    bool
    has_decimal_comma(const std::string &value, const bool is_list)
    {
      static const std::regex tight("[0-9],[0-9]"), loose(",[ \t]");
      return std::regex_search(value, tight) &&
             (!is_list || std::regex_search(value, loose));
    }

    /** Whether the numbers in a text, separated by commas, semicolons or
     *  blanks, are finite and not absurd. */
    bool
    is_sensible(const std::string &value)
    {
      std::string text = value;
      for (char &c : text)
        if (c == ',' || c == ';' || c == ':')
          c = ' ';
      std::istringstream in(text);
      for (std::string word; in >> word;)
        {
          const auto number = number_in(word);
          if (number && !(std::abs(*number) <= largest_value))
            return false;
        }
      return true;
    }
  } // namespace

  Declared
  all_declared()
  {
    std::ostringstream out;
    ParameterAcceptor::prm.print_parameters(out, ParameterHandler::JSON);
    return from_json(nlohmann::json::parse(out.str()));
  }

  std::string
  as_text(const std::string &name,
          const Declared    &section,
          const std::string &indent)
  {
    std::string text = indent + "subsection " + name + "\n";
    for (const auto &[entry, declared] : section.entries)
      text += indent + "  set " + entry + " = " + declared.value + "\n";
    for (const auto &[below, declared] : section.sections)
      text += as_text(below, declared, indent + "  ");
    return text + indent + "end\n";
  }

  std::pair<std::optional<std::string>, std::optional<std::string>>
  bounds_of(const std::string &pattern)
  {
    std::smatch match;
    if (!std::regex_search(
          pattern, match, std::regex("([-+.eE\\w]+)\\.\\.\\.([-+.\\w]+) ")))
      return {};
    const auto bound = [](const std::string &text) {
      const bool is_none =
        text.find("MAX_DOUBLE") != std::string::npos ||
        text == std::to_string(std::numeric_limits<int>::min()) ||
        text == std::to_string(std::numeric_limits<int>::max()) ||
        text == std::to_string(std::numeric_limits<unsigned>::max());
      return is_none ? std::nullopt : std::optional<std::string>(text);
    };
    return {bound(match[1]), bound(match[2])};
  }

  std::string
  allowed_by(const std::string &pattern)
  {
    const auto begins = [&](const std::string &text) {
      return pattern.compare(0, text.size(), text) == 0;
    };
    if (begins("[Selection "))
      {
        std::string choices = trim(pattern.substr(11, pattern.size() - 12));
        for (std::size_t i = choices.find('|'); i != std::string::npos;
             i             = choices.find('|', i + 3))
          choices.replace(i, 1, " | ");
        return choices;
      }
    if (begins("[Bool"))
      return "true | false";
    if (begins("[Integer"))
      return "a whole number" + bounds(pattern);
    if (begins("[Double"))
      return "a number" + bounds(pattern);
    if (begins("[List"))
      {
        const bool doubles = pattern.find("[Double") != std::string::npos;
        const bool spatial = pattern.find("length 3...3 ") != std::string::npos;
        if (pattern.find("[List", 5) != std::string::npos)
          return spatial ? "points x, y, z; x, y, z; ... of numbers"
                         : "points x, y; x, y; ... of numbers";
        if (spatial)
          return "three numbers x, y, z";
        if (pattern.find("length 2...2 ") != std::string::npos)
          return "two numbers x, y";
        const bool integers = pattern.find("[Integer") != std::string::npos;
        return std::string(doubles    ? "numbers"
                           : integers ? "whole numbers"
                                      : "names") +
               ", separated by commas";
      }
    return "text";
  }

  std::string
  joined(const std::vector<std::string> &sections, const std::string &name)
  {
    std::string path;
    for (const std::string &section : sections)
      path += section + "/";
    return path + name;
  }

  void
  set_value(const std::vector<std::string> &sections,
            const std::string              &name,
            const std::string              &value,
            const Declared::Entry          &entry,
            const std::string              &place)
  {
    const std::string path   = joined(sections, name);
    const auto        refuse = [&](const std::string &allowed) {
      throw InputError(
        path,
        value,
        allowed,
        (entry.default_value.empty()
                  ? "leave it out for the default"
                  : "e.g. " + printable(entry.default_value) + ", the default") +
          " (" + place + ")");
    };
    const bool is_of_doubles =
      entry.pattern.find("[Double") != std::string::npos;
    if (is_of_doubles && !is_sensible(value))
      refuse("finite numbers of magnitude <= 1e100");
    if (is_of_doubles &&
        has_decimal_comma(value, entry.pattern.compare(0, 5, "[List") == 0))
      throw InputError(path,
                       value,
                       "numbers with decimal points, e.g. 0.5; in a list a "
                       "blank follows each comma, or none does",
                       "write 0.5, not 0,5 (" + place + ")");
    // The library treats unsigned numbers as signed ones.
    if (entry.pattern == "[Integer]" &&
        (value.empty() ||
         value.find_first_not_of("0123456789") != std::string::npos ||
         value.size() > 10 ||
         std::stoull(value) > std::numeric_limits<unsigned>::max()))
      refuse("a whole number from 0 to " +
             std::to_string(std::numeric_limits<unsigned>::max()));
    // Not as a line of text: the library neither matches nor sets values with a
    // brace there.
    auto &prm = ParameterAcceptor::prm;
    for (const std::string &section : sections)
      prm.enter_subsection(section);
    const bool fits = [&]() {
      try
        {
          prm.set(name, value);
          return true;
        }
      catch (const dealii::ExceptionBase &)
        {
          return false;
        }
    }();
    for (std::size_t i = 0; i < sections.size(); ++i)
      prm.leave_subsection();
    if (!fits)
      refuse(allowed_by(entry.pattern));
  }
} // namespace geocone
