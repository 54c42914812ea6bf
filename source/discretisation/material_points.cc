// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/material_points.h>

namespace geocone
{
  void
  average_gradients(MaterialPoints &points)
  {
    const unsigned int m = dim * points.n_nodes; // values per point
    points.mean_gradients.assign(points.n_cells() * m, 0.);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        double *mean   = &points.mean_gradients[c * m];
        double  volume = 0.;
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            volume += points.weight[p];
            for (unsigned int k = 0; k < m; ++k)
              mean[k] += points.weight[p] * points.gradients[p * m + k];
          }
        for (unsigned int k = 0; k < m; ++k)
          mean[k] /= volume;
      }
  }
} // namespace geocone
