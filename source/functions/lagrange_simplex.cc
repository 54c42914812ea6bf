// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/functions/lagrange_simplex.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Product of (x - m)/(m + 1) over m < n, and its derivative by x. */
    std::array<double, 2>
    factor(const unsigned int n, const double x)
    {
      double value = 1., derivative = 0.;
      for (unsigned int m = 0; m < n; ++m)
        {
          derivative = (derivative * (x - m) + value) / (m + 1.);
          value *= (x - m) / (m + 1.);
        }
      return {{value, derivative}};
    }
  } // namespace

  LagrangeSimplex::LagrangeSimplex(const unsigned int degree)
    : k(degree)
  {
    Index      a      = {};
    const auto append = [&](const auto        &self,
                            const unsigned int i,
                            const unsigned int left) -> void {
      if (i == dim)
        {
          a[i] = left;
          all_nodes.push_back(a);
          return;
        }
      for (a[i] = 0; a[i] <= left; ++a[i])
        self(self, i + 1, left - a[i]);
      a[i] = 0;
    };
    append(append, 0, k);
    const auto corner_of = [&](const Index &node) {
      return std::find(node.begin(), node.end(), k) - node.begin();
    };
    std::stable_sort(
      all_nodes.begin(), all_nodes.end(), [&](const Index &b, const Index &c) {
        return corner_of(b) < corner_of(c);
      });
  }

  double
  LagrangeSimplex::value(const unsigned int node, const Barycentric &l) const
  {
    double product = 1.;
    for (unsigned int i = 0; i <= dim; ++i)
      product *= factor(all_nodes[node][i], k * l[i])[0];
    return product;
  }

  LagrangeSimplex::Barycentric
  LagrangeSimplex::derivatives(const unsigned int node,
                               const Barycentric &l) const
  {
    Barycentric all;
    for (unsigned int d = 0; d <= dim; ++d)
      {
        all[d] = k;
        for (unsigned int i = 0; i <= dim; ++i)
          all[d] *= factor(all_nodes[node][i], k * l[i])[i == d ? 1 : 0];
      }
    return all;
  }
} // namespace geocone::GEOCONE_DIM
