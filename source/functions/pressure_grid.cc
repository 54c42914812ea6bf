// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/csv_reader.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/functions/pressure_grid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Coordinates whose difference is below this fraction of the extent are
     *  equal. */
    constexpr double same = 1e-9;

    /** Distinct values of a column of numbers, in order. */
    std::vector<double>
    places_of(const std::vector<std::array<double, 3>> &rows,
              const unsigned int                        column)
    {
      std::vector<double> all;
      for (const auto &row : rows)
        all.push_back(row[column]);
      std::sort(all.begin(), all.end());
      const double        tolerance = same * (all.back() - all.front());
      std::vector<double> places;
      for (const double x : all)
        if (places.empty() || x - places.back() > tolerance)
          places.push_back(x);
      return places;
    }

    std::size_t
    nearest(const std::vector<double> &places, const double x)
    {
      const auto next = std::lower_bound(places.begin(), places.end(), x);
      if (next == places.begin())
        return 0;
      const std::size_t i = next - places.begin();
      return i == places.size() || x - places[i - 1] < places[i] - x ? i - 1
                                                                     : i;
    }
  } // namespace

  PressureGrid::PressureGrid(const std::string &file,
                             const std::string &text,
                             const std::string &parameter)
  {
    try
      {
        CsvReader                      in(file);
        const std::vector<std::string> names = in.names();
        if (names != std::vector<std::string>{"x", "y", "u"})
          throw RunError(in.place() + ": these are not its columns");
        std::vector<std::array<double, 3>> rows;
        std::vector<std::string>           texts;
        while (in.next_row(texts))
          {
            std::array<double, 3> &row = rows.emplace_back();
            for (unsigned int i = 0; i < 3; ++i)
              {
                row[i] = in.number(texts, i);
                if (!std::isfinite(row[i]))
                  throw RunError(in.place(i) + ": '" + texts[i] +
                                 "' is not finite");
              }
            if (row[2] < 0.)
              throw RunError(in.place(2) + ": " + texts[2] +
                             " Pa; suction counts as 0");
          }
        if (rows.empty())
          throw RunError("there are no rows");
        xs = places_of(rows, 0);
        ys = places_of(rows, 1);
        if (xs.size() < 2 || ys.size() < 2)
          throw RunError("it has no two different x, or no two different y");
        // For scattered points the grid would grow with the square of their
        // number.
        if (xs.size() > rows.size() / ys.size() + 1)
          throw RunError(format("its %zu rows have %zu different x and %zu "
                                "different y: these places are no grid; "
                                "interpolate them to one",
                                rows.size(),
                                xs.size(),
                                ys.size()));
        values.assign(xs.size() * ys.size(),
                      std::numeric_limits<double>::quiet_NaN());
        for (const auto &row : rows)
          {
            double &u =
              values[nearest(ys, row[1]) * xs.size() + nearest(xs, row[0])];
            if (std::isfinite(u))
              throw RunError(format(
                "there are two rows for x = %g, y = %g", row[0], row[1]));
            u = row[2];
          }
        for (std::size_t j = 0; j < ys.size(); ++j)
          for (std::size_t i = 0; i < xs.size(); ++i)
            if (!std::isfinite(node(i, j)))
              throw RunError(format(
                "there is no row for x = %g, y = %g of the grid of %zu x %zu",
                xs[i],
                ys[j],
                xs.size(),
                ys.size()));
      }
    catch (const RunError &error)
      {
        throw InputError(
          parameter,
          text,
          "a .csv file with the columns x, y and u (Pa, >= 0), a "
          "row for each place of a rectangular grid",
          error.what());
      }
  }

  PressureGrid::At
  PressureGrid::locate(const std::vector<double> &places, const double x)
  {
    if (x <= places.front())
      return {0, 0., 0.};
    if (x >= places.back())
      return {places.size() - 2, 1., 0.};
    const std::size_t i =
      std::upper_bound(places.begin(), places.end(), x) - places.begin() - 1;
    const double length = places[i + 1] - places[i];
    return {i, (x - places[i]) / length, length};
  }

  double
  PressureGrid::value(const Point<dim> &x) const
  {
    const auto [i, s, x_length] = locate(xs, x[0]);
    const auto [j, t, y_length] = locate(ys, x[1]);
    (void)x_length;
    (void)y_length;
    return (1. - t) * ((1. - s) * node(i, j) + s * node(i + 1, j)) +
           t * ((1. - s) * node(i, j + 1) + s * node(i + 1, j + 1));
  }

  Tensor<1, dim>
  PressureGrid::gradient(const Point<dim> &x) const
  {
    const auto [i, s, x_length] = locate(xs, x[0]);
    const auto [j, t, y_length] = locate(ys, x[1]);
    Tensor<1, dim> g;
    if (x_length > 0.)
      g[0] = ((1. - t) * (node(i + 1, j) - node(i, j)) +
              t * (node(i + 1, j + 1) - node(i, j + 1))) /
             x_length;
    if (y_length > 0.)
      g[1] = ((1. - s) * (node(i, j + 1) - node(i, j)) +
              s * (node(i + 1, j + 1) - node(i + 1, j))) /
             y_length;
    return g;
  }

  bool
  PressureGrid::covers(const Point<dim> &lower, const Point<dim> &upper) const
  {
    const double tolerance =
      1e-6 * std::max(xs.back() - xs.front(), ys.back() - ys.front());
    return xs.front() <= lower[0] + tolerance &&
           ys.front() <= lower[1] + tolerance &&
           xs.back() >= upper[0] - tolerance &&
           ys.back() >= upper[1] - tolerance;
  }

  std::string
  PressureGrid::extent() const
  {
    return format(
      "(%g, %g) to (%g, %g)", xs.front(), ys.front(), xs.back(), ys.back());
  }
} // namespace geocone::GEOCONE_DIM
