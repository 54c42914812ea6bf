// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/space/cartesian_grid.h>

#include <Eigen/LU>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Adds the functions of an interval as powers of the position xi in it. */
    void
    add_kind(const SplineBasis   &basis,
             const unsigned int   p,
             const unsigned int   interval,
             const double         size,
             std::vector<double> &coefficients)
    {
      // Interpolation at p + 1 points, exact for polynomials up to rounding.
      Eigen::MatrixXd powers(p + 1, p + 1), values(p + 1, p + 1);
      for (unsigned int r = 0; r <= p; ++r)
        {
          const double xi = static_cast<double>(r) / p;
          double       N[max_degree + 1], dN[max_degree + 1];
          basis.evaluate(interval, xi, N, dN);
          for (unsigned int k = 0; k <= p; ++k)
            {
              powers(r, k) = std::pow(xi, k);
              values(r, k) = N[k];
            }
        }
      const Eigen::MatrixXd c = powers.fullPivLu().solve(values);
      for (unsigned int k = 0; k <= p; ++k)
        for (unsigned int f = 0; f < 4; ++f)
          coefficients.push_back(f <= p ? c(k, f) : 0.);
      for (unsigned int k = 1; k <= p; ++k)
        for (unsigned int f = 0; f < 4; ++f)
          coefficients.push_back(f <= p ? k * c(k, f) / size : 0.);
    }
  } // namespace

  CartesianGrid::CartesianGrid(
    const unsigned int                          degree_,
    const std::array<std::vector<double>, dim> &lines)
    : degree(degree_)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const SplineBasis  basis(degree, lines[d]);
        Axis              &axis = axes[d];
        const unsigned int n    = lines[d].size() - 1;
        axis.begin              = lines[d].front();
        axis.end                = lines[d].back();
        axis.size               = (axis.end - axis.begin) / n;
        axis.inverse_size       = 1. / axis.size;
        axis.n_intervals        = n;
        axis.n_functions        = basis.n_functions();
        for (unsigned int f = 0; f < axis.n_functions; ++f)
          axis.places.push_back(basis.greville(f));

        // Clamped knots affect p - 1 intervals at each end.
        const unsigned int near    = degree - 1;
        unsigned int       n_kinds = 0, inner = 0;
        bool               has_inner = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            const bool is_inner = i >= near && i + near < n;
            if (is_inner && has_inner)
              {
                axis.type.push_back(inner);
                continue;
              }
            if (is_inner)
              {
                has_inner = true;
                inner     = n_kinds;
              }
            axis.type.push_back(n_kinds++);
            add_kind(basis, degree, i, axis.size, axis.coefficients);
          }
      }
  }

  std::vector<int>
  CartesianGrid::slabs(const std::vector<std::size_t> &points_in,
                       const unsigned int              n_ranks) const
  {
    const unsigned int n_columns = axes[0].n_intervals;
    std::size_t        total     = 0;
    for (const std::size_t n : points_in)
      total += n;
    std::vector<int> begin(n_ranks + 1, n_columns);
    begin[0]            = 0;
    std::size_t  before = 0;
    unsigned int r      = 1;
    for (unsigned int column = 0; column < n_columns; ++column)
      {
        // Boundary at the side of the column nearer to the balanced position.
        while (r < n_ranks &&
               2 * n_ranks * before + n_ranks * points_in[column] >=
                 2 * r * total)
          begin[r++] = column;
        before += points_in[column];
      }
    return begin;
  }
} // namespace geocone::GEOCONE_DIM
