// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/renamed_parameters.h>

#include <algorithm>

namespace geocone
{
  namespace
  {
    /** A function-local static, because names are declared before main(). */
    std::vector<RenamedParameter> &
    all_renamed()
    {
      static std::vector<RenamedParameter> all;
      return all;
    }

    bool
    is_in(const std::string &section, const std::vector<std::string> &sections)
    {
      const std::vector<std::string> parts = split_names(section, '/');
      return std::equal(parts.begin(),
                        parts.end(),
                        sections.begin(),
                        sections.end(),
                        [](const std::string &part, const std::string &name) {
                          return part == "*" || part == name;
                        });
    }
  } // namespace

  RenamedParameter::RenamedParameter(const char *section,
                                     const char *before,
                                     const char *now)
    : section(section)
    , before(before)
    , now(now)
  {
    all_renamed().push_back(*this);
  }

  std::string
  present_name(const std::vector<std::string> &sections,
               const std::string              &name)
  {
    for (const RenamedParameter &one : all_renamed())
      if (one.before == name && is_in(one.section, sections))
        return one.now;
    return name;
  }

  std::string
  former_names(const std::vector<ParameterFile::Setting> &settings)
  {
    std::string text;
    for (const ParameterFile::Setting &setting : settings)
      if (!setting.former_name.empty())
        text += (text.empty() ? "" : ", ") + ("'" + setting.former_name) +
                "' (now '" + setting.path + "')";
    return text.empty() ? ""
                        : "former names of parameters, which a later version "
                          "will refuse: " +
                            text;
  }
} // namespace geocone
