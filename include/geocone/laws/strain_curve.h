// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_strain_curve_h
#define geocone_laws_strain_curve_h

#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Variation of a strength parameter with plastic strain, parsed from a
   * string. With the initial value y_0, the formats are
   *   constant                    y_0,
   *   g_1: y_1, g_2: y_2, ...     linear from (0, y_0) to (g_1, y_1) and so on,
   *                               and constant beyond the last,
   *   exponential y_1, g_1        y_1 + (y_0 - y_1) exp(-g/g_1).
   */
  class StrainCurve
  {
  public:
    /** Parses the text. @throws InputError with the name of the parameter */
    void
    read(const std::string &parameter,
         const std::string &text,
         const double       initial);

    double
    operator()(const double strain) const;

    bool
    is_constant() const
    {
      return points.size() == 1;
    }

    /** Smallest and largest value of the curve. */
    std::pair<double, double>
    range() const;

    /** Minimum slope of the curve, negative for decreasing curves. */
    double
    least_slope() const;

    /** Plastic strains at the vertices of a piecewise linear curve, or at
     *  sampling points of an exponential curve. */
    std::vector<double>
    places() const;

  private:
    std::vector<std::pair<double, double>> points;
    double                                 scale =
      0.; ///< g_1 of an exponential curve, whose y_1 is the last point
  };
} // namespace geocone

#endif
