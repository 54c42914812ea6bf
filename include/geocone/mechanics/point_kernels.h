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
 * g holds grad N as n values d/dx, n values d/dy and so on; cell vectors are
 * interleaved (v_x, v_y, ... per node).
 */
namespace geocone::kernels
{
  /** n to the power of the dimension. */
  template <int n>
  constexpr int power = dim == 2 ? n *n : n *n *n;

  /** Those of simplices with the degree p. */
  template <int p>
  constexpr int simplex = dim == 2 ? (p + 1) * (p + 2) / 2
                                   : (p + 1) * (p + 2) * (p + 3) / 6;

  template <typename F>
  void
  with_n_nodes_of_simplex(const unsigned int n, const F &f)
  {
    switch (n)
      {
        case simplex<1>:
          return f(std::integral_constant<int, simplex<1>>());
        case simplex<2>:
          return f(std::integral_constant<int, simplex<2>>());
        case simplex<3>:
          return f(std::integral_constant<int, simplex<3>>());
        default:
          AssertThrow(false, dealii::ExcInternalError());
      }
  }

  /** Calls f with the number of nodes as a compile-time constant. */
  template <typename F>
  void
  with_n_nodes(const unsigned int n, const F &f)
  {
    switch (n)
      {
        case power<2>: // Q1
          return f(std::integral_constant<int, power<2>>());
        case power<3>: // Q2, B-spline 2
          return f(std::integral_constant<int, power<3>>());
        case power<4>: // Q3, B-spline 3
          return f(std::integral_constant<int, power<4>>());
        default:
          return with_n_nodes_of_simplex(n, f);
      }
  }

  /** B v: the Mandel strain rate of a cell vector v. */
  template <int n>
  inline Mandel
  strain(const double *g, const double *v)
  {
    double normal[dim] = {}, shear[n_shears] = {};
    for (int i = 0; i < n; ++i)
      {
        for (unsigned int d = 0; d < dim; ++d)
          normal[d] += g[n * d + i] * v[dim * i + d];
        for (int k = 0; k < n_shears; ++k)
          {
            const auto [place, a, b] = shears[k];
            shear[k] +=
              g[n * b + i] * v[dim * i + a] + g[n * a + i] * v[dim * i + b];
          }
      }
    Mandel e;
    for (unsigned int d = 0; d < dim; ++d)
      e[place_of_normal[d]] = normal[d];
    for (int k = 0; k < n_shears; ++k)
      e[shears[k].place] = shear[k] / sqrt2;
    return e;
  }

  /** f += B' s. */
  template <int n>
  inline void
  add_force(const double *g, const Mandel &s, double *f)
  {
    // The stress tensor; its rows along the gradient are the forces.
    double t[dim][dim];
    for (unsigned int d = 0; d < dim; ++d)
      t[d][d] = s[place_of_normal[d]];
    for (int k = 0; k < n_shears; ++k)
      t[shears[k].first][shears[k].second] =
        t[shears[k].second][shears[k].first] = s[shears[k].place] / sqrt2;
    for (int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int c = 0; c < dim; ++c)
          f[dim * i + d] += g[n * ((d + c) % dim) + i] * t[d][(d + c) % dim];
  }

