// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_reference.h>
#include <geocone/base/unused_parameters.h>

#include <algorithm>
#include <map>

namespace geocone
{
  namespace
  {
    /** Declared rules of complete sections and of single parameters. A
     *  function-local static, because rules are declared before main(). */
    struct Rules
    {
      std::vector<UsedWhere> of_sections, of_parameters;
    };
    Rules &
    declared_rules()
    {
      static Rules rules;
      return rules;
    }

    std::vector<std::string>
    parts(const std::string &path)
    {
      return split_names(path, '/');
    }

    /** Whether a path matches that of a rule; @p star is the text that a '*'
     *  stands for. */
    bool
    matches(const std::string &rule, const std::string &path, std::string &star)
    {
      const auto a = parts(rule), b = parts(path);
      if (a.size() != b.size())
        return false;
      for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] == "*")
          star = b[i];
        else if (a[i] != b[i])
          return false;
      return true;
    }

    /** A path of a rule with the name that a '*' stands for. */
    std::string
    with_star(std::string path, const std::string &star)
    {
      if (const auto place = path.find('*'); place != std::string::npos)
        path.replace(place, 1, star);
      return path;
    }

    /** The values of its chooser that a rule asks for. */
    std::string
    needed(const UsedWhere &rule, const std::string &chooser)
    {
      std::string values;
      for (const std::string &choice : rule.values)
        values += (values.empty() ? " = " : " or ") + choice;
      return chooser + values;
    }

    /** Whether a rule of a section is replaced, because a parameter has a rule
     *  of its own with the same chooser. */
    bool
    is_replaced(const UsedWhere &rule, const std::string &path)
    {
      const std::vector<UsedWhere> &own = declared_rules().of_parameters;
      return rule.parameter.back() == '*' &&
             std::any_of(own.begin(), own.end(), [&](const UsedWhere &other) {
               std::string star;
               return other.chooser == rule.chooser &&
                      matches(other.parameter, path, star);
             });
    }

    /** The first rule that a setting violates, as a text; or empty. */
    std::string
    broken_rule(const std::vector<UsedWhere>              &rules,
                const ParameterFile::Setting              &setting,
                const std::vector<ParameterFile::Setting> &settings,
                std::map<std::string, std::string>        &values)
    {
      for (const UsedWhere &rule : rules)
        {
          std::string star;
          if (!matches(rule.parameter, setting.path, star) ||
              is_replaced(rule, setting.path))
            continue;
          const std::string chooser = with_star(rule.chooser, star);
          const auto        known   = values.find(chooser);
          const std::string value =
            known != values.end()
              ? known->second
              : (values[chooser] = ParameterFile::value(chooser));
          if (rule.values.empty()
                ? !value.empty()
                : std::count(rule.values.begin(), rule.values.end(), value) > 0)
            continue;
          if (!rule.other.empty() &&
              std::any_of(settings.begin(),
                          settings.end(),
                          [&](const ParameterFile::Setting &other) {
                            return matches(rule.other, other.path, star) &&
                                   !other.value.empty();
                          }))
            continue;
          return needed(rule, chooser);
        }
      return "";
    }
  } // namespace

  UsedWhere::UsedWhere(const char                     *parameter,
                       const char                     *chooser,
                       const std::vector<std::string> &values,
                       const char                     *other)
    : parameter(parameter)
    , chooser(chooser)
    , values(values)
    , other(other)
  {
    Rules &all = declared_rules();
    auto  &rules =
      this->parameter.back() == '*' ? all.of_sections : all.of_parameters;
    // Sources that are compiled for each dimension declare their rules twice.
    if (std::none_of(rules.begin(), rules.end(), [&](const UsedWhere &rule) {
          return rule.parameter == this->parameter &&
                 rule.chooser == this->chooser;
        }))
      rules.push_back(*this);
  }

  std::string
  unused_parameters(const std::vector<ParameterFile::Setting> &settings)
  {
    std::map<std::string, std::string> values; // of the choosers
    std::string                        list;
    const auto add = [&](const std::string &path, const std::string &chooser) {
      list += (list.empty() ? "" : ", ") + printable(path) + " (needs " +
              printable(chooser) + ")";
    };
    for (const ParameterFile::Setting &setting : settings)
      {
        // Files that several scenes include set what some of them need.
        if (setting.is_included)
          continue;
        if (!setting.of_other.empty())
          {
            add(setting.path, setting.of_other);
            continue;
          }
        // In files with all parameters, as written by runs, default values are
        // not intentional.
        if (setting.value == setting.default_value)
          continue;
        std::string needed =
          broken_rule(declared_rules().of_sections, setting, settings, values);
        if (needed.empty())
          needed = broken_rule(
            declared_rules().of_parameters, setting, settings, values);
        if (!needed.empty())
          add(setting.path, needed);
      }
    return list.empty() ? "" : "set, but not used by this run: " + list;
  }

  Conditions
  conditions_of_use(const std::string &path)
  {
    const auto of = [&](const std::vector<UsedWhere> &rules) {
      std::vector<std::string> all;
      for (const UsedWhere &rule : rules)
        if (std::string star;
            matches(rule.parameter, path, star) && !is_replaced(rule, path))
          all.push_back(
            needed(rule, with_star(rule.chooser, star)) +
            (rule.other.empty()
               ? ""
               : " or " +
                   with_star(rule.other, star.empty() ? any_name : star)));
      return all;
    };
    return {of(declared_rules().of_sections),
            of(declared_rules().of_parameters)};
  }
} // namespace geocone
