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
  /** Largest polynomial degree of the bases for particles. */
  constexpr unsigned int max_degree = 3;

  /**
   * B-splines of degree p and continuity p - 1 in one dimension on n intervals
   * of any lengths, with clamped knots (the first and last are repeated p + 1
   * times): n + p functions, with i, ..., i + p non-zero on interval i. They
   * are non-negative, sum up to one, and reproduce x by their Greville
   * abscissae. At an end of the line only the first (last) function is not
   * zero.
   */
  class SplineBasis
  {
  public:
    /** @param breaks ends of the intervals, increasing (m) */
    SplineBasis(const unsigned int degree, const std::vector<double> &breaks);

    unsigned int
    n_functions() const
    {
      return knots.size() - p - 1;
    }

    /** Greville abscissa: the mean of the inner knots of a function (m). */
    double
    greville(const unsigned int function) const;

    /** Integral of a function over the line (m). */
    double
    integral(const unsigned int function) const
    {
      return (knots[function + p + 1] - knots[function]) / (p + 1);
    }

    /**
     * Evaluates the p + 1 functions of an interval and their derivatives.
     * @param xi position in the interval, 0 to 1
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
   * Bernstein polynomials of degree p at xi in [0, 1]: the same space as
   * Lagrange's, but non-negative.
   */
  void
  bernstein(const unsigned int p, const double xi, double *N, double *dN);

  /**
   * Bernstein polynomials of degree p on the unit triangle with the area
   * coordinates l = (1 - x - y, x, y):
   *   B_ab = p!/((p - a - b)! a! b!) l_0^(p - a - b) l_1^a l_2^b.
   * @param lattice (a, b) of each
   * @param[out] N values
   * @param[out] gradient with respect to (x, y); can be null
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