  /**
   * K = sum_q B_q' C_q B_q of a cell, row-major (dim n)^2. In the plane K is computed
   * in small blocks of nodes whose sums over the points stay in registers.
   * @tparam upper whether only the blocks of nodes i <= j are needed
   * @param g gradients of the points one after another, dim n each
   * @param C tangents times weights
   * @param scratch at least n_points x n_mandel x dim n values
   */
  template <int n, bool upper>
  [[gnu::always_inline]] inline void
  stiffness_of_plane(const double       *g,
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

  /** The same in three dimensions. */
  template <int n, bool upper>
  [[gnu::always_inline]] inline void
  stiffness_of_space(const double       *g,
                     const MandelMatrix *C,
                     const unsigned int  n_points,
                     double             *scratch,
                     double             *K)
  {
    constexpr int m = dim * n;
    std::memset(K, 0, sizeof(double) * m * m);
    for (unsigned int q = 0; q < n_points; ++q, g += m)
      {
        // C B by rows, those of shears over sqrt2, for B' picks them so.
        for (int r = 0; r < n_mandel; ++r)
          {
            double *const row = scratch + r * m;
            const double  s   = r == 2 || r > 3 ? 1. / sqrt2 : 1.;
            // As a stress tensor, so that a column is its row along the gradient.
            double t[dim][dim] = {};
            for (unsigned int d = 0; d < dim; ++d)
              t[d][d] = s * C[q](r, place_of_normal[d]);
            for (int k = 0; k < n_shears; ++k)
              t[shears[k].first][shears[k].second] =
                t[shears[k].second][shears[k].first] =
                  s * C[q](r, shears[k].place) / sqrt2;
            for (int j = 0; j < n; ++j)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double sum = 0.;
                  for (unsigned int c = 0; c < dim; ++c)
                    sum += t[d][c] * g[n * c + j];
                  row[dim * j + d] = sum;
                }
          }
        for (int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            {
              // Of the rows of C B those in which this function has a strain.
              const double *of[dim];
              of[d] = scratch + place_of_normal[d] * m;
              for (int k = 0; k < n_shears; ++k)
                if (static_cast<int>(d) == shears[k].first)
                  of[shears[k].second] = scratch + shears[k].place * m;
                else if (static_cast<int>(d) == shears[k].second)
                  of[shears[k].first] = scratch + shears[k].place * m;
              double *const row = K + (dim * i + d) * m;
              double        slope[dim];
              for (unsigned int c = 0; c < dim; ++c)
                slope[c] = g[n * c + i];
              for (int j = upper ? dim * i : 0; j < m; ++j)
                {
                  double sum = row[j];
                  for (unsigned int c = 0; c < dim; ++c)
                    sum += slope[c] * of[c][j];
                  row[j] = sum;
                }
            }
      }
  }

  /** a = other gradients of the volumetric strain (B-bar) less those of a point, which
   *  around an axis has N/r, too. @param hoop N/r, or null */
  template <int n>
  inline void
  volumetric_change(const double *g,
                    const double *hoop,
                    const double *volumetric,
                    double       *a)
  {
    for (int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        a[dim * i + d] = volumetric[n * d + i] - g[n * d + i];
    if (hoop != nullptr)
      for (int i = 0; i < n; ++i)
        a[dim * i] -= hoop[i];
  }

  /**
   * What other gradients of the volumetric strain change of K (B-bar). With I the unit
   * tensor the strain is B + I a'/dim, a their volumetric_change(), so that with
   * w = C I/dim
   * K += sum_q a_q (C_q' I/dim)' B_q + (B_q' w_q) a_q' + (I' w_q/dim) a_q a_q'.
   * @param hoop N/r around an axis, which the volumetric strain has, too; or null
   * @param volumetric those gradients, laid out as g
   */
  template <int n, bool upper>
  [[gnu::always_inline]] inline void
  add_volumetric_stiffness(const double       *g,
                           const double       *hoop,
                           const double       *volumetric,
                           const MandelMatrix *C,
                           const unsigned int  n_points,
                           double             *K)
  {
    constexpr int m = dim * n;
    const Mandel  I = unit_tensor<n_mandel>() / dim;
    for (unsigned int q = 0; q < n_points; ++q, g += m, volumetric += m)
      {
        const Mandel w = C[q] * I;
        double       a[m], left[m] = {}, right[m] = {};
        volumetric_change<n>(
          g, hoop == nullptr ? hoop : hoop + n * q, volumetric, a);
        add_force<n>(g, w, left);
        add_force<n>(g, C[q].transpose() * I, right);
        const double square = I.dot(w);
        for (int j = 0; j < m; ++j)
          right[j] += square * a[j];
        for (int i = 0; i < m; ++i)
          for (int j = upper ? i - i % int(dim) : 0; j < m; ++j)
            K[i * m + j] += a[i] * right[j] + left[i] * a[j];
      }
  }

  template <int n, bool upper>
  [[gnu::always_inline]] inline void
  stiffness_body(const double       *g,
                 const double       *hoop,
                 const double       *volumetric,
                 const MandelMatrix *C,
                 const unsigned int  n_points,
                 double             *scratch,
                 double             *K)
  {
    if constexpr (dim == 2)
      stiffness_of_plane<n, upper>(g, C, n_points, scratch, K);
    else
      stiffness_of_space<n, upper>(g, C, n_points, scratch, K);
    if (volumetric != nullptr)
      add_volumetric_stiffness<n, upper>(g, hoop, volumetric, C, n_points, K);
  }

#if defined(__x86_64__)
  /** The same for processors with AVX2 and fused multiply-add. */
  template <int n, bool upper>
  [[gnu::target("avx2,fma")]] void
  stiffness_avx2(const double       *g,
                 const double       *hoop,
                 const double       *volumetric,
                 const MandelMatrix *C,
                 const unsigned int  n_points,
                 double             *scratch,
                 double             *K)
  {
    stiffness_body<n, upper>(g, hoop, volumetric, C, n_points, scratch, K);
  }
#endif

  /** K by the fastest variant that the processor has, without what is out of the plane.
   *  @param volumetric those of B-bar, or null */
  template <int n, bool upper>
  void
  stiffness(const double       *g,
            const double       *hoop,
            const double       *volumetric,
            const MandelMatrix *C,
            const unsigned int  n_points,
            double             *scratch,
            double             *K)
  {
#if defined(__x86_64__)
    static const bool avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2)
      return stiffness_avx2<n, upper>(
        g, hoop, volumetric, C, n_points, scratch, K);
#endif
    stiffness_body<n, upper>(g, hoop, volumetric, C, n_points, scratch, K);
  }

  /** Copies the entries of a cell's nodes between a cell vector and a vector. */
  template <int n>
  inline void
  gather(const double *vector, const unsigned int *nodes, double *cell)
  {
    for (int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        cell[dim * i + d] = vector[dim * nodes[i] + d];
  }

  template <int n>
  inline void
  scatter_add(const double *cell, const unsigned int *nodes, double *vector)
  {
    for (int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        vector[dim * nodes[i] + d] += cell[dim * i + d];
  }
} // namespace geocone::kernels

#endif
