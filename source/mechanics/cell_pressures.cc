// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/point_elasticity.h>
#include <geocone/mechanics/cell_pressures.h>

#include <algorithm>
#include <limits>
#include <numeric>

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

  bool
  CellPressures::are_those_of(const MaterialPoints &points,
                              const Materials      &materials)
  {
    return points.volumetric_degree == 0 && materials.dilate();
  }

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
        const Elasticity elastic = elasticity_at_start(materials, points, p);
        least_modulus[p] = softest * (elastic.lambda + elastic.two_G / dim);
      }
  }

  double
  CellPressures::pore_pressure(const unsigned int point) const
  {
    return materials.are_undrained() ? points.excess_pressure(point) : 0.;
  }

  void
  CellPressures::evaluate(const unsigned int  point,
                          const double        mean_stress,
                          const MandelMatrix &tangent,
                          const Mandel       &strain)
  {
    const double fluid = materials[points.material[point]].fluid_modulus();
    mean[point]        = mean_stress + fluid * trace(strain);
    k[point] = std::max(mean_direction().dot(tangent * mean_direction()),
                        least_modulus[point]) +
               fluid;
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
  CellPressures::equalise(
    const std::function<void(const unsigned int, const unsigned int)> &update,
    const std::vector<Mandel>                                         &stress,
    const std::vector<MandelMatrix>                                   &tangent,
    std::vector<Mandel>                                               &strain)
  {
    given = strain;
    std::fill(growth.begin(), growth.end(), 0.);
    difference_in.assign(points.n_cells(), 0.);
    unequal.resize(points.n_cells());
    std::iota(unequal.begin(), unequal.end(), 0);
    double scale = 0.;
    for (unsigned int step = 0; !unequal.empty(); ++step)
      {
        // Cells in a row are asked at once.
        for (auto cell = unequal.begin(); cell != unequal.end();)
          {
            const unsigned int first = *cell;
            unsigned int       next  = first;
            for (; cell != unequal.end() && *cell == next; ++cell)
              ++next;
            update(points.first_point[first], points.first_point[next]);
          }
        for (const unsigned int c : unequal)
          {
            double least    = std::numeric_limits<double>::max();
            double greatest = std::numeric_limits<double>::lowest();
            for (unsigned int p = points.first_point[c];
                 p < points.first_point[c + 1];
                 ++p)
              {
                evaluate(p,
                         trace(stress[p]) / dim - pore_pressure(p),
                         tangent[p],
                         strain[p]);
                least    = std::min(least, mean[p]);
                greatest = std::max(greatest, mean[p]);
                scale    = std::max(scale, stress[p].norm());
              }
            difference_in[c] = std::max(greatest - least, 0.);
          }
        if (step == most_steps)
          break;
        unequal.erase(std::remove_if(unequal.begin(),
                                     unequal.end(),
                                     [&](const unsigned int c) {
                                       return !(difference_in[c] >
                                                rounding * scale);
                                     }),
                      unequal.end());
        for (const unsigned int c : unequal)
          {
            shift(c);
            for (unsigned int p = points.first_point[c];
                 p < points.first_point[c + 1];
                 ++p)
              strain[p] = given[p] + growth[p] * mean_direction();
          }
      }
    largest_difference =
      scale > 0.
        ? *std::max_element(difference_in.begin(), difference_in.end()) / scale
        : 0.;
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
        growth[p] = 0.;
        evaluate(
          p, mean_direction().dot(tangent[p] * rate[p]), tangent[p], rate[p]);
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
        const Mandel a       = C[q] * mean_direction(),
                     b       = C[q].transpose() * mean_direction();
        const double inverse = 1. / std::max(mean_direction().dot(a) / weight,
                                             least_modulus[first + q]);
        result.left[q]       = inverse * a;
        result.right[q]      = inverse * b;
        result.sum += weight * inverse;
        C[q] -= (inverse / weight) * a * b.transpose();
      }
  }
} // namespace geocone
