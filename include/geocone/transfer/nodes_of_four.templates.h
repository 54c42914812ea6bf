// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_nodes_of_four_templates_h
#define geocone_transfer_nodes_of_four_templates_h

#include <geocone/kernels/simd.h>
#include <geocone/transfer/transfer_kernels.h>

/*
 * Location of four points on a grid and evaluation of the basis functions with
 * support at the points: the first part of every transfer kernel. P: Pack of an
 * instruction set.
 */
namespace geocone::GEOCONE_DIM
{
  /** Values of the one-dimensional basis functions at four points, for each
   *  direction. */
  template <int p>
  using ValuesAtFour = double[dim][p + 1][4];

  /** Data of one grid direction, with each value in all lanes of a SIMD
   *  vector. */
  template <typename P, int p>
  struct PackedAxis
  {
    P origin, inverse_size, last, first, stride;

    /** Polynomial coefficients of the basis functions on the inner intervals.
     *  These are the intervals p - 1 ... n_intervals - p, on which the basis
     *  functions are translates of each other. */
    P inner_first, inner_last, inner[2 * p + 1][p + 1];
  };

  /** Copy of the grid data required to evaluate basis functions of degree p.
   *  With a copy, the compiler can assume that stores to points and nodes do
   *  not alias the data. */
  template <typename P, int p>
  struct PackedGrid : GridView
  {
    PackedAxis<P, p> at[dim];

    explicit PackedGrid(const GridView &view)
      : GridView(view)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const GridAxis &axis = axes[d];
          const int       n    = axis.n_intervals;
          at[d].origin         = P(axis.origin);
          at[d].inverse_size   = P(axis.inverse_size);
          at[d].last           = P(n - 1);
          at[d].first          = P(axis.first);
          at[d].stride         = P(stride[d]);
          at[d].inner_first    = P(p - 1);
          at[d].inner_last     = P(n - p); // there are none if n < 2 p - 1
          const double *inner =
            coefficients(axis, axis.type[p - 1 < n ? p - 1 : 0]);
          for (int power = 0; power <= 2 * p; ++power)
            for (int f = 0; f <= p; ++f)
              at[d].inner[power][f] = P(inner[4 * power + f]);
        }
    }

    static const double *
    coefficients(const GridAxis &axis, const int type)
    {
      return axis.coefficients + 4 * (2 * p + 1) * type;
    }
  };

  /** For each of the four points k, ..., k + 3 of a block, the basis functions
   *  that are non-zero there. There are (p + 1)^dim of them per point. */
  template <typename P, int p>
  struct NodesOfFour
  {
    int             first[4];       ///< index of the lowest stored node
    int             lowest[dim][4]; ///< lowest basis function
    ValuesAtFour<p> N, dN;

    NodesOfFour(const PackedGrid<P, p> &grid,
                const TransferBlock    &points,
                const unsigned int      k)
    {
      P    place(0.), xi[dim];
      bool inner = true;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const PackedAxis<P, p> &axis = grid.at[d];
          const P                 u =
            (P::load(points.x[d] + k) - axis.origin) * axis.inverse_size;
          // Zero comes second, so that it replaces NaN.
          const P interval =
            whole_part(min(max(u, P(0.)), axis.last), lowest[d]);
          xi[d] = u - interval;
          place += (interval - axis.first) * axis.stride;
          inner =
            inner && all_between(interval, axis.inner_first, axis.inner_last);
        }
      whole_part(place, first);
      for (unsigned int d = 0; d < dim; ++d)
        if (inner)
          find(grid.at[d].inner, xi[d], N[d], dN[d]);
        else
          find_each(grid.axes[d], lowest[d], xi[d], N[d], dN[d]);
    }

    /** Returns the address of the nodal values of the first node (lowest index)
     *  in the support at point @p m. */
    const double *
    read(const GridView &grid, const int m) const
    {
      return grid.read + node_size * static_cast<long>(first[m]);
    }
    double *
    write(const GridView &grid, const int m) const
    {
      return grid.write + node_size * static_cast<long>(first[m]);
    }

  private:
    /** Evaluates a basis function and its derivative at the local coordinate
     *  xi. The coefficients of the two polynomials are c(0), c(1), ... in
     *  sequence. */
    template <typename Coefficients>
    static void
    evaluate(const Coefficients &c, const P &xi, P &value, P &slope)
    {
      value = c(p);
      slope = c(2 * p);
      for (int power = p - 1; power >= 0; --power)
        value = value * xi + c(power);
      for (int power = 2 * p - 1; power >= p + 1; --power)
        slope = slope * xi + c(power);
    }

    /** Evaluates the basis functions one by one, for four points in intervals
     *  with the same polynomial coefficients. */
    static void
    find(const P (&c)[2 * p + 1][p + 1],
         const P &xi,
         double (&N)[p + 1][4],
         double (&dN)[p + 1][4])
    {
      for (int f = 0; f <= p; ++f)
        {
          P value, slope;
          evaluate([&](const int k) { return c[k][f]; }, xi, value, slope);
          value.store(N[f]);
          slope.store(dN[f]);
        }
    }

    /** Evaluates the basis functions point by point, if some points are near
     *  the boundary of the grid. */
    static void
    find_each(const GridAxis &axis,
              const int (&interval)[4],
              const P &places,
              double (&N)[p + 1][4],
              double (&dN)[p + 1][4])
    {
      double xi[4];
      places.store(xi);
      P value[4], slope[4];
      for (int m = 0; m < 4; ++m)
        {
          const double *c =
            PackedGrid<P, p>::coefficients(axis, axis.type[interval[m]]);
          evaluate([c](const int k) { return P::load(c + 4 * k); },
                   P(xi[m]),
                   value[m],
                   slope[m]);
        }
      transpose(value[0], value[1], value[2], value[3]);
      transpose(slope[0], slope[1], slope[2], slope[3]);
      for (int f = 0; f <= p; ++f)
        {
          value[f].store(N[f]);
          slope[f].store(dN[f]);
        }
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
