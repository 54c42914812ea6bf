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
   * Declares that a parameter is used only if another parameter, the chooser,
   * has certain values. Declared next to the parameter, as a constant outside
   * of functions. A '*' stands for any name, the same in all paths of a
   * condition. The rule of a parameter replaces that of its section with the
   * same chooser.
   */
  struct UsedWhere
  {
    /** Declares that @p parameter is used only for certain values of @p
     *  chooser.
     *  @param values values of @p chooser for which @p parameter is used;
     *  empty: any non-empty value
     *  @param other another parameter that activates @p parameter if set */
    UsedWhere(const char                     *parameter,
              const char                     *chooser,
              const std::vector<std::string> &values,
              const char                     *other = "");

    std::string              parameter, chooser;
    std::vector<std::string> values;
    std::string              other;
  };

  /**
   * Returns a warning that lists all parameters that have been set but are not
   * used. A parameter is listed if its value differs from the default and the
   * selected method, mesh, material law etc. does not use it; parameters of included
   * files are not. Empty if there are none. To be called after ParameterFile::parse().
   */
  std::string
  unused_parameters(const std::vector<ParameterFile::Setting> &settings);

  /** Text of the conditions under which a parameter is used, e.g. "Mesh/Type
   *  = graded or unstructured". Separate lists apply to the section and to
   *  the parameter itself. */
  struct Conditions
  {
    std::vector<std::string> of_section, own;
  };
  Conditions
  conditions_of_use(const std::string &path);
} // namespace geocone

#endif
