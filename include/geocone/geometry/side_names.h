// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_geometry_side_names_h
#define geocone_geometry_side_names_h

#include <cstddef>
#include <string>
#include <vector>

namespace geocone
{
  /** Beginning of the names of holes that were given none. */
  constexpr const char *prefix_of_holes = "hole";

  /**
   * Checks a name of sides given by the user.
   * @param parameter path of the parameter that has the name
   * @param own name of the same sides without it: their number, or "hole 0";
   * accepted
   * @throws InputError if the name is empty, the number of a side, "all" or
   * like that of a hole, or if it has a colon
   */
  void
  check_side_name(const std::string &name,
                  const std::string &parameter,
                  const std::string &own);

  /**
   * Returns the names of the sides of a polygon: those given or, without any,
   * the numbers 0, 1, ...
   * @param given names, comma-separated
   * @param n_sides number of sides
   * @param parameter path of the parameter that has the names
   * @throws InputError unless each side has one valid name of its own
   */
  std::vector<std::string>
  names_of_sides(const std::vector<std::string> &given,
                 const std::size_t               n_sides,
                 const std::string              &parameter);
} // namespace geocone

#endif
