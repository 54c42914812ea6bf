// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/adapted_sizes.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Triangles of a fan. */
    struct FanCells
    {
      std::vector<unsigned int> innermost, outermost, all;
    };

    FanCells
    cells_of_fan(const Triangles &triangles, const Fan &fan)
    {
      FanCells found;
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        {
          double near = fan.radius, far = 0.;
          for (const unsigned int v : triangles.cells[c])
            {
              const double r = triangles.vertices[v].distance(fan.apex);
              near           = std::min(near, r);
              far            = std::max(far, r);
            }
          if (far > 1.0001 * fan.radius)
            continue;
          found.all.push_back(c);
          if (near < 1e-4 * far)
            found.innermost.push_back(c);
          if (far > 0.9999 * fan.radius)
            found.outermost.push_back(c);
        }
      return found;
    }

    /** Means of a function of a cell's number over the cells at each vertex. */
    template <typename OfCell>
    std::vector<double>
    means_at_vertices(const Triangles &triangles, const OfCell &of_cell)
    {
      std::vector<double>       mean(triangles.vertices.size(), 0.);
      std::vector<unsigned int> n_cells(mean.size(), 0);
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (const unsigned int v : triangles.cells[c])
          {
            mean[v] += of_cell(c);
            ++n_cells[v];
          }
      for (unsigned int v = 0; v < mean.size(); ++v)
        mean[v] /= std::max(n_cells[v], 1u);
      return mean;
    }

    /** Ratios of new to present sizes of cells, in proportion to what is wished
     *  for but between 0.3 and 1.6, with about n_wanted cells in all. */
    std::vector<double>
    bounded_ratios(std::vector<double> wish, const double n_wanted)
    {
      const auto ratio = [](const double factor, const double wished) {
        return std::clamp(factor * wished, 0.3, 1.6);
      };
      double lower_factor = 1e-30, upper_factor = 1e30;
      for (unsigned int i = 0; i < 200; ++i)
        {
          const double middle = std::sqrt(lower_factor * upper_factor);
          double       cells  = 0.;
          for (const double wished : wish)
            cells += 1. / (ratio(middle, wished) * ratio(middle, wished));
          (cells > n_wanted ? lower_factor : upper_factor) = middle;
        }
      for (double &wished : wish)
        wished = ratio(upper_factor, wished);
      return wish;
    }
  } // namespace

  CellSizes
  adapted_sizes(const Triangles           &triangles,
                const std::vector<double> &error,
                const double               n_wanted,
                std::vector<Fan>           fans)
  {
    const unsigned int        n            = triangles.cells.size();
    const std::vector<double> error_around = means_at_vertices(
      triangles, [&](const unsigned int c) { return std::max(error[c], 0.); });
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
    const std::vector<double> ratio = bounded_ratios(wish, n_wanted);
    // Sizes of equilateral triangles of the same area.
    std::vector<double> size_of_cell(n);
    for (unsigned int c = 0; c < n; ++c)
      size_of_cell[c] = std::sqrt(4. / std::sqrt(3.) * triangles.area(c));
    for (Fan &fan : fans)
      {
        const FanCells cells = cells_of_fan(triangles, fan);
        if (cells.innermost.size() + 1 < fan.rays.size())
          continue; // the mesh does not have it
        for (const unsigned int c : cells.all)
          {
            double far = 0.;
            for (const unsigned int v : triangles.cells[c])
              far = std::max(far, triangles.vertices[v].distance(fan.apex));
            size_of_cell[c] = fan.chord() * far / fan.radius;
          }
        const auto mean_ratio = [&](const std::vector<unsigned int> &some) {
          double sum = 0.;
          for (const unsigned int c : some)
            sum += ratio[c];
          return std::min(1., sum / some.size());
        };
        fan.inner_radius *= mean_ratio(cells.innermost);
        fan.radius = std::max(2. * fan.inner_radius,
                              fan.radius * mean_ratio(cells.outermost));
      }
    const std::vector<double> size =
      means_at_vertices(triangles, [&](const unsigned int c) {
        return ratio[c] * size_of_cell[c];
      });
    CellSizes                 sizes;
    sizes.fans = std::move(fans);
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

  void
  state_of_sizes(StateRow &row, std::optional<CellSizes> &sizes)
  {
    bool has_sizes = sizes.has_value();
    row(has_sizes);
    if (!has_sizes)
      return sizes.reset();
    if (!sizes)
      sizes.emplace();
    row(sizes->triangles, sizes->sizes, sizes->fans);
  }
} // namespace geocone::GEOCONE_DIM
