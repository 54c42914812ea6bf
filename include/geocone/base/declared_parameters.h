// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_declared_parameters_h
#define geocone_base_declared_parameters_h

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /** Section of the parameter tree of dealii::ParameterAcceptor, with its
   *  entries and subsections. */
  struct Declared
  {
    struct Entry
    {
      std::string value, default_value, pattern;
    };
    std::map<std::string, Entry>    entries;
    std::map<std::string, Declared> sections;

    const Declared *
    find(const std::vector<std::string> &path) const
    {
      const Declared *here = this;
      for (const std::string &name : path)
        {
          const auto below = here->sections.find(name);
          if (below == here->sections.end())
            return nullptr;
          here = &below->second;
        }
      return here;
    }
  };

  /** Returns the tree of all declared parameters with their current values. */
  Declared
  all_declared();

  /** Formats a section and all its values in the syntax of a parameter file. */
  std::string
  as_text(const std::string &name,
          const Declared    &section,
          const std::string &indent = "");

  /** Returns the keys of a map as a list. */
  template <typename T>
  std::vector<std::string>
  keys(const std::map<std::string, T> &map)
  {
    std::vector<std::string> all;
    for (const auto &[key, value] : map)
      all.push_back(key);
    return all;
  }

  /** Parses the lower and upper bounds in a deal.II pattern such as "[Double
   *  0...1 (inclusive)]". */
  std::pair<std::optional<std::string>, std::optional<std::string>>
  bounds_of(const std::string &pattern);

  /** Describes in words the values that a deal.II pattern admits. */
  std::string
  allowed_by(const std::string &pattern);

  /** Full path of a parameter: SECTION/SUBSECTION/NAME. */
  std::string
  joined(const std::vector<std::string> &sections, const std::string &name);

  /**
   * Sets the value of a declared parameter.
   * @param place file and line that set the value, for error messages
   * @throws InputError if the value is not admissible, with the admissible
   * values
   */
  void
  set_value(const std::vector<std::string> &sections,
            const std::string              &name,
            const std::string              &value,
            const Declared::Entry          &entry,
            const std::string              &place);
} // namespace geocone

#endif
