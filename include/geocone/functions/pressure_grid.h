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
   * Pore pressures on a structured rectangular grid, e.g. from a seepage
   * program, read from a comma-separated file with the columns x, y (m) and u
   * (Pa, >= 0): one row for each grid point, in any order. The pressure is
   * bilinear between the points and constant beyond the boundary.
   */
  class PressureGrid
  {
  public:
    /** @param text,parameter value and name of the parameter, for messages
     *  @throws InputError naming the faulty line or the missing data */
    PressureGrid(const std::string &file,
                 const std::string &text,
                 const std::string &parameter);

    /** Pore pressure u (Pa). */
    double
    value(const dealii::Point<dim> &x) const;

    /** Pressure gradient (du/dx, du/dy), in three dimensions 0 along z
     *  (N/m^3). */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

    /** Whether the grid covers the box between two corners. */
    bool
    covers(const dealii::Point<dim> &lower,
           const dealii::Point<dim> &upper) const;

    /** Coordinates of the corners of the grid as text, for messages. */
    std::string
    extent() const;

  private:
    /** Grid interval that contains a coordinate: index, relative position in
     *  the interval (0 to 1), and length (m), 0 outside of the grid. */
    struct At
    {
      std::size_t i;
      double      part, length;
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
