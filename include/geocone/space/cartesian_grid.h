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
   * Uniform Cartesian grid of a box with B-spline basis functions of degree 1,
   * 2 or 3. The knots are clamped; functions of degree 1 are hat functions
   * (Q1). The basis functions are the same as in Space on this grid, but no
   * triangulation is required. Cells and basis functions are numbered by
   * columns: the first direction varies slowest.
   */
  class CartesianGrid
  {
  public:
    CartesianGrid() = default;

    /**
     * Constructs the grid and its basis functions.
     * @param degree polynomial degree, 1 to 3
     * @param lines coordinates of the equally spaced grid lines in each
     * direction (m)
     */
    CartesianGrid(const unsigned int                          degree,
                  const std::array<std::vector<double>, dim> &lines);

    /** Data of one grid direction: intervals (cells) and piecewise polynomial
     *  basis functions. */
    struct Axis
    {
      double       begin = 0., end = 0.; ///< limits of the box (m)
      double       size         = 0.;    ///< length of an interval (m)
      double       inverse_size = 0.;    ///< 1 / size (1/m)
      unsigned int n_intervals  = 0;
      unsigned int n_functions  = 0;

      /** Greville abscissae of the basis functions (m). */
      std::vector<double> places;

      /** Type of each interval, which selects the polynomials of the basis
       *  functions. Near the ends of the direction the polynomials differ
       *  because of the clamped knots. */
      std::vector<unsigned char> type;

      /** Polynomial coefficients of the basis functions and their derivatives
       *  (1/m) for each type of interval. There are p + 1 vectors of 4 for the
       *  values, then p for the derivatives, in powers of the local coordinate
       *  of the interval. */
      std::vector<double> coefficients;

      /** Returns the index of the interval that contains the coordinate @p x.
       *  Beyond the ends, the first or last interval is returned. */
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

    /** Returns the smallest side length of the cells (m). */
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
     * Divides the grid columns into contiguous slabs, one per rank, with about
     * equal numbers of points.
     * @param points_in number of points in each column
     * @return first column of each rank, followed by the number of columns
     */
    std::vector<int>
    slabs(const std::vector<std::size_t> &points_in,
          const unsigned int              n_ranks) const;

    /** Returns true if the point @p x lies in the box of the grid, within a
     *  tolerance relative to the cell size. */
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
