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
   * A uniform grid of rectangles or cuboids over a box, with splines of degree
   * 1 (hat functions, i.e. Q1), 2 or 3 with clamped knots: the same functions
   * as those of Space on such a mesh, without a triangulation. Cells and
   * functions are numbered by columns, i.e. the first direction is outermost.
   */
  class CartesianGrid
  {
  public:
    CartesianGrid() = default;

    /**
     * @param degree 1 to 3
     * @param lines ends of the equally spaced intervals in each direction (m)
     */
    CartesianGrid(const unsigned int                          degree,
                  const std::array<std::vector<double>, dim> &lines);

    /** One direction: intervals, and functions as piecewise polynomials. */
    struct Axis
    {
      double       begin = 0., end = 0.; ///< (m)
      double       size         = 0.;    ///< of an interval (m)
      double       inverse_size = 0.;    ///< (1/m)
      unsigned int n_intervals  = 0;
      unsigned int n_functions  = 0;

      /** Position of each function: its Greville abscissa (m). */
      std::vector<double> places;

      /** Kind of each interval: those near the ends differ from the others. */
      std::vector<unsigned char> type;

      /** Coefficients for each kind: p + 1 vectors of 4 for the values, and p
       *  for the derivatives (1/m), both in powers of the position in the
       *  interval. */
      std::vector<double> coefficients;

      /** Interval of a coordinate, which can lie beyond the ends. */
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

    /** Smallest side of a cell (m). */
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
     * First column of each rank, followed by the number of columns, for about
     * equal numbers of points on all ranks.
     * @param points_in number of points per column
     */
    std::vector<int>
    slabs(const std::vector<std::size_t> &points_in,
          const unsigned int              n_ranks) const;

    /** Whether x lies in the box, within a tolerance relative to the cell
     *  size. */
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
