// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_space_spline_basis_h
#define geocone_space_spline_basis_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Maximum polynomial degree of shape functions. */
  constexpr unsigned int max_degree = 3;

  /**
   * Univariate B-splines of degree p and continuity p - 1 on n intervals of
   * arbitrary length. The knots are clamped: the first and last knots are
   * repeated p + 1 times. Of the n + p basis functions, i, ..., i + p are
   * non-zero on interval i. The basis functions are non-negative and a
   * partition of unity; x is reproduced with the Greville abscissae as
   * coefficients. At each end only the first (last) basis function is non-zero.
   */
  class SplineBasis
  {
  public:
    /** Constructs the basis. @param breaks interval boundaries, increasing (m) */
    SplineBasis(const unsigned int degree, const std::vector<double> &breaks);

    unsigned int
    n_functions() const
    {
      return knots.size() - p - 1;
    }

    /** Returns the Greville abscissa of a basis function (m): the mean of its p
     *  inner knots. */
    double
    greville(const unsigned int function) const;

    /** Returns the integral of a basis function over all intervals (m). */
    double
    integral(const unsigned int function) const
    {
      return (knots[function + p + 1] - knots[function]) / (p + 1);
    }

    /**
     * Evaluates the p + 1 basis functions that are non-zero on an interval, and
     * their derivatives.
     * @param xi local coordinate in the interval, 0 to 1
     * @param[out] N values
     * @param[out] dN derivatives with respect to xi
     */
    void
    evaluate(const unsigned int interval,
             const double       xi,
             double            *N,
             double            *dN) const;

  private:
    const unsigned int  p;
    std::vector<double> knots;
  };

  /**
   * Evaluates the Bernstein polynomials of degree p and their derivatives at xi
   * in [0, 1]. They span the same space as the Lagrange polynomials, but are
   * non-negative.
   */
  void
  bernstein(const unsigned int p, const double xi, double *N, double *dN);

  /**
   * Evaluates the Bernstein polynomials of degree p on the unit triangle.
   * With the area coordinates l = (1 - x - y, x, y) they are
   *   B_ab = p!/((p - a - b)! a! b!) l_0^(p - a - b) l_1^a l_2^b.
   * @param lattice exponents (a, b) of each polynomial
   * @param[out] N values
   * @param[out] gradient gradients with respect to (x, y); can be null
   */
  void
  bernstein_on_simplex(
    const unsigned int                                p,
    const dealii::Point<dim>                         &x,
    const std::vector<std::array<unsigned int, dim>> &lattice,
    double                                           *N,
    dealii::Tensor<1, dim>                           *gradient);
} // namespace geocone::GEOCONE_DIM

#endif
