// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/solid_bounds/solid_gap.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    /** Exponents of the barycentric coordinates in a Bernstein function. */
    using Exponents = std::array<unsigned int, 4>;

    /** @param order 0 to 2 @param edges the vertices of the nodes after the vertices */
    Exponents
    exponents_of(const unsigned int order,
                 const unsigned int node,
                 const unsigned int n_vertices,
                 const unsigned int (*const edges)[2])
    {
      Exponents a = {{0, 0, 0, 0}};
      if (order > 0 && node < n_vertices)
        a[node] = order;
      else if (order > 0)
        for (unsigned int i = 0; i < 2; ++i)
          a[edges[node - n_vertices][i]] = 1;
      return a;
    }

    double
    factorial(const unsigned int n)
    {
      return n < 2 ? 1. : n * factorial(n - 1);
    }

    /** Mean of the product of two Bernstein functions over a simplex. */
    double
    mean_of_product(const Exponents   &a,
                    const Exponents   &b,
                    const unsigned int dimension)
    {
      double       mean  = factorial(dimension);
      unsigned int sum_a = 0, sum_b = 0;
      for (unsigned int i = 0; i < 4; ++i)
        {
          mean *= factorial(a[i] + b[i]) / (factorial(a[i]) * factorial(b[i]));
          sum_a += a[i];
          sum_b += b[i];
        }
      return mean * factorial(sum_a) * factorial(sum_b) /
             factorial(dimension + sum_a + sum_b);
    }

    /** Those means of all nodes of two orders, on a cell or a facet. */
    std::vector<std::vector<double>>
    means_of_products(const unsigned int order_a,
                      const unsigned int n_a,
                      const unsigned int order_b,
                      const unsigned int n_b,
                      const unsigned int n_vertices,
                      const unsigned int (*const edges)[2])
    {
      std::vector<std::vector<double>> all(n_a);
      for (unsigned int i = 0; i < n_a; ++i)
        for (unsigned int j = 0; j < n_b; ++j)
          all[i].push_back(
            mean_of_product(exponents_of(order_a, i, n_vertices, edges),
                            exponents_of(order_b, j, n_vertices, edges),
                            n_vertices - 1));
      return all;
    }

    /** s.(b x g), s symmetric. */
    double
    power_of(const Mandel &s, const Tensor<1, dim> &b, const Tensor<1, dim> &g)
    {
      double power = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          power +=
            s[index_of_component[i][j]] / (i == j ? 1. : sqrt2) * b[i] * g[j];
      return power;
    }
  } // namespace

  std::vector<double>
  gap_of_cells(const SolidScene  &bound,
               const unsigned int order_upper,
               const unsigned int order_lower,
               const SolidBound  &upper,
               const SolidBound  &lower)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const double       L          = bound.units.length;
    const unsigned int n_v        = simplex_nodes::n_in_cell(order_upper),
                       n_s        = simplex_nodes::n_in_cell(order_lower),
                       n_rates    = order_upper == 1 ? 1 : 4,
                       n_u        = simplex_nodes::n_on_facet(order_upper),
                       n_t        = simplex_nodes::n_on_facet(order_lower);
    const auto in_cell            = means_of_products(
      order_lower, n_s, order_upper - 1, n_rates, 4, simplex_nodes::edges);
    const auto on_facet = means_of_products(
      order_lower, n_t, order_upper, n_u, 3, simplex_nodes::edges_of_facet);

    std::vector<double> gap = upper.dissipation_of_cell;
    for (unsigned int c = 0; c < gap.size(); ++c)
      {
        const auto   g = tetrahedra.gradients(c);
        const double V = tetrahedra.volume(c) / (L * L * L);
        for (unsigned int j = 0; j < n_rates; ++j)
          {
            Mandel s = Mandel::Zero(); // weighted by the function of the rate
            for (unsigned int i = 0; i < n_s; ++i)
              s += in_cell[i][j] * lower.stress[n_s * c + i];
            for (unsigned int l = 0; l < 4; ++l)
              gap[c] -=
                V * power_of(
                      s,
                      upper.velocity[n_v * c + (order_upper == 1
                                                  ? l
                                                  : simplex_nodes::node(j, l))],
                      order_upper * L * g[l]);
          }
      }
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        const auto           &cells    = tetrahedra.facets[f].cells;
        const FacetCondition &held     = bound.facet_conditions[f];
        const bool            is_inner = cells[1] != Tetrahedra::none;
        if (!is_inner && held.kind == FacetCondition::Kind::free)
          continue;
        const double         A = tetrahedra.area(f) / (L * L);
        const Tensor<1, dim> n = tetrahedra.normal(f);
        const auto of_stress   = nodes_in_cell(tetrahedra, order_lower, f, 0),
                   first       = nodes_in_cell(tetrahedra, order_upper, f, 0);
        std::vector<unsigned int> second;
        if (is_inner)
          second = nodes_in_cell(tetrahedra, order_upper, f, 1);
        double part = upper.dissipation_of_facet[f];
        for (unsigned int j = 0; j < n_u; ++j)
          {
            Tensor<1, dim> u =
              (is_inner ? upper.velocity[n_v * cells[1] + second[j]]
                        : held.velocity) -
              upper.velocity[n_v * cells[0] + first[j]];
            if (held.kind == FacetCondition::Kind::plane)
              u = (u * n) * n; // tractions along it are given
            Mandel s = Mandel::Zero();
            for (unsigned int i = 0; i < n_t; ++i)
              s += on_facet[i][j] * lower.stress[n_s * cells[0] + of_stress[i]];
            part -= A * power_of(s, u, n);
          }
        for (const unsigned int c : cells)
          if (c != Tetrahedra::none)
            gap[c] += is_inner ? part / 2. : part;
      }
    return gap;
  }

  std::vector<double>
  dissipation_around_cells(const Tetrahedra &tetrahedra,
                           const SolidBound &upper)
  {
    std::vector<double> all = upper.dissipation_of_cell;
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        const auto &cells    = tetrahedra.facets[f].cells;
        const bool  is_inner = cells[1] != Tetrahedra::none;
        for (const unsigned int c : cells)
          if (c != Tetrahedra::none)
            all[c] += upper.dissipation_of_facet[f] / (is_inner ? 2. : 1.);
      }
    return all;
  }

  std::vector<double>
  error_of_cells(const Tetrahedra          &tetrahedra,
                 const std::vector<double> &gap,
                 const SolidBound          &upper,
                 const SolidBound          &lower)
  {
    const auto sum_of = [](const std::vector<double> &all) {
      return std::accumulate(all.begin(), all.end(), 0.);
    };
    const std::vector<double> above =
      dissipation_around_cells(tetrahedra, upper);
    std::vector<double> below = lower.dual_power, error = gap;
    for (double &one : below)
      one = std::max(one, 0.);
    const double of_upper = sum_of(above), of_lower = sum_of(below);
    if (!(of_upper > 0. && of_lower > 0.)) // e.g. soil without cohesion
      return error;
    // Shares of the lower bound at the vertices, and their excess.
    std::vector<double> share(tetrahedra.vertices.size(), 0.), excess = share;
    for (unsigned int c = 0; c < gap.size(); ++c)
      for (const unsigned int v : tetrahedra.cells[c])
        {
          share[v] += below[c] / of_lower;
          excess[v] += below[c] / of_lower - above[c] / of_upper;
        }
    const double whole = sum_of(gap);
    for (unsigned int c = 0; c < gap.size(); ++c)
      for (const unsigned int v : tetrahedra.cells[c])
        if (excess[v] > 0.)
          error[c] += whole / 4. * excess[v] * below[c] / of_lower / share[v];
    return error;
  }
} // namespace geocone::GEOCONE_DIM
