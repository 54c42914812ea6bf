// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_point_kernels_h
#define geocone_mechanics_point_kernels_h

#include <geocone/base/types.h>

#include <deal.II/base/exceptions.h>

#include <cstring>
#include <type_traits>
#include <vector>

/**
 * What is done at each point, for a number n of nodes that the compiler knows:
 * g holds grad N as n values d/dx and n values d/dy; cell vectors are
 * interleaved (v_x, v_y per node).
 */
namespace geocone::kernels
{
  /** Calls f with the number of nodes as a compile-time constant. */
  template <typename F>
  void
  with_n_nodes(const unsigned int n, const F &f)
  {
    switch (n)
      {
        case 3: // P1
          return f(std::integral_constant<int, 3>());
        case 4: // Q1
          return f(std::integral_constant<int, 4>());
        case 6: // P2
          return f(std::integral_constant<int, 6>());
        case 9: // Q2, B-spline 2
          return f(std::integral_constant<int, 9>());
        case 10: // P3
          return f(std::integral_constant<int, 10>());
        case 16: // Q3, B-spline 3
          return f(std::integral_constant<int, 16>());
        default:
          AssertThrow(false, dealii::ExcInternalError());
      }
  }

  /** B v: the Mandel strain rate of a cell vector v. */
  template <int n>
  inline Mandel
  strain(const double *g, const double *v)
  {
    double xx = 0., yy = 0., xy = 0.;
    for (int i = 0; i < n; ++i)
      {
        xx += g[i] * v[2 * i];
        yy += g[n + i] * v[2 * i + 1];
        xy += g[n + i] * v[2 * i] + g[i] * v[2 * i + 1];
      }
    return {xx, yy, xy / sqrt2};
  }

  /** f += B' s. */
  template <int n>
  inline void
  add_force(const double *g, const Mandel &s, double *f)
  {
    const double xy = s[2] / sqrt2;
    for (int i = 0; i < n; ++i)
      {
        f[2 * i] += g[i] * s[0] + g[n + i] * xy;
        f[2 * i + 1] += g[n + i] * s[1] + g[i] * xy;
      }
  }

  /**
   * K = sum_q B_q' C_q B_q of a cell, row-major (2n)^2. K is computed in small
   * blocks of nodes whose sums over the points stay in registers.
   * @tparam upper whether only the blocks of nodes i <= j are needed
   * @param g gradients of the points one after another, 2n each
   * @param C tangents times weights
   * @param scratch at least n_points x 3 x 2n values
   */
  template <int n, bool upper>
  [[gnu::always_inline]] inline void
  stiffness_body(const double       *g,
                 const MandelMatrix *C,
                 const unsigned int  n_points,
                 double             *scratch,
                 double             *K)
  {
    constexpr int m = 2 * n;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const double *gx = g + q * m, *gy = gx + n;
        for (int r = 0; r < 3; ++r)
          {
            double      *row = scratch + (3 * q + r) * m;
            const double c0 = C[q](r, 0), c1 = C[q](r, 1),
                         c2 = C[q](r, 2) / sqrt2;
            // Row r of C B; rows 0, 1 of B' pick it as it is, row 2 by 1/sqrt2.
            const double s = r == 2 ? 1. / sqrt2 : 1.;
            for (int j = 0; j < n; ++j)
              {
                row[2 * j]     = s * (c0 * gx[j] + c2 * gy[j]);
                row[2 * j + 1] = s * (c1 * gy[j] + c2 * gx[j]);
              }
          }
      }
    constexpr int block = n % 2 == 0 ? 4 : 2; // columns, of two nodes or one
    using Pack [[gnu::vector_size(block * sizeof(double))]] = double;
    for (int i = 0; i < n; ++i)
      for (int first = upper ? 2 * i / block * block : 0; first < m;
           first += block)
        {
          Pack x = {}, y = {}, row0, row1, row2;
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const double  gx = g[q * m + i], gy = g[q * m + n + i];
              const double *row = scratch + 3 * q * m + first;
              std::memcpy(&row0, row, sizeof(Pack));
              std::memcpy(&row1, row + m, sizeof(Pack));
              std::memcpy(&row2, row + 2 * m, sizeof(Pack));
              x += gx * row0 + gy * row2;
              y += gy * row1 + gx * row2;
            }
          std::memcpy(K + 2 * i * m + first, &x, sizeof(Pack));
          std::memcpy(K + (2 * i + 1) * m + first, &y, sizeof(Pack));
        }
  }

#if defined(__x86_64__)
  /** The same for processors with AVX2 and fused multiply-add. */
  template <int n, bool upper>
  [[gnu::target("avx2,fma")]] void
  stiffness_avx2(const double       *g,
                 const MandelMatrix *C,
                 const unsigned int  n_points,
                 double             *scratch,
                 double             *K)
  {
    stiffness_body<n, upper>(g, C, n_points, scratch, K);
  }
#endif

  /** K by the fastest variant that the processor has. */
  template <int n, bool upper>
  void
  stiffness(const double       *g,
            const MandelMatrix *C,
            const unsigned int  n_points,
            double             *scratch,
            double             *K)
  {
#if defined(__x86_64__)
    static const bool avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2)
      return stiffness_avx2<n, upper>(g, C, n_points, scratch, K);
#endif
    stiffness_body<n, upper>(g, C, n_points, scratch, K);
  }

  /**
   * K = sum_q B_q' C_q B_q with the volumetric part of B from the mean gradients
   * of the cell (B-bar); as stiffness(), all entries.
   * @param mean mean gradients, 2n values
   */
  template <int n>
  void
  stiffness_b_bar(const double       *g,
                  const double       *mean,
                  const MandelMatrix *C,
                  const unsigned int  n_points,
                  double             *K)
  {
    Eigen::Map<Eigen::Matrix<double, 2 * n, 2 * n, Eigen::RowMajor>> stiffness(
      K);
    Eigen::Matrix<double, 3, 2 * n> B;
    stiffness.setZero();
    for (unsigned int q = 0; q < n_points; ++q, g += 2 * n)
      {
        for (int i = 0; i < n; ++i)
          {
            const double gx = g[i], gy = g[n + i];
            const double dx = (mean[i] - gx) / 2., dy = (mean[n + i] - gy) / 2.;
            B.col(2 * i) << gx + dx, dx, gy / sqrt2;
            B.col(2 * i + 1) << dy, gy + dy, gx / sqrt2;
          }
        stiffness.noalias() += B.transpose() * (C[q] * B);
      }
  }

  /** Copies the entries of a cell's nodes between a cell vector and a vector. */
  template <int n>
  inline void
  gather(const double *vector, const unsigned int *nodes, double *cell)
  {
    for (int i = 0; i < n; ++i)
      {
        cell[2 * i]     = vector[2 * nodes[i]];
        cell[2 * i + 1] = vector[2 * nodes[i] + 1];
      }
  }

  template <int n>
  inline void
  scatter_add(const double *cell, const unsigned int *nodes, double *vector)
  {
    for (int i = 0; i < n; ++i)
      {
        vector[2 * nodes[i]] += cell[2 * i];
        vector[2 * nodes[i] + 1] += cell[2 * i + 1];
      }
  }
} // namespace geocone::kernels

#endif
