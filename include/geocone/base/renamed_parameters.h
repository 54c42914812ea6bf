// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_renamed_parameters_h
#define geocone_base_renamed_parameters_h

#include <geocone/base/parameter_file.h>

#include <string>
#include <vector>

namespace geocone
{
  /**
   * A parameter with a new name. Its former name is read with a warning until the next
   * release but one. Declared next to the parameter, as a constant outside of functions.
   */
  struct RenamedParameter
  {
    /** @param section its path, in which a '*' stands for any name
     *  @param before, now names without the section */
    RenamedParameter(const char *section, const char *before, const char *now);

    std::string section, before, now;
  };

  /** Present name of a parameter of a section. */
  std::string
  present_name(const std::vector<std::string> &sections,
               const std::string              &name);

  /** A warning line with the former names in a file and the present ones; empty if there
   *  are none. */
  std::string
  former_names(const std::vector<ParameterFile::Setting> &settings);
} // namespace geocone

#endif
