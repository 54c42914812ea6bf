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
   * Univariate B-splines of degree p on intervals of arbitrary length. They
   * have continuity p - 1 at simple knots and p - 2 at double knots. The knots
   * are clamped: the first and last knots are repeated p + 1 times. On n
   * intervals with m double knots there are n + m + p basis functions, of which
   * p + 1 are non-zero on an interval. The basis functions are non-negative and
   * a partition of unity; x is reproduced with the Greville abscissae as
   * coefficients. At each end only the first (last) basis function is non-zero.
   */
  class SplineBasis
  {
  public:
    /** Constructs the basis. @param breaks interval boundaries, increasing (m);
     *  an inner boundary given twice is a double knot (degree 2 and higher) */
    SplineBasis(const unsigned int degree, const std::vector<double> &breaks);

    /** Moves the interval boundaries. @param breaks as many as before,
     *  increasing, each once (m); double knots remain double */
    void
    move(const std::vector<double> &breaks);

    unsigned int
    n_functions() const
    {
      return knots.size() - p - 1;
    }

    unsigned int
    n_intervals() const
    {
      return first.size();
    }

    /** Returns the first of the p + 1 basis functions that are non-zero on an
     *  interval. */
    unsigned int
    first_function(const unsigned int interval) const
    {
      return first[interval];
    }

    /** Returns the number of basis functions that are non-zero on an interval
     *  and zero on all intervals before it. */
    unsigned int
    n_entering(const unsigned int interval) const
    {
      return interval == 0 ? p + 1 : first[interval] - first[interval - 1];
    }

    /** Returns the number of basis functions that are non-zero on an interval
     *  and zero on all intervals after it. */
    unsigned int
    n_leaving(const unsigned int interval) const
    {
      return interval + 1 == first.size()
               ? p + 1
               : first[interval + 1] - first[interval];
    }

    /** Returns an interval in the middle of the support of a basis function. */
    unsigned int
    middle_interval(const unsigned int function) const;

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

    /** First non-zero basis function of each interval. */
    std::vector<unsigned int> first;
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
