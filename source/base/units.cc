// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/number_in.h>
#include <geocone/base/units.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/patterns.h>

#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace geocone
{
  using dealii::ParameterAcceptor;
  using dealii::ParameterHandler;

  namespace
  {
    bool in_kilonewtons = false;

    /** Replaces units of SI at the second group of an expression. */
    std::string
    replaced(const std::string &text, const std::regex &unit)
    {
      std::string out;
      auto        end = text.cbegin();
      for (std::sregex_iterator match(text.begin(), text.end(), unit), none;
           match != none;
           ++match)
        {
          const auto &of_si = (*match)[2];
          out.append(end, of_si.first);
          out += of_si == "kg" ? "t" : "k" + of_si.str();
          end = of_si.second;
        }
      return out.append(end, text.cend());
    }

    /** A value in present units; the same text if it is no number or list of numbers,
     *  or the unit has no mass. */
    std::string
    default_in_units(const std::string &value, const std::string &unit)
    {
      if (present_unit(unit) == unit)
        return value;
      std::istringstream in(value);
      std::string        out;
      for (std::string word; std::getline(in, word, ',');)
        {
          const auto number = number_in(word);
          if (!number)
            return value;
          out +=
            (out.empty() ? "" : ", ") + format("%.15g", *number / mass_unit());
        }
      return out;
    }

    /** Converts the defaults of a section. @param path with its slash */
    void
    convert_defaults(const nlohmann::json                           &section,
                     const std::string                              &path,
                     const std::function<bool(const std::string &)> &is_set)
    {
      auto &parameters = ParameterAcceptor::prm;
      for (const auto &[name, entry] : section.items())
        if (entry.find("pattern_description") == entry.end())
          {
            parameters.enter_subsection(name);
            convert_defaults(entry, path + name + "/", is_set);
            parameters.leave_subsection();
          }
        else if (!is_set(path + name))
          {
            const std::string value = entry.at("value").get<std::string>();
            const std::string text  = default_in_units(
              value, unit_in(entry.at("documentation").get<std::string>()));
            if (text != value)
              parameters.set(name, text);
          }
    }
  } // namespace

  void
  choose_units(const std::string &word)
  {
    in_kilonewtons = word == "kN-m";
  }

  double
  mass_unit()
  {
    return in_kilonewtons ? 1000. : 1.;
  }

  std::string
  in_units(const std::string &text)
  {
    static const std::regex unit(
      "([(\\[]|[0-9.)] |are in )(Pa|N|J|kg)(?![A-Za-z0-9])");
    return in_kilonewtons ? replaced(text, unit) : text;
  }

  std::string
  present_unit(const std::string &unit)
  {
    static const std::regex whole("^()(Pa|N|J|kg)(?![A-Za-z0-9])");
    return in_kilonewtons ? replaced(unit, whole) : unit;
  }

  std::string
  key_in_units(const std::string &key)
  {
    // The last unit only: names of structures are parts of keys.
    static const std::regex last(
      "(_)(Pa|N|J|kg)(?=(_m)?(_s)?(_per_[a-z0-9]+)?(_least|_most)?$)");
    return in_kilonewtons ? replaced(key, last) : key;
  }

  std::string
  unit_in(const std::string &documentation)
  {
    static const std::regex in_brackets("\\[([^\\]]+)\\]");
    std::smatch             unit;
    return std::regex_search(documentation, unit, in_brackets) ? unit.str(1)
                                                               : "";
  }

  void
  convert_defaults(const std::function<bool(const std::string &)> &is_set)
  {
    std::ostringstream declared;
    ParameterAcceptor::prm.print_parameters(declared, ParameterHandler::JSON);
    convert_defaults(nlohmann::json::parse(declared.str()), "", is_set);
  }

  void
  declare_units()
  {
    auto &parameters = ParameterAcceptor::prm;
    parameters.enter_subsection("Analysis");
    parameters.declare_entry(
      "Units",
      "SI",
      dealii::Patterns::Selection("SI|kN-m"),
      "SI | kN-m. Units of all numbers of this file and of the results. SI: "
      "kg, N, Pa. kN-m: t, kN, kPa, e.g. densities in t/m^3, unit weights in "
      "kN/m^3, loads in kN/m; defaults are converted. Both: m, s, degrees.");
    parameters.leave_subsection();
  }
} // namespace geocone
