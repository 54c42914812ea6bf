// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/cell_pressures.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  namespace
  {
    /** The part of the elastic modulus below which a point counts as soft. */
    constexpr double softest = 1e-9;

    /** Differences that are rounding, over the greatest stress, and the steps after
     *  which no more is to be had. Two or three are the rule. */
    constexpr double       rounding   = 1e-13;
    constexpr unsigned int most_steps = 50;

    const Mandel &
    mean_direction()
    {
      static const Mandel direction = unit_tensor<n_mandel>() / dim;
      return direction;
    }
  } // namespace

  CellPressures::CellPressures(const MaterialPoints &points,
                               const Materials      &materials)
    : points(points)
    , materials(materials)
    , least_modulus(points.n_points())
    , mean(points.n_points())
    , k(points.n_points())
    , growth(points.n_points())
  {}

  void
  CellPressures::begin_step()
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Elasticity elastic = materials[points.material[p]].elasticity_at(
          points.stress[p], points.history_of(p));
        least_modulus[p] = softest * (elastic.lambda + elastic.two_G / dim);
      }
  }

  double
  CellPressures::modulus(const unsigned int point, const MandelMatrix &C) const
  {
    return std::max(mean_direction().dot(C * mean_direction()),
                    least_modulus[point]);
  }

  void
  CellPressures::shift(const unsigned int cell)
  {
    const unsigned int begin = points.first_point[cell],
                       end   = points.first_point[cell + 1];
    double       sum = 0., weighted = 0.;
    unsigned int soft = begin;
    for (unsigned int p = begin; p < end; ++p)
      {
        sum += points.weight[p] / k[p];
        weighted += points.weight[p] / k[p] * mean[p];
        if (k[p] < k[soft])
          soft = p;
      }
    // The softest point takes the rest, so that the mean volumetric strain stays to
    // the last digit even where 1/k is very large.
    double rest = 0.;
    for (unsigned int p = begin; p < end; ++p)
      if (p != soft)
        {
          growth[p] += (weighted / sum - mean[p]) / k[p];
          rest -= points.weight[p] * growth[p];
        }
    if (begin < end)
      growth[soft] = rest / points.weight[soft];
  }

  void
  CellPressures::equalise(const std::function<void()>     &update,
                          const std::vector<Mandel>       &stress,
                          const std::vector<MandelMatrix> &tangent,
                          std::vector<Mandel>             &strain)
  {
    given = strain;
    std::fill(growth.begin(), growth.end(), 0.);
    for (unsigned int step = 0;; ++step)
      {
        update();
        double scale = 0.;
        for (unsigned int p = 0; p < points.n_points(); ++p)
          {
            const double fluid = materials[points.material[p]].fluid_modulus();
            mean[p]            = trace(stress[p]) / dim;
            k[p]               = modulus(p, tangent[p]) + fluid;
            if (fluid > 0.)
              mean[p] += fluid * trace(strain[p]) - points.excess_pressure(p);
            scale = std::max(scale, stress[p].norm());
          }
        largest_difference = 0.;
        for (unsigned int c = 0; c < points.n_cells(); ++c)
          {
            const auto [least, greatest] =
              std::minmax_element(mean.data() + points.first_point[c],
                                  mean.data() + points.first_point[c + 1]);
            if (points.first_point[c] < points.first_point[c + 1])
              largest_difference =
                std::max(largest_difference, *greatest - *least);
          }
        if (scale > 0.)
          largest_difference /= scale;
        if (!(largest_difference > rounding) || step == most_steps)
          return;
        for (unsigned int c = 0; c < points.n_cells(); ++c)
          shift(c);
        for (unsigned int p = 0; p < points.n_points(); ++p)
          strain[p] = given[p] + growth[p] * mean_direction();
      }
  }

  void
  CellPressures::equalise_rates(const unsigned int               cell,
                                const std::vector<MandelMatrix> &tangent,
                                std::vector<Mandel>             &rate)
  {
    const unsigned int begin = points.first_point[cell],
                       end   = points.first_point[cell + 1];
    for (unsigned int p = begin; p < end; ++p)
      {
        const double fluid = materials[points.material[p]].fluid_modulus();
        growth[p]          = 0.;
        k[p]               = modulus(p, tangent[p]) + fluid;
        mean[p] =
          mean_direction().dot(tangent[p] * rate[p]) + fluid * trace(rate[p]);
      }
    shift(cell);
    for (unsigned int p = begin; p < end; ++p)
      rate[p] += growth[p] * mean_direction();
  }

  void
  CellPressures::condense(const unsigned int         cell,
                          const double               factor,
                          std::vector<MandelMatrix> &C,
                          Condensed                 &result) const
  {
    const unsigned int first = points.first_point[cell];
    result.left.resize(C.size());
    result.right.resize(C.size());
    result.sum = 0.;
    for (unsigned int q = 0; q < C.size(); ++q)
      {
        const double weight  = factor * points.weight[first + q];
        const double inverse = 1. / modulus(first + q, C[q] / weight);
        const Mandel a       = C[q] * mean_direction(),
                     b       = C[q].transpose() * mean_direction();
        result.left[q]       = inverse * a;
        result.right[q]      = inverse * b;
        result.sum += weight * inverse;
        C[q] -= (inverse / weight) * a * b.transpose();
      }
  }
} // namespace geocone
