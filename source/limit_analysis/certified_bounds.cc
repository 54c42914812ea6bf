// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/certified_bounds.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using Eigen::VectorXd;

  namespace
  {
    CertifiedBounds::Side
    solve_upper(const BoundScene   &bound,
                const BoundProblem &above,
                const double        tolerance)
    {
      InteriorPoint::Options options;
      options.tolerance             = tolerance;
      options.equilibrium_tolerance = tolerance;
      // What is missed is repaired, which is dear; a projection takes care of
      // phi = 0.
      options.flow_tolerance = above.has_incompressible() ? 1e-6 : 1e-8;
      // No field is known that repairs what is missed beside obstacles.
      if (above.n_interfaces() > 0)
        options.flow_margin = 10. * options.flow_tolerance;
      CertifiedBounds::Side side;
      side.solution   = InteriorPoint::solve(above, options);
      side.n_unknowns = above.n_unknowns();
      side.bound      = certify_upper(bound, above, side.solution);
      return side;
    }
  } // namespace

  CertifiedBounds::Side
  certified_upper(const BoundScene &bound, const double tolerance)
  {
    return solve_upper(bound, upper_problem(bound), tolerance);
  }

  CertifiedBounds::Side
  certified_lower(const BoundScene &bound, const double tolerance)
  {
    const BoundProblem     below = lower_problem(bound);
    InteriorPoint::Options options;
    options.tolerance             = tolerance;
    options.flow_tolerance        = tolerance;
    options.equilibrium_tolerance = 1e-7; // the repair may violate the cone
    options.stresses              = true;
    if (!below.can_be_scaled())
      options.strength_margin = 1e-5;
    CertifiedBounds::Side side;
    side.solution   = InteriorPoint::solve(below, options);
    side.n_unknowns = below.n_unknowns();
    side.bound      = certify_lower(bound, below, side.solution);
    const auto e    = below.B.rates(side.solution.q);
    side.power.assign(below.n_triangles, 0.);
    for (unsigned int p = 0; p < below.n_points(); ++p)
      {
        const unsigned int c = p / 3;
        side
          .power[c < below.n_triangles ? c
                                       : below.owner[c - below.n_triangles]] +=
          below.volume[p] * std::abs(side.solution.s[p].dot(e[p]));
      }
    return side;
  }

  CertifiedBounds
  certified_bounds(const BoundScene &bound, const double tolerance)
  {
    CertifiedBounds    bounds;
    const BoundProblem above = upper_problem(bound);
    bounds.upper             = solve_upper(bound, above, tolerance);
    bounds.lower             = certified_lower(bound, tolerance);

    bounds.gap    = gap_of_cells(above, bounds.upper.bound, bounds.lower.bound);
    bounds.uneven = bounds.gap;
    // Marks stresses at yield away from the upper bound's mechanism.
    std::vector<double> power      = bounds.lower.power;
    double              sum_of_gap = 0., sum_of_power = 0.;
    for (unsigned int c = 0; c < power.size(); ++c)
      {
        power[c] *= std::sqrt(bound.triangles.area(c));
        sum_of_gap += std::max(bounds.gap[c], 0.);
        sum_of_power += power[c];
      }
    constexpr double part = 0.3;
    if (std::isfinite(sum_of_power) && sum_of_power > 0.)
      for (unsigned int c = 0; c < power.size(); ++c)
        bounds.uneven[c] = std::max(bounds.gap[c], 0.) +
                           part * sum_of_gap / sum_of_power * power[c];
    const double work =
      above.has_factor() ? above.live.dot(bounds.upper.bound.q) : 1.;
    bounds.gap_share =
      std::accumulate(bounds.gap.begin(), bounds.gap.end(), 0.) /
      ((bounds.upper.bound.load - bounds.lower.bound.load) * work);
    return bounds;
  }

  std::array<double, 2>
  davis_estimate(const BoundedLoad &load,
                 const Scene       &scene,
                 const Triangles   &triangles,
                 const double       tolerance)
  {
    const BoundScene davis = load.by_davis(scene, triangles, 1.);
    return {
      {load.value_of_unit() * certified_lower(davis, tolerance).bound.load,
       load.value_of_unit() * certified_upper(davis, tolerance).bound.load}};
  }

  CellSizes
  sizes_by_gap(const Triangles           &triangles,
               const std::vector<double> &gap,
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
    const std::vector<double> gap_around =
      at_vertices([&](const unsigned int c) { return std::max(gap[c], 0.); });
    const double least =
      1e-12 * std::max(0., *std::max_element(gap.begin(), gap.end()));
    std::vector<double> wish(n);
    for (unsigned int c = 0; c < n; ++c)
      {
        double smooth = 0.;
        for (const unsigned int v : triangles.cells[c])
          smooth += gap_around[v] / 3.;
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
