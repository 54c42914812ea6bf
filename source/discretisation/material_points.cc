// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/material_points.h>

namespace geocone
{
  void
  MaterialPoints::state(const unsigned int p, StateRow &row)
  {
    row(stress[p],
        plastic_strain[p],
        cumulative_plastic_strain[p],
        plastic_strain_rate[p]);
    for (unsigned int k = 0; k < n_history; ++k)
      row(history[n_history * p + k]);
    if (!id.empty())
      row(material[p],
          mass[p],
          weight[p],
          velocity[p],
          displacement[p],
          affine[p],
          held_by[p]);
  }

  void
  MaterialPoints::resize(const unsigned int n, const bool moving)
  {
    position.resize(n);
    material.resize(n, 0);
    weight.resize(n, 0.);
    stress.resize(n, Mandel::Zero());
    plastic_strain.resize(n, Mandel::Zero());
    cumulative_plastic_strain.resize(n, 0.);
    plastic_strain_rate.resize(n, 0.);
    history.resize(n_history * n, 0.);
    if (!moving)
      return;
    id.resize(n, 0);
    mass.resize(n, 0.);
    velocity.resize(n);
    displacement.resize(n);
    affine.resize(n);
    held_by.resize(n, 0);
  }

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
