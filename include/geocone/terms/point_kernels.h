// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_point_kernels_h
#define geocone_terms_point_kernels_h

#include <geocone/base/types.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

/**
 * Kernels for strains, nodal forces and stiffness matrices, with the number n of
 * nodes per cell known at compile time.
 */
namespace geocone::kernels
{
  /** Number n^dim of nodes of a tensor-product cell with n nodes per direction. */
  template <int n>
  constexpr int power = dim == 2 ? n *n : n *n *n;

  /** Number of nodes of a simplex of polynomial degree p. */
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

  /** Calls f with the number of nodes of a cell as a compile-time constant. */
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

  /** Computes the strain rate B v of nodal velocities v, in Mandel notation. */
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
      e[index_of_normal[d]] = normal[d];
    for (int k = 0; k < n_shears; ++k)
      e[shears[k].place] = shear[k] / sqrt2;
    return e;
  }

  /** Adds the nodal forces B's of a stress s to the cell vector f. */
  template <int n>
  inline void
  add_force(const double *g, const Mandel &s, double *f)
  {
    // Stress tensor; its product with the gradient is the force.
    double t[dim][dim];
    for (unsigned int d = 0; d < dim; ++d)
      t[d][d] = s[index_of_normal[d]];
    for (int k = 0; k < n_shears; ++k)
      t[shears[k].first][shears[k].second] =
        t[shears[k].second][shears[k].first] = s[shears[k].place] / sqrt2;
    for (int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int c = 0; c < dim; ++c)
          f[dim * i + d] += g[n * ((d + c) % dim) + i] * t[d][(d + c) % dim];
  }

  /** Indices of the entries of a tensor in a Mandel vector. */
  struct PlacesOfTensor
  {
    constexpr PlacesOfTensor()
    {
      for (unsigned int d = 0; d < dim; ++d)
        of[d][d] = index_of_normal[d];
      for (int k = 0; k < n_shears; ++k)
        of[shears[k].first][shears[k].second] =
          of[shears[k].second][shears[k].first] = shears[k].place;
    }
    int of[dim][dim] = {};
  };
  constexpr PlacesOfTensor place;

  /** Calls f with each coordinate direction as a compile-time constant. */
  template <typename F>
  [[gnu::always_inline]] inline void
  for_each_direction(const F &f)
  {
    f(std::integral_constant<unsigned int, 0>());
    f(std::integral_constant<unsigned int, 1>());
    if constexpr (dim == 3)
      f(std::integral_constant<unsigned int, 2>());
  }

  /** Component d of the product of a symmetric tensor t and a shape function
   *  gradient g. The tensor is given by at(r), entry r of the Mandel vector,
   *  with shear entries divided by sqrt2; the components of g are n values
   *  apart. */
  template <int n, unsigned int d, typename F, std::size_t... k>
  [[gnu::always_inline]] inline auto
  along(const double *g, const F &at, std::index_sequence<k...>)
  {
    return (... + (g[n * ((d + k) % dim)] * at(place.of[d][(d + k) % dim])));
  }

  /** Number of columns of the stiffness matrix that are computed as one
   *  block. */
  constexpr int block = 4;

  /** Required length of the work array of stiffness(). */
  inline std::size_t
  scratch_size(const unsigned int n_points, const unsigned int n_nodes)
  {
    const std::size_t n_blocks = (dim * n_nodes + block - 1) / block;
    return n_points * n_mandel * n_blocks * block;
  }

  /**
   * Computes the stiffness matrix K = sum_q B_q' C_q B_q of a cell. K is stored
   * row by row with (dim n)^2 entries. The blocks, of a node's rows and a few
   * columns, are so small that the sums over the points stay in registers.
   * @tparam upper whether only the blocks of nodes i <= j are needed
   * @param g gradients of the points one after another, dim n each
   * @param C tangents times weights
   * @param scratch scratch_size() values
   */
  template <int n, bool upper>
  [[gnu::always_inline]] inline void
  stiffness_of_points(const double       *g,
                      const MandelMatrix *C,
                      const unsigned int  n_points,
                      double             *scratch,
                      double             *K)
  {
    constexpr int  m = dim * n, stride = (m + block - 1) / block * block;
    constexpr auto directions = std::make_index_sequence<dim>();
    // Rows of C B, those of shears over sqrt2, as required by B'.
    for (unsigned int q = 0; q < n_points; ++q)
      for (int r = 0; r < int(n_mandel); ++r)
        {
          double t[n_mandel], part = 1. / sqrt2;
          for (int k = 0; k < int(n_mandel); ++k)
            t[k] = C[q](r, k) / sqrt2;
          for (unsigned int d = 0; d < dim; ++d)
            {
              t[index_of_normal[d]] = C[q](r, index_of_normal[d]);
              if (r == index_of_normal[d])
                part = 1.;
            }
          const auto at = [&](const int k) __attribute__((always_inline))
          {
            return t[k];
          };
          double *row = scratch + (q * n_mandel + r) * stride;
          for (int j = 0; j < n; ++j)
            for_each_direction([&](
              const auto d) __attribute__((always_inline)) {
              row[dim * j + d] =
                part * along<n, d>(g + q * m + j, at, directions);
            });
        }
    using Pack [[gnu::vector_size(block * sizeof(double))]] = double;
    for (int first = 0; first < m; first += block)
      {
        const int last = std::min(first + block, m) - 1;
        const int end  = upper ? last / int(dim) + 1 : n;
        for (int i = 0; i < end; ++i)
          {
            Pack sum[dim] = {};
            for (unsigned int q = 0; q < n_points; ++q)
              {
                const auto at = [&](const int r) __attribute__((always_inline))
                {
                  Pack t;
                  std::memcpy(&t,
                              scratch + (q * n_mandel + r) * stride + first,
                              sizeof(Pack));
                  return t;
                };
                for_each_direction([&](
                  const auto d) __attribute__((always_inline)) {
                  sum[d] += along<n, d>(g + q * m + i, at, directions);
                });
              }
            for_each_direction([&](
              const auto d) __attribute__((always_inline)) {
              const Pack of_row = sum[d]; // so that sums need no address
              double    *to     = K + (dim * i + d) * m + first;
              if (first + block <= m)
                std::memcpy(to, &of_row, sizeof(Pack));
              else
                std::memcpy(to, &of_row, sizeof(double) * (m % block));
            });
          }
      }
  }

  /** Computes the difference between the B-bar gradients and the shape function
   *  gradients at a point. In axisymmetric problems the gradients include N/r.
   *  @param hoop N/r, or null */
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
   * Adds the contribution of the B-bar method to the stiffness matrix K of a cell.
   * With I the unit tensor and a from volumetric_change(), the strain matrix is B
   * + I a'/dim, so that with w = C I/dim
   *   K += sum_q a_q (C_q' I/dim)' B_q + (B_q' w_q) a_q'
   *          + (I' w_q/dim) a_q a_q'.
   * @param hoop N/r in axisymmetric problems, part of the volumetric strain; or
   * null
   * @param volumetric modified gradients, in the layout of g
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
    stiffness_of_points<n, upper>(g, C, n_points, scratch, K);
    if (volumetric != nullptr)
      add_volumetric_stiffness<n, upper>(g, hoop, volumetric, C, n_points, K);
  }

#if defined(__x86_64__)
  /** Variant of stiffness_body() compiled for AVX2 and FMA instructions. */
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

  /** Computes the in-plane stiffness matrix K of a cell by the fastest kernel for
   *  the processor.
   *  @param volumetric modified gradients of B-bar, or null */
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

  /** Copies the entries at the nodes of a cell from a global vector to a cell
   *  vector. */
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
