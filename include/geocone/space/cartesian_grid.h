// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_space_cartesian_grid_h
#define geocone_space_cartesian_grid_h

#include <geocone/base/types.h>
#include <geocone/space/spline_basis.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * A uniform grid of rectangles, or cuboids, over a box, with the splines of degree 1 (hats,
   * that is Q1), 2 or 3 on it, of clamped knots: the same functions as those of
   * Space on such a mesh, without a triangulation. Cells and functions are counted
   * by column, all those of one place in the first direction, and within it.
   */
  class CartesianGrid
  {
  public:
    CartesianGrid() = default;

    /**
     * @param degree 1 to 3
     * @param lines ends of the intervals per direction, equally spaced (m)
     */
    CartesianGrid(const unsigned int                          degree,
                  const std::array<std::vector<double>, dim> &lines);

    /** One direction: intervals, and functions in piecewise powers. */
    struct Axis
    {
      double       begin = 0., end = 0.; ///< (m)
      double       size         = 0.;    ///< of an interval (m)
      double       inverse_size = 0.;    ///< (1/m)
      unsigned int n_intervals  = 0;
      unsigned int n_functions  = 0;

      /** Place of a function: its Greville abscissa (m). */
      std::vector<double> places;

      /** Kind of each interval: those near the ends differ from the others. */
      std::vector<unsigned char> type;

      /** Per kind p + 1 vectors of 4 coefficients of the values, and p of the
       *  derivatives (1/m), both in powers of the place in the interval. */
      std::vector<double> coefficients;

      /** The interval of a place, which may lie beyond the ends. */
      int
      interval(const double x) const
      {
        const double u = (x - begin) * inverse_size;
        return u < 0.            ? 0
               : u < n_intervals ? static_cast<int>(u)
                                 : static_cast<int>(n_intervals) - 1;
      }
    };

    unsigned int          degree = 1;
    std::array<Axis, dim> axes;

    /** The smallest side of a cell (m). */
    double
    cell_size() const
    {
      double least = axes[0].size;
      for (const Axis &axis : axes)
        least = std::min(least, axis.size);
      return least;
    }

    unsigned long
    n_cells() const
    {
      unsigned long n = 1;
      for (const Axis &axis : axes)
        n *= axis.n_intervals;
      return n;
    }

    unsigned long
    n_functions() const
    {
      unsigned long n = 1;
      for (const Axis &axis : axes)
        n *= axis.n_functions;
      return n;
    }

    /**
     * The first column of each rank, and behind them the number of columns, where
     * columns are shared out so that all ranks have about as many points.
     * @param points_in number of points per column
     */
    std::vector<int>
    slabs(const std::vector<std::size_t> &points_in,
          const unsigned int              n_ranks) const;

    /** Whether x lies in the box, up to a part of a cell's size. */
    bool
    contains(const dealii::Point<dim> &x, const double tolerance = 1e-9) const
    {
      bool inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        inside = inside && x[d] >= axes[d].begin - tolerance * axes[d].size &&
                 x[d] <= axes[d].end + tolerance * axes[d].size;
      return inside;
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
