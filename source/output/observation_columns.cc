// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/output/observation_columns.h>

#include <cmath>

namespace geocone
{
  void
  add_observation_columns(const Observation        &observation,
                          const BoundaryConditions &conditions,
                          std::vector<std::string> &columns)
  {
    for (const unsigned int c : observation.conditions)
      columns.push_back("moment " + conditions.list[c]->name + " (N m/m)");
    for (unsigned int i = 1; i <= observation.points.size(); ++i)
      for (const char direction : {'x', 'y'})
        columns.push_back(
          format("displacement of point %u %c (m)", i, direction));
  }

  void
  add_observations(const std::vector<double>                 &moments,
                   const std::vector<dealii::Tensor<1, dim>> &displacements,
                   std::vector<double>                       &line)
  {
    line.insert(line.end(), moments.begin(), moments.end());
    for (const auto &displacement : displacements)
      for (unsigned int d = 0; d < dim; ++d)
        line.push_back(displacement[d]);
  }

  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             Json                                      &summary)
  {
    for (unsigned int i = 0; i < displacements.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double u = displacements[i][d];
          summary["points"][format("displacement_%u_%c_m", i + 1, "xy"[d])] =
            std::isfinite(u) ? Json(u) : Json();
        }
  }
} // namespace geocone
