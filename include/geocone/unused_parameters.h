// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_unused_parameters_h
#define geocone_unused_parameters_h

#include <geocone/base/parameter_file.h>

#include <string>
#include <vector>

namespace geocone
{
  /**
   * One line that names the parameters that are set, to other values than their
   * defaults, and not used: by the method, the mesh, the law ... that other
   * parameters choose. Empty if there are none. To be called after
   * ParameterFile::parse().
   */
  std::string
  unused_parameters(const std::vector<ParameterFile::Setting> &settings);
} // namespace geocone

#endif
