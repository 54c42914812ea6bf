// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/boundary/acting_stages.h>

#include <algorithm>

namespace geocone
{
  void
  ActingStages::declare(dealii::ParameterAcceptor &section,
                        const std::string         &rest)
  {
    section.add_parameter(entry,
                          list,
                          "Stages in which it acts, comma-separated" + rest +
                            " Empty: all.");
  }

  void
  ActingStages::check(const std::string              &parameter,
                      const std::vector<std::string> &all) const
  {
    for (const std::string &stage : list)
      if (std::count(all.begin(), all.end(), stage) == 0)
        throw InputError(
          parameter, stage, "names in 'Loading/Stages'", "check the spelling");
  }

  bool
  ActingStages::include(const std::string &stage) const
  {
    return are_all() || std::count(list.begin(), list.end(), stage) > 0;
  }
} // namespace geocone
