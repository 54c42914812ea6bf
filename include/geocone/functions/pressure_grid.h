// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_pressure_grid_h
#define geocone_functions_pressure_grid_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Pore pressure field on a structured rectangular grid, e.g. from a seepage
   * program. The comma-separated input file has the columns x, y (m) and u (Pa,
   * >= 0), with one row per grid point in any order. The pressure is bilinear
   * between the grid points and constant beyond the boundary.
   */
  class PressureGrid
  {
  public:
    /** Reads the pressure grid from a file.
     *  @param text,parameter value and name of the parameter, for messages
     *  @throws InputError naming the faulty line or the missing data */
    PressureGrid(const std::string &file,
                 const std::string &text,
                 const std::string &parameter);

    /** Pore pressure u (Pa) at a point. */
    double
    value(const dealii::Point<dim> &x) const;

    /** Gradient of the pore pressure (N/m^3). The z component is zero in three
     *  dimensions. */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

    /** Returns true if the grid covers an axis-aligned box, given by two
     *  opposite corners. */
    bool
    covers(const dealii::Point<dim> &lower,
           const dealii::Point<dim> &upper) const;

    /** Corner coordinates of the grid as text, for error messages. */
    std::string
    extent() const;

  private:
    /** Interval between two grid lines that contains a given coordinate. The
     *  relative position is between 0 and 1; the length (m) is 0 outside the
     *  grid. */
    struct At
    {
      std::size_t i;
      double      relative_position, length;
    };
    static At
    locate(const std::vector<double> &places, const double x);

    double
    node(const std::size_t i, const std::size_t j) const
    {
      return values[j * xs.size() + i];
    }

    std::vector<double> xs, ys;
    std::vector<double> values; ///< u by rows of equal y
  };
} // namespace geocone::GEOCONE_DIM

#endif
