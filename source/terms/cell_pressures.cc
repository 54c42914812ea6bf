// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/take_larger.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/terms/cell_pressures.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Fraction of the elastic modulus below which a point counts as soft. */
    constexpr double softest = 1e-9;

    /** Rounding error of the differences, over the largest stress, and the
     *  number of steps after which no improvement is expected. Two or three are
     *  the rule. */
    constexpr double       pressure_rounding = 1e-13;
    constexpr unsigned int most_steps        = 100;

    /** Number of steps after which oscillating cells restart with shortened
     *  steps. */
    constexpr unsigned int whole_steps = 20;

    /** A step is too long if the differences do not decrease and the slope of
     *  the functional at its end is positive and larger than this fraction of
     *  its initial fall. */
    constexpr double overshoot = 0.5;

    /** Differences over the largest stress within which Newton's method uses
     *  full steps: slopes may be rounding there. */
    constexpr double near_solution = 1e-9;

    /** Minimum fraction of a step left by one shortening. */
    constexpr double shortest = 0.1;

    const Mandel &
    mean_direction()
    {
      static const Mandel direction = unit_tensor<n_mandel>() / dim;
      return direction;
    }
  } // namespace

  bool
  CellPressures::are_those_of(const MaterialPoints &points,
                              const Materials      &materials)
  {
    return points.n_volumetric_modes > 0 && materials.traits().dilates;
  }

  CellPressures::CellPressures(const MaterialPoints &points,
                               const Materials      &materials)
    : points(points)
    , materials(materials)
    , least_modulus(points.n_points())
    , mean(points.n_points())
    , k(points.n_points())
    , growth(points.n_points())
    , change(points.n_points())
  {}

  void
  CellPressures::begin_step()
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Elasticity elastic = elasticity_at_start(materials, points, p);
        least_modulus[p] = softest * (elastic.lambda + elastic.two_G / dim);
      }
  }

  double
  CellPressures::pore_pressure(const unsigned int point) const
  {
    return materials.traits().undrained ? points.excess_pressure(point) : 0.;
  }

  void
  CellPressures::evaluate(const unsigned int  point,
                          const double        mean_stress,
                          const MandelMatrix &tangent,
                          const double        volumetric_strain)
  {
    const double fluid = materials[points.material[point]].fluid_modulus();
    mean[point]        = mean_stress + fluid * volumetric_strain;
    k[point] =
      std::max(mean_direction().dot(tangent * mean_direction()) + fluid,
               least_modulus[point]);
  }

  void
  CellPressures::choose_basis(const unsigned int         cell,
                              const std::vector<double> &softness,
                              Basis                     &result) const
  {
    const unsigned int first = points.first_point[cell],
                       n     = points.first_point[cell + 1] - first,
                       n_m   = points.n_volumetric_modes;
    auto &M                  = result.modes;
    M                        = Eigen::Map<const decltype(result.modes)>(
      &points.volumetric_modes[first * n_m], n, n_m);
    result.point.assign(n_m, -1);
    // Gauss-Jordan elimination with the largest pivots, by columns.
    for (unsigned int step = 0; step < n_m; ++step)
      {
        double       largest = 0.;
        unsigned int q = 0, j = 0;
        for (unsigned int i = 0; i < n_m; ++i)
          if (result.point[i] < 0)
            for (unsigned int p = 0; p < n; ++p)
              if (softness[p] * M(p, i) * M(p, i) > largest)
                {
                  largest = softness[p] * M(p, i) * M(p, i);
                  q       = p;
                  j       = i;
                }
        if (largest == 0.)
          break;
        result.point[j]    = q;
        const double pivot = M(q, j);
        M.col(j) /= pivot;
        for (unsigned int i = 0; i < n_m; ++i)
          if (const double factor = M(q, i); i != j)
            M.col(i) -= factor * M.col(j);
      }
    Basis::Matrix G = Basis::Matrix::Zero(n_m, n_m);
    for (unsigned int p = 0; p < n; ++p)
      for (unsigned int i = 0; i < n_m; ++i)
        for (unsigned int j = 0; j < n_m; ++j)
          G(i, j) += softness[p] * M(p, i) * M(p, j);
    for (unsigned int j = 0; j < n_m; ++j)
      if (result.point[j] < 0)
        G(j, j) = 1.;
    result.compliance.compute(G);
  }

  double
  CellPressures::fit(const unsigned int cell)
  {
    const unsigned int first = points.first_point[cell],
                       n     = points.first_point[cell + 1] - first;
    softness.resize(n);
    for (unsigned int q = 0; q < n; ++q)
      softness[q] = points.weight[first + q] / k[first + q];
    choose_basis(cell, softness, basis);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_modes, 1> m =
      decltype(m)::Zero(points.n_volumetric_modes);
    for (unsigned int q = 0; q < n; ++q)
      m += (softness[q] * mean[first + q]) * basis.modes.row(q).transpose();
    m                 = basis.compliance.solve(m).eval();
    fitted.noalias()  = basis.modes * m;
    double difference = 0.;
    for (unsigned int q = 0; q < n; ++q)
      take_larger(difference, std::abs(fitted[q] - mean[first + q]));
    return difference;
  }

  void
  CellPressures::shift(const unsigned int cell)
  {
    const unsigned int first = points.first_point[cell];
    const auto         n     = static_cast<unsigned int>(fitted.size());
    for (unsigned int q = 0; q < n; ++q)
      change[first + q] = (fitted[q] - mean[first + q]) / k[first + q];
    // The points with M_j = 1 take the remainder of sum V M_j t.
    for (const int q : basis.point)
      if (q >= 0)
        change[first + q] = 0.;
    for (unsigned int j = 0; j < basis.point.size(); ++j)
      if (basis.point[j] >= 0)
        {
          double sum = 0.;
          for (unsigned int q = 0; q < n; ++q)
            sum += points.weight[first + q] * basis.modes(q, j) *
                   (growth[first + q] + change[first + q]);
          change[first + basis.point[j]] -=
            sum / points.weight[first + basis.point[j]];
        }
    for (unsigned int q = 0; q < n; ++q)
      growth[first + q] += change[first + q];
  }

  void
  CellPressures::shorten(const unsigned int cell, const double part)
  {
    for (unsigned int p = points.first_point[cell];
         p < points.first_point[cell + 1];
         ++p)
      {
        growth[p] -= (1. - part) * change[p];
        change[p] *= part;
      }
    first_slope[cell] *= part;
  }

  double
  CellPressures::slope(const unsigned int cell) const
  {
    double sum = 0.;
    for (unsigned int p = points.first_point[cell];
         p < points.first_point[cell + 1];
         ++p)
      sum += points.weight[p] * mean[p] * change[p];
    return sum;
  }

  void
  CellPressures::next_change(const unsigned int cell,
                             const unsigned int step,
                             const double       difference,
                             const double       scale)
  {
    const double after = slope(cell);
    if (step == whole_steps)
      {
        for (unsigned int p = points.first_point[cell];
             p < points.first_point[cell + 1];
             ++p)
          growth[p] = change[p] = 0.;
        first_slope[cell] = first_difference[cell] = 0.;
      }
    else if (step > whole_steps && after > -overshoot * first_slope[cell] &&
             difference >= first_difference[cell] &&
             difference > near_solution * scale)
      shorten(
        cell,
        std::max(first_slope[cell] / (first_slope[cell] - after), shortest));
    else
      {
        shift(cell);
        first_slope[cell]      = slope(cell);
        first_difference[cell] = difference;
      }
  }

  void
  CellPressures::equalise(
    const std::function<void(const unsigned int, const unsigned int)> &update,
    const std::vector<Mandel>                                         &stress,
    const std::vector<MandelMatrix>                                   &tangent,
    std::vector<Mandel>                                               &strain,
    const std::vector<double> &strain_zz)
  {
    given = strain;
    std::fill(growth.begin(), growth.end(), 0.);
    std::fill(change.begin(), change.end(), 0.);
    first_slope.assign(points.n_cells(), 0.);
    first_difference.assign(points.n_cells(), 0.);
    unequal.resize(points.n_cells());
    std::iota(unequal.begin(), unequal.end(), 0);
    double scale       = 0.;
    largest_difference = 0.;
    for (unsigned int step = 0; !unequal.empty(); ++step)
      {
        // Contiguous cells are evaluated together.
        for (auto cell = unequal.begin(); cell != unequal.end();)
          {
            const unsigned int first = *cell;
            unsigned int       next  = first;
            for (; cell != unequal.end() && *cell == next; ++cell)
              ++next;
            update(points.first_point[first], points.first_point[next]);
          }
        for (const unsigned int c : unequal)
          for (unsigned int p = points.first_point[c];
               p < points.first_point[c + 1];
               ++p)
            {
              evaluate(p,
                       trace(stress[p]) / dim - pore_pressure(p),
                       tangent[p],
                       trace(strain[p]) +
                         (strain_zz.empty() ? 0. : strain_zz[p]));
              if (step == 0) // later ones may be far off
                scale = std::max({scale, stress[p].norm(), std::abs(mean[p])});
            }
        unsigned int n = 0;
        for (const unsigned int c : unequal)
          {
            const double difference = fit(c);
            if (!(difference > pressure_rounding * scale) || step == most_steps)
              {
                take_larger(largest_difference, difference);
                continue;
              }
            unequal[n++] = c;
            next_change(c, step, difference, scale);
            for (unsigned int p = points.first_point[c];
                 p < points.first_point[c + 1];
                 ++p)
              strain[p] = given[p] + growth[p] * mean_direction();
          }
        unequal.resize(n);
      }
    largest_difference /= std::max(scale, std::numeric_limits<double>::min());
  }

  void
  CellPressures::equalise_rates(
    const unsigned int                    cell,
    const std::vector<MandelMatrix>      &tangent,
    const std::vector<OutOfPlaneTangent> &tangent_zz,
    std::vector<Mandel>                  &rate,
    const std::vector<double>            &rate_zz)
  {
    const unsigned int begin = points.first_point[cell],
                       end   = points.first_point[cell + 1];
    for (unsigned int p = begin; p < end; ++p)
      {
        growth[p]                = 0.;
        Mandel stress_rate       = tangent[p] * rate[p];
        double volumetric_strain = trace(rate[p]);
        if (!rate_zz.empty())
          {
            stress_rate += rate_zz[p] * tangent_zz[p].by_zz;
            volumetric_strain += rate_zz[p];
          }
        evaluate(
          p, mean_direction().dot(stress_rate), tangent[p], volumetric_strain);
      }
    fit(cell);
    shift(cell);
    for (unsigned int p = begin; p < end; ++p)
      rate[p] += growth[p] * mean_direction();
  }

  void
  CellPressures::condense(const unsigned int              cell,
                          const double                    factor,
                          std::vector<MandelMatrix>      &C,
                          std::vector<OutOfPlaneTangent> &C_zz,
                          Condensed                      &result) const
  {
    const unsigned int first = points.first_point[cell];
    result.left.resize(C.size());
    result.right.resize(C.size());
    result.left_zz.resize(C_zz.size());
    result.right_zz.resize(C_zz.size());
    std::vector<double> softness_of(C.size());
    for (unsigned int q = 0; q < C.size(); ++q)
      {
        const double weight  = factor * points.weight[first + q];
        const Mandel a       = C[q] * mean_direction(),
                     b       = C[q].transpose() * mean_direction();
        const double inverse = 1. / std::max(mean_direction().dot(a) / weight,
                                             least_modulus[first + q]);
        result.left[q]       = inverse * a;
        result.right[q]      = inverse * b;
        softness_of[q]       = weight * inverse;
        C[q] -= (inverse / weight) * a * b.transpose();
        if (C_zz.empty())
          continue;
        const double a_zz  = C_zz[q].of_zz.dot(mean_direction()),
                     b_zz  = C_zz[q].by_zz.dot(mean_direction());
        result.left_zz[q]  = inverse * a_zz;
        result.right_zz[q] = inverse * b_zz;
        C_zz[q].by_zz -= (inverse / weight) * b_zz * a;
        C_zz[q].of_zz -= (inverse / weight) * a_zz * b;
        C_zz[q].zz -= (inverse / weight) * a_zz * b_zz;
      }
    choose_basis(cell, softness_of, result.basis);
  }
} // namespace geocone::GEOCONE_DIM
