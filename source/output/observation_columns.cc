// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/observation_columns.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             const std::vector<double>                 &excess_pressures,
             Json                                      &summary)
  {
    for (unsigned int i = 0; i < excess_pressures.size(); ++i)
      summary["points"][format("excess_pore_pressure_%u_Pa", i + 1)] =
        std::isfinite(excess_pressures[i]) ? Json(excess_pressures[i]) : Json();
    for (unsigned int i = 0; i < displacements.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double u = displacements[i][d];
          summary["points"]
                 [format("displacement_%u_%c_m", i + 1, coordinate[d])] =
                   std::isfinite(u) ? Json(u) : Json();
        }
  }
} // namespace geocone::GEOCONE_DIM
