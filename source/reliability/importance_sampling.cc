// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/reliability/importance_sampling.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  using Eigen::VectorXd;

  void
  DesignPoint::state(StateRow &row)
  {
    std::vector<double> values(numbers.begin(), numbers.end());
    row(values, load_factor, iterations, converged, distance);
    numbers = Eigen::Map<const VectorXd>(values.data(), values.size());
  }

  DesignPoint
  design_point(const unsigned int                                 n,
               const std::function<LimitState(const VectorXd &)> &limit_state,
               const VectorXd                                    &start)
  {
    constexpr unsigned int most_iterations = 20;
    constexpr double       longest = 3., tolerance = 0.02;
    DesignPoint            point;
    point.numbers      = start.size() > 0 ? start : VectorXd(VectorXd::Zero(n));
    const bool is_mean = point.numbers.squaredNorm() == 0.;
    for (;;)
      {
        const LimitState state = limit_state(point.numbers);
        point.load_factor      = std::exp(state.log_load);
        const double square    = state.gradient.squaredNorm();
        if (!std::isfinite(state.log_load + square) || square == 0.)
          return point;
        const VectorXd change =
          (state.gradient.dot(point.numbers) - state.log_load) / square *
            state.gradient -
          point.numbers;
        const double length = change.norm();
        point.converged     = point.iterations == 0
                                ? is_mean && state.log_load <= 0.
                                : length < tolerance * std::max(1., point.index());
        if (point.converged || point.iterations == most_iterations)
          return point;
        // Steps that alternate between two mechanisms are shortened.
        const double allowed = point.iterations < 8 ? longest : longest / 6.;
        point.numbers += std::min(1., allowed / length) * change;
        ++point.iterations;
      }
  }

  std::vector<DesignPoint>
  design_points(const unsigned int                                 n,
                const std::function<LimitState(const VectorXd &)> &limit_state)
  {
    constexpr unsigned int most    = 3;
    constexpr double       same    = 0.9, // cosine
      farther                      = 1.5; // of reliability indices
    std::vector<DesignPoint> found = {design_point(n, limit_state)};
    if (!found[0].converged || found[0].mean_fails())
      return found;
    for (unsigned int i = 0; i < found.size() && found.size() < most; ++i)
      {
        DesignPoint other   = design_point(n, limit_state, -found[i].numbers);
        const auto  is_same = [&](const DesignPoint &point) {
          return point.numbers.dot(other.numbers) >
                 same * point.index() * other.index();
        };
        if (other.converged && other.index() > 0. &&
            std::none_of(found.begin(), found.end(), is_same))
          found.push_back(std::move(other));
      }
    std::stable_sort(found.begin(),
                     found.end(),
                     [](const DesignPoint &a, const DesignPoint &b) {
                       return a.index() < b.index();
                     });
    while (found.back().index() > found.front().index() + farther)
      found.pop_back();
    return found;
  }

  double
  distance_of_centre(
    const DesignPoint                                 &point,
    const std::vector<VectorXd>                       &pilots,
    const std::function<LimitState(const VectorXd &)> &limit_state)
  {
    const double distance = point.index();
    if (distance == 0.)
      return 0.;
    constexpr unsigned int n_steps = 3;
    constexpr double       near    = 0.1;
    const VectorXd         axis    = point.numbers / distance;
    const double           n       = pilots.size();
    double                 zero = distance, share = 1.;
    for (unsigned int step = 0; step < n_steps && zero > 0.; ++step)
      {
        double mean = 0., square = 0., slope = 0.;
        for (const VectorXd &pilot : pilots)
          {
            const LimitState state =
              limit_state(pilot + (zero - axis.dot(pilot)) * axis);
            mean += state.log_load / n;
            square += state.log_load * state.log_load / n;
            slope += axis.dot(state.gradient) / n;
          }
        if (!(slope < 0.) || !std::isfinite(square))
          break;
        const double change = -mean / slope;
        share =
          slope * slope / (slope * slope + std::max(square - mean * mean, 0.));
        zero = std::clamp(zero + change, 0., distance);
        if (std::abs(change) < near)
          break;
      }
    return share * zero;
  }

  VectorXd
  SamplingDensity::moved(const unsigned int number, VectorXd numbers) const
  {
    if (!is_normal() && number % period != 0)
      numbers += centres[(number - number / period - 1) % centres.size()];
    return numbers;
  }

  double
  SamplingDensity::weight(const VectorXd &numbers) const
  {
    if (is_normal())
      return 1.;
    const unsigned int n_around_origin = n_samples / period,
                       n_moved         = n_samples - n_around_origin,
                       n               = centres.size();
    double density                     = n_around_origin;
    for (unsigned int i = 0; i < n; ++i)
      {
        // Centres are taken in turn.
        const unsigned int n_own = n_moved / n + (i < n_moved % n);
        density += n_own * std::exp(centres[i].dot(numbers) -
                                    centres[i].squaredNorm() / 2.);
      }
    return n_samples / density;
  }
} // namespace geocone
