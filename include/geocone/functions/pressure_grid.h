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
   * Pore pressures on a rectangular grid from a .csv file with the columns x, y (m) and u
   * (Pa, >= 0), such as programs of seepage write them: one row for each place of the
   * grid, in any order. Between them u is bilinear, beyond them as at the border.
   */
  class PressureGrid
  {
  public:
    /** @param text,parameter what the parameter file says, and its name, for messages
     *  @throws InputError naming the line that cannot be understood, or what lacks */
    PressureGrid(const std::string &file,
                 const std::string &text,
                 const std::string &parameter);

    /** u (Pa). */
    double
    value(const dealii::Point<dim> &x) const;

    /** (du/dx, du/dy), in three dimensions 0 along z (N/m^3). */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

    /** Whether it reaches from one corner to the other one. */
    bool
    covers(const dealii::Point<dim> &lower,
           const dealii::Point<dim> &upper) const;

    /** From where to where, for messages. */
    std::string
    extent() const;

  private:
    /** The interval of a coordinate, where in it a place is (0 to 1), and its length, or
     *  0 where the place is beyond the grid. */
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
