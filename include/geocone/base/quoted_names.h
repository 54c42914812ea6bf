// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_quoted_names_h
#define geocone_base_quoted_names_h

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>

#include <string>
#include <vector>

namespace geocone
{
  /** Ensures that each comma in a name is followed by exactly one blank.
   *  Names read from a list have this form. */
  inline std::string
  name_in_list(const std::string &name)
  {
    std::string all;
    for (const std::string &part : split_names(name, ','))
      all += (all.empty() ? "" : ", ") + part;
    return all;
  }

  /** Encloses a name in double quotes if it contains a comma, for use in a
   *  comma-separated list. */
  inline std::string
  quoted_if_needed(const std::string &name)
  {
    return name.find(',') == std::string::npos ? name : '"' + name + '"';
  }

  /**
   * Extracts the names from a comma-separated list. Names may be enclosed in
   * double quotes.
   * @param parts parts of the list between commas
   * @param parameter path of the list, for error messages
   * @throws InputError if a quote is not closed
   */
  inline std::vector<std::string>
  unquoted(const std::vector<std::string> &parts, const std::string &parameter)
  {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < parts.size(); ++i)
      {
        std::string name = parts[i];
        if (name.size() > 1 && name.front() == '"' && name.back() != '"')
          while (++i < parts.size())
            {
              name += ", " + parts[i];
              if (name.back() == '"')
                break;
            }
        const bool is_quoted = !name.empty() && name.front() == '"';
        if (is_quoted && (name.size() < 3 || name.back() != '"'))
          throw InputError(
            parameter,
            name,
            "names, separated by commas; those that have a comma "
            "in double quotes",
            "close the quote");
        names.push_back(is_quoted ? name.substr(1, name.size() - 2) : name);
      }
    return names;
  }
} // namespace geocone

#endif
