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
   * Renamed parameter, whose former name is still accepted with a warning. The
   * former name is rejected from the next release but one. Declared next to the
   * parameter, as a constant outside of functions.
   */
  struct RenamedParameter
  {
    /** Declares that a parameter has been renamed.
     *  @param section path of the section; a '*' stands for any name
     *  @param before, now former and present names without the section */
    RenamedParameter(const char *section, const char *before, const char *now);

    std::string section, before, now;
  };

  /** Converts a former parameter name to the current name. Present names are
   *  returned unchanged. */
  std::string
  present_name(const std::vector<std::string> &sections,
               const std::string              &name);

  /** Returns a warning that lists the former parameter names in a parameter
   *  file and the current names. Empty if the file contains no former names. */
  std::string
  former_names(const std::vector<ParameterFile::Setting> &settings);
} // namespace geocone

#endif
