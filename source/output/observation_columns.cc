// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/observation_columns.h>

#include <cmath>

namespace geocone
{
  void
  add_points(const std::vector<dealii::Tensor<1, dim>> &displacements,
             Json                                      &summary)
  {
    for (unsigned int i = 0; i < displacements.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double u = displacements[i][d];
          summary["points"]
                 [format("displacement_%u_%c_m", i + 1, coordinate[d])] =
                   std::isfinite(u) ? Json(u) : Json();
        }
  }
} // namespace geocone
