// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/adapted_sizes.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  CellSizes
  adapted_sizes(const Triangles           &triangles,
                const std::vector<double> &error,
                const double               n_wanted)
  {
    const unsigned int n = triangles.cells.size();
    // Means over the cells at each vertex.
    const auto at_vertices = [&](const auto &of_cell) {
      std::vector<double>       mean(triangles.vertices.size(), 0.);
      std::vector<unsigned int> n_cells(mean.size(), 0);
      for (unsigned int c = 0; c < n; ++c)
        for (const unsigned int v : triangles.cells[c])
          {
            mean[v] += of_cell(c);
            ++n_cells[v];
          }
      for (unsigned int v = 0; v < mean.size(); ++v)
        mean[v] /= std::max(n_cells[v], 1u);
      return mean;
    };
    const std::vector<double> error_around =
      at_vertices([&](const unsigned int c) { return std::max(error[c], 0.); });
    const double least =
      1e-12 * std::max(0., *std::max_element(error.begin(), error.end()));
    std::vector<double> wish(n);
    for (unsigned int c = 0; c < n; ++c)
      {
        double smooth = 0.;
        for (const unsigned int v : triangles.cells[c])
          smooth += error_around[v] / 3.;
        wish[c] = std::pow(std::max(smooth, least), -1. / 3.);
      }
    // Ratio of the number of cells with a given factor to the wanted one.
    const auto ratio = [&](const double factor, const unsigned int c) {
      return std::clamp(factor * wish[c], 0.3, 1.6);
    };
    double lower_factor = 1e-30, upper_factor = 1e30;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle = std::sqrt(lower_factor * upper_factor);
        double       cells  = 0.;
        for (unsigned int c = 0; c < n; ++c)
          cells += 1. / (ratio(middle, c) * ratio(middle, c));
        (cells > n_wanted ? lower_factor : upper_factor) = middle;
      }
    const std::vector<double> size = at_vertices([&](const unsigned int c) {
      // Size of an equilateral triangle of this area.
      return ratio(upper_factor, c) *
             std::sqrt(4. / std::sqrt(3.) * triangles.area(c));
    });
    CellSizes                 sizes;
    for (const auto &cell : triangles.cells)
      {
        sizes.triangles.emplace_back();
        sizes.sizes.emplace_back();
        for (unsigned int i = 0; i < 3; ++i)
          {
            sizes.triangles.back()[i] = triangles.vertices[cell[i]];
            sizes.sizes.back()[i]     = size[cell[i]];
          }
      }
    return sizes;
  }
} // namespace geocone::GEOCONE_DIM
