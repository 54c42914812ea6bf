// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_unused_parameters_h
#define geocone_base_unused_parameters_h

#include <geocone/base/parameter_file.h>

#include <string>
#include <vector>

namespace geocone
{
  /**
   * A rule that a parameter is used only if another one has certain values. It
   * is declared next to the parameter, as a constant outside of functions. A
   * '*' stands for any name, the same in all paths of a rule.
   */
  struct UsedWhere
  {
    /** @param values of @p chooser for which it is used; empty: any but none
     *  @param other a parameter that also activates it, if set */
    UsedWhere(const char                     *parameter,
              const char                     *chooser,
              const std::vector<std::string> &values,
              const char                     *other = "");

    std::string              parameter, chooser;
    std::vector<std::string> values;
    std::string              other;
  };

  /**
   * A warning line with the parameters that are set to other than their default
   * values but not used by the method, the mesh, the law etc. selected by other
   * parameters. Empty if there are none. To be called after
   * ParameterFile::parse().
   */
  std::string
  unused_parameters(const std::vector<ParameterFile::Setting> &settings);

  /** The rules of a parameter in words, e.g. "Mesh/Type = graded or
   *  unstructured": those of its section and its own. */
  struct Conditions
  {
    std::vector<std::string> of_section, own;
  };
  Conditions
  conditions_of_use(const std::string &path);
} // namespace geocone

#endif
