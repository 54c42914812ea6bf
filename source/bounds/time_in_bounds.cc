// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/parameter_file.h>
#include <geocone/bounds/time_in_bounds.h>

#include <regex>

namespace geocone::GEOCONE_DIM
{
  std::vector<std::string>
  warn_of_time_in_bounds(const Scene &scene)
  {
    static const std::regex  of_time("\\b(t|record)\\b");
    std::vector<std::string> warnings;
    for (const auto &traction : scene.tractions.list)
      for (unsigned int c = 0; c < dim + 2; ++c)
        if (const std::string &text = traction->formula(c);
            std::regex_search(text, of_time))
          warnings.push_back("the traction '" + traction->name +
                             "' depends on time ('" + text +
                             "'): bounds take it at t = 0, so give the value "
                             "that is meant without t");
    for (const auto &stage : scene.loading.list)
      for (const std::string entry : {"Removed polygon",
                                      "Removed where",
                                      "Added materials",
                                      "Changed materials",
                                      "Water table"})
        if (const std::string path = "Loading/" + stage->name + "/" + entry;
            !ParameterFile::value(path).empty() &&
            !(entry == "Water table" && scene.water.seepage.acts()))
          warnings.push_back("bounds have no stages: '" + path +
                             "' has no effect, so give the body, materials and "
                             "water of that stage");
    return warnings;
  }
} // namespace geocone::GEOCONE_DIM
