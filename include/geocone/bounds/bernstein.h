// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_bernstein_h
#define geocone_bounds_bernstein_h

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

/** Polynomials in the Bernstein basis on a simplex with n vertices. The function with the
 *  exponents a of the barycentric coordinates l is |a|!/a! l^a; a polynomial is in the
 *  convex hull of its coefficients. */
namespace geocone::bernstein
{
  template <std::size_t n>
  using Exponents = std::array<unsigned int, n>;

  /** Values of a linear function at the vertices. */
  template <std::size_t n>
  using Linear = std::array<double, n>;

  /** Returns exponents with one of them raised by 1. */
  template <std::size_t n>
  Exponents<n>
  raised(Exponents<n> a, const unsigned int i)
  {
    ++a[i];
    return a;
  }

  /** Returns exponents with one of them lowered by 1. */
  template <std::size_t n>
  Exponents<n>
  lowered(Exponents<n> a, const unsigned int i)
  {
    --a[i];
    return a;
  }

  template <std::size_t n>
  unsigned int
  order_of(const Exponents<n> &a)
  {
    return std::accumulate(a.begin(), a.end(), 0U);
  }

  /** Returns the mean over the simplex of a Bernstein function. */
  template <std::size_t n>
  double
  mean(const Exponents<n> &a)
  {
    double value = 1.;
    for (unsigned int i = 1; i < n; ++i)
      value *= double(i) / (order_of(a) + i);
    return value;
  }

  /** Returns the mean over the simplex of a Bernstein function times linear
   *  functions. */
  template <std::size_t n, typename... More>
  double
  mean(const Exponents<n> &a, const Linear<n> &f, const More &...more)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      if (f[i] != 0.)
        sum +=
          f[i] * (a[i] + 1.) / (order_of(a) + 1.) * mean(raised(a, i), more...);
    return sum;
  }

  /** Returns a coefficient of a linear function in the basis of a higher order. */
  template <std::size_t n>
  double
  coefficient(const Exponents<n> &a, const Linear<n> &f)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sum += f[i] * a[i] / order_of(a);
    return sum;
  }

  /** Returns a coefficient of the product of two linear functions in the basis of the
   *  order 2. */
  template <std::size_t n>
  double
  coefficient(const Exponents<n> &a, const Linear<n> &f, const Linear<n> &g)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        sum += f[i] * g[j] * a[i] * (i == j ? a[i] - 1. : a[j]) / 2.;
    return sum;
  }

  /** Returns the mean over the simplex of the product of two Bernstein functions and
   *  linear functions. */
  template <std::size_t n, typename... More>
  double
  mean_of_product(Exponents<n> a, const Exponents<n> &b, const More &...more)
  {
    double       factor = 1.;
    unsigned int n_both = 0, n_b = 0;
    // The product is a multiple of the function with the sum of the exponents.
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 1; k <= b[i]; ++k)
        factor *= (a[i] + double(k)) / k;
    n_both = order_of(a) + order_of(b);
    for (n_b = order_of(b); n_b > 0; --n_b, --n_both)
      factor *= double(n_b) / n_both;
    for (unsigned int i = 0; i < n; ++i)
      a[i] += b[i];
    return factor * mean(a, more...);
  }

  constexpr unsigned int
  n_in_triangle(const unsigned int order)
  {
    return (order + 1) * (order + 2) / 2;
  }

  /** Returns the position of a function of a triangle in functions_of_triangle(). */
  inline unsigned int
  position(const Exponents<3> &a)
  {
    return a[2] * (order_of(a) + 1) - a[2] * (a[2] + 1) / 2 + a[2] + a[1];
  }

  /** Returns all functions of an order on a triangle. */
  inline std::vector<Exponents<3>>
  functions_of_triangle(const unsigned int order)
  {
    std::vector<Exponents<3>> all;
    for (unsigned int k = 0; k <= order; ++k)
      for (unsigned int j = 0; j + k <= order; ++j)
        all.push_back({{order - j - k, j, k}});
    return all;
  }

  /** Returns the function k of an edge between the vertices a and b of a triangle, from
   *  a to b. */
  inline Exponents<3>
  on_edge(const unsigned int order,
          const unsigned int a,
          const unsigned int b,
          const unsigned int k)
  {
    Exponents<3> exponents = {{0, 0, 0}};
    exponents[a]           = order - k;
    exponents[b]           = k;
    return exponents;
  }
} // namespace geocone::bernstein

#endif
