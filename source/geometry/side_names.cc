// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/quoted_names.h>
#include <geocone/geometry/side_names.h>

#include <algorithm>

namespace geocone
{
  void
  check_side_name(const std::string &name,
                  const std::string &parameter,
                  const std::string &own)
  {
    if (name == own)
      return;
    require(!name.empty(),
            parameter,
            name,
            "a name for each side",
            "give names, or '" + own + "' for this one");
    require(!std::all_of(name.begin(),
                         name.end(),
                         [](const char c) { return c >= '0' && c <= '9'; }),
            parameter,
            name,
            "names with a letter, or '" + own + "' in this place",
            "whole numbers are those of other sides");
    require(name != "all" && name.rfind(prefix_of_holes, 0) != 0,
            parameter,
            name,
            std::string("names other than all and those that begin with ") +
              prefix_of_holes,
            "conditions call all sides, and holes without a name, so: choose "
            "another one");
    require(name.find(':') == std::string::npos,
            parameter,
            name,
            "names without a colon",
            "it separates the two names of tied sides");
  }

  std::vector<std::string>
  names_of_sides(const std::vector<std::string> &given,
                 const std::size_t               n_sides,
                 const std::string              &parameter)
  {
    std::vector<std::string> names = unquoted(given, parameter);
    if (names.empty())
      for (std::size_t i = 0; i < n_sides; ++i)
        names.push_back(std::to_string(i));
    require(names.size() == n_sides,
            parameter,
            format("%zu names", names.size()),
            format("%zu, one for each side of the polygon", n_sides),
            "name the sides in the order of the vertices: the first one "
            "connects the first two, the last one the last and the first");
    for (std::size_t i = 0; i < n_sides; ++i)
      {
        check_side_name(names[i], parameter, std::to_string(i));
        require(std::count(names.begin(), names.end(), names[i]) == 1,
                parameter,
                names[i],
                "names that differ",
                "give each side a name of its own; conditions list several: "
                "Sides = crest 1, crest 2");
      }
    return names;
  }
} // namespace geocone
