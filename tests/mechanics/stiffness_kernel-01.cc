// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The stiffness of a cell, K = sum of B'C B over its points, must be what strains of unit
// vectors make of tangents that are not symmetric, for each number of nodes that there is:
// whole, and the blocks on and above its diagonal.

#include <geocone/terms/point_kernels.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace mechanics_stiffness_kernel_01
{
  using namespace geocone;

  /** Numbers without a pattern. */
  double
  some(const unsigned int i)
  {
    return std::sin(12.9898 * i + 0.3) * std::cos(4.1414 * i);
  }

  template <int n>
  void
  check(const unsigned int n_points)
  {
    constexpr unsigned int    m = dim * n;
    std::vector<double>       g(n_points * m);
    std::vector<MandelMatrix> C(n_points);
    for (unsigned int i = 0; i < g.size(); ++i)
      g[i] = some(i);
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int i = 0; i < C[q].size(); ++i)
        C[q].data()[i] = some(1000 + q * C[q].size() + i);

    std::vector<double> expected(m * m, 0.);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        std::vector<Mandel> B;
        for (unsigned int i = 0; i < m; ++i)
          {
            std::vector<double> unit(m, 0.);
            unit[i] = 1.;
            B.push_back(kernels::strain<n>(&g[q * m], unit.data()));
          }
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < m; ++j)
            expected[i * m + j] += B[i].dot(C[q] * B[j]);
      }

    std::vector<double> scratch(kernels::scratch_size(n_points, n));
    std::vector<double> whole(m * m), upper(m * m);
    kernels::stiffness<n, false>(g.data(),
                                 nullptr,
                                 nullptr,
                                 C.data(),
                                 n_points,
                                 scratch.data(),
                                 whole.data());
    kernels::stiffness<n, true>(g.data(),
                                nullptr,
                                nullptr,
                                C.data(),
                                n_points,
                                scratch.data(),
                                upper.data());
    double difference = 0., of_upper = 0.;
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        {
          const unsigned int k = i * m + j;
          difference = std::max(difference, std::abs(whole[k] - expected[k]));
          if (i / dim <= j / dim)
            of_upper = std::max(of_upper, std::abs(upper[k] - expected[k]));
        }
    std::cout << n << " nodes, " << n_points << " points:"
              << (difference < 1e-13 * n_points ? " whole as expected"
                                                : " whole WRONG")
              << (of_upper < 1e-13 * n_points ? ", upper as expected"
                                              : ", upper WRONG")
              << std::endl;
  }

  void
  test()
  {
    using namespace kernels;
    for (const unsigned int n_points : {1, 7})
      {
        check<simplex<1>>(n_points);
        check<simplex<2>>(n_points);
        check<simplex<3>>(n_points);
        check<power<2>>(n_points);
        check<power<3>>(n_points);
        check<power<4>>(n_points);
      }
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_stiffness_kernel_01
