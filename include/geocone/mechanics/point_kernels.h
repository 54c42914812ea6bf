// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_point_kernels_h
#define geocone_mechanics_point_kernels_h

#include <geocone/base/types.h>

#include <deal.II/base/exceptions.h>

#include <array>
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
        case 9: // Q2
          return f(std::integral_constant<int, 9>());
        case 10: // P3
          return f(std::integral_constant<int, 10>());
        case 16: // Q3
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
  inline void
  stiffness(const double       *g,
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
    for (int i = 0; i < n; ++i)
      for (int first = upper ? 2 * i / block * block : 0; first < m;
           first += block)
        {
          double x[block] = {}, y[block] = {};
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const double  gx = g[q * m + i], gy = g[q * m + n + i];
              const double *row0 = scratch + 3 * q * m + first;
              const double *row1 = row0 + m, *row2 = row1 + m;
              for (int j = 0; j < block; ++j)
                {
                  x[j] += gx * row0[j] + gy * row2[j];
                  y[j] += gy * row1[j] + gx * row2[j];
                }
            }
          for (int j = 0; j < block; ++j)
            {
              K[2 * i * m + first + j]       = x[j];
              K[(2 * i + 1) * m + first + j] = y[j];
            }
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
