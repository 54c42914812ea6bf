// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/axisymmetric_bounds/axisymmetric_certificate.h>
#include <geocone/base/resources.h>
#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/plane_bounds/bar_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using Eigen::VectorXd;

  namespace
  {
    constexpr BoundQuestion no_question = {}; // the optimum is wanted
  } // namespace

  CertifiedSide
  certified_upper(const BoundScene    &bound,
                  const BoundProblem  &above,
                  const double         tolerance,
                  const BoundQuestion &question)
  {
    ConicOptions options;
    options.tolerance             = tolerance;
    options.equilibrium_tolerance = tolerance;
    options.question              = question.load;
    options.located               = question.located;
    // Remaining violations of the flow rule are repaired, which widens the
    // gap; for phi = 0 a projection removes them.
    options.flow_tolerance = above.has_incompressible() ? 1e-6 : 1e-8;
    const double margin    = 10. * options.flow_tolerance;
    const auto   certified = [&]() {
      CertifiedSide side;
      side.solution   = solve(above, options);
      side.n_unknowns = above.n_unknowns();
      side.bound      = certify_upper(bound, above, side.solution);
      return side;
    };
    // No field is known that repairs what is missed beside obstacles.
    if (above.n_interfaces() > 0)
      options.flow_margin = margin;
    CertifiedSide side = certified();
    // Velocities of unlimited structures are projected, which needs a wider margin.
    for (unsigned int i = 0; i < 3 && above.n_bar_cells > 0 &&
                             !side.bound.certified && side.solution.converged;
         ++i)
      {
        options.flow_margin *= 10.;
        const unsigned int before = side.solution.factorisations;
        side                      = certified();
        side.solution.factorisations += before;
      }
    if (side.bound.certified || side.bound.violation == 0. ||
        !side.solution.converged || options.flow_margin > 0.)
      return side;
    // Prescribed velocities allow none of the fields that repair: once more, with a
    // margin, which costs the margin's part of the load.
    options.flow_margin          = margin;
    CertifiedSide second         = certified();
    second.solution.factorisations += side.solution.factorisations;
    return second.bound.certified ? second : side;
  }

  CertifiedSide
  certified_upper(const BoundScene &bound, const double tolerance)
  {
    if (AxisymmetricPower power; bound.is_axisymmetric())
      return certified_upper(AxisymmetricScene(bound), tolerance, power);
    return certified_upper(bound, upper_problem(bound), tolerance, no_question);
  }

  CertifiedSide
  certified_lower(const BoundScene &bound, const double tolerance)
  {
    if (bound.is_axisymmetric())
      return certified_lower(AxisymmetricScene(bound), tolerance);
    return certified_lower(bound, lower_problem(bound), tolerance, no_question);
  }

  CertifiedSide
  certified_lower(const BoundScene    &bound,
                  const BoundProblem  &below,
                  const double         tolerance,
                  const BoundQuestion &question)
  {
    ConicOptions options;
    options.tolerance             = tolerance;
    options.flow_tolerance        = tolerance;
    options.equilibrium_tolerance = 1e-7; // the repair may violate the cone
    options.stresses              = true;
    options.question              = question.load;
    options.located               = question.located;
    if (!below.can_be_scaled())
      options.strength_margin = 1e-5;
    CertifiedSide side;
    side.solution   = solve(below, options);
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

  std::vector<double>
  uneven_gap(const BoundScene          &bound,
             const std::vector<double> &gap,
             const CertifiedSide       &lower)
  {
    std::vector<double> refinement_indicator = gap;
    // Marks stresses at yield away from the upper bound's mechanism.
    std::vector<double> power      = lower.power;
    double              sum_of_gap = 0., sum_of_power = 0.;
    for (unsigned int c = 0; c < power.size(); ++c)
      {
        power[c] *= std::sqrt(bound.triangles.area(c));
        sum_of_gap += std::max(gap[c], 0.);
        sum_of_power += power[c];
      }
    constexpr double part = 0.3;
    if (std::isfinite(sum_of_power) && sum_of_power > 0.)
      for (unsigned int c = 0; c < power.size(); ++c)
        refinement_indicator[c] =
          std::max(gap[c], 0.) + part * sum_of_gap / sum_of_power * power[c];
    return refinement_indicator;
  }

  CertifiedBounds
  certified_bounds(const BoundScene &bound, const double tolerance)
  {
    CertifiedBounds bounds;
    double          work;
    if (bound.is_axisymmetric())
      {
        const AxisymmetricScene body(bound);
        AxisymmetricPower       power;
        run_both(
          [&]() { bounds.upper = certified_upper(body, tolerance, power); },
          [&]() { bounds.lower = certified_lower(body, tolerance); });
        bounds.gap =
          gap_of_cells(body, bounds.upper.bound, power, bounds.lower.bound);
        work = power.work;
      }
    else
      {
        const BoundProblem above = upper_problem(bound);
        run_both(
          [&]() {
            bounds.upper =
              certified_upper(bound, above, tolerance, no_question);
          },
          [&]() { bounds.lower = certified_lower(bound, tolerance); });
        bounds.gap =
          gap_of_cells(above, bounds.upper.bound, bounds.lower.bound);
        add_gap_of_bars(
          bound, above, bounds.upper.bound, bounds.lower.bound, bounds.gap);
        work = above.has_factor() ? above.live.dot(bounds.upper.bound.q) : 1.;
      }
    bounds.refinement_indicator = uneven_gap(bound, bounds.gap, bounds.lower);
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
    const BoundScene davis =
      load.by_davis(load.on(scene, triangles), 1., DavisVariant::A);
    return {{load.load_of_unit_factor() *
               certified_lower(davis, tolerance).bound.load,
             load.load_of_unit_factor() *
               certified_upper(davis, tolerance).bound.load}};
  }
} // namespace geocone::GEOCONE_DIM
