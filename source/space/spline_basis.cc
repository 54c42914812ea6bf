// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/space/spline_basis.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  SplineBasis::SplineBasis(const unsigned int         degree,
                           const std::vector<double> &breaks)
    : p(degree)
    , knots(p, breaks.front())
  {
    knots.insert(knots.end(), breaks.begin(), breaks.end());
    knots.insert(knots.end(), p, breaks.back());
    for (unsigned int k = p; k + p + 1 < knots.size(); ++k)
      if (knots[k + 1] > knots[k])
        first.push_back(k - p);
  }

  void
  SplineBasis::move(const std::vector<double> &breaks)
  {
    auto to = breaks.begin();
    for (std::size_t k = 0; k < knots.size(); ++k)
      {
        const bool ends_interval =
          k + 1 < knots.size() && knots[k + 1] > knots[k];
        knots[k] = *to;
        to += ends_interval;
      }
  }

  unsigned int
  SplineBasis::middle_interval(const unsigned int function) const
  {
    // Of simple knots: the interval function - p/2.
    const auto after = std::upper_bound(
      first.begin(), first.end(), function - std::min(function, p / 2));
    return after - first.begin() - 1;
  }

  double
  SplineBasis::greville(const unsigned int function) const
  {
    double sum = 0.;
    for (unsigned int k = 1; k <= p; ++k)
      sum += knots[function + k];
    return sum / p;
  }

  void
  SplineBasis::evaluate(const unsigned int i,
                        const double       xi,
                        double            *N,
                        double            *dN) const
  {
    // Cox-de Boor recursion over the degree; knots are counted from the first
    // one of the first function.
    const double *t      = &knots[first[i]];
    const double  length = t[p + 1] - t[p];
    const double  x      = t[p] + xi * length;
    double        lower[max_degree + 1];
    N[0] = 1.;
    for (unsigned int degree = 1; degree <= p; ++degree)
      {
        double carried = 0.;
        for (unsigned int r = 0; r < degree; ++r)
          {
            const double right = t[p + r + 1], left = t[p + r + 1 - degree];
            lower[r]         = N[r];
            const double per = N[r] / (right - left);
            N[r]             = carried + (right - x) * per;
            carried          = (x - left) * per;
          }
        N[degree] = carried;
      }
    for (unsigned int r = 0; r <= p; ++r)
      {
        dN[r] = 0.;
        if (r > 0)
          dN[r] += p * length * lower[r - 1] / (t[r + p] - t[r]);
        if (r < p)
          dN[r] -= p * length * lower[r] / (t[r + p + 1] - t[r + 1]);
      }
  }

  void
  bernstein(const unsigned int p, const double xi, double *N, double *dN)
  {
    double lower[max_degree + 1];
    N[0] = 1.;
    for (unsigned int degree = 1; degree <= p; ++degree)
      {
        double carried = 0.;
        for (unsigned int r = 0; r < degree; ++r)
          {
            lower[r] = N[r];
            N[r]     = carried + (1. - xi) * lower[r];
            carried  = xi * lower[r];
          }
        N[degree] = carried;
      }
    for (unsigned int r = 0; r <= p; ++r)
      dN[r] = p * ((r > 0 ? lower[r - 1] : 0.) - (r < p ? lower[r] : 0.));
  }

  void
  bernstein_on_simplex(
    const unsigned int                                p,
    const dealii::Point<dim>                         &x,
    const std::vector<std::array<unsigned int, dim>> &lattice,
    double                                           *N,
    dealii::Tensor<1, dim>                           *gradient)
  {
    // l_j^k / k!, with the coordinate of the first vertex last.
    double l[dim + 1], power[dim + 1][max_degree + 1], factorial = 1.;
    l[dim] = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        l[d] = x[d];
        l[dim] -= x[d];
      }
    for (unsigned int j = 0; j <= dim; ++j)
      {
        power[j][0] = 1.;
        for (unsigned int k = 1; k <= p; ++k)
          power[j][k] = power[j][k - 1] * l[j] / k;
      }
    for (unsigned int k = 2; k <= p; ++k)
      factorial *= k;
    for (unsigned int i = 0; i < lattice.size(); ++i)
      {
        unsigned int exponent[dim + 1];
        exponent[dim] = p;
        for (unsigned int d = 0; d < dim; ++d)
          {
            exponent[d] = lattice[i][d];
            exponent[dim] -= exponent[d];
          }
        // The product, with one factor replaced by its derivative.
        const auto product = [&](const unsigned int derived) {
          double value = factorial;
          for (unsigned int j = 0; j <= dim; ++j)
            value *= j != derived       ? power[j][exponent[j]]
                     : exponent[j] == 0 ? 0.
                                        : power[j][exponent[j] - 1];
          return value;
        };
        N[i] = product(dim + 1);
        if (gradient != nullptr)
          for (unsigned int d = 0; d < dim; ++d)
            gradient[i][d] = product(d) - product(dim);
      }
  }
} // namespace geocone::GEOCONE_DIM
