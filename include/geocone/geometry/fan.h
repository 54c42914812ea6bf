// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_geometry_fan_h
#define geocone_geometry_fan_h

#include <geocone/base/state_row.h>
#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Concentric rings of triangles around a vertex of the outline, in plane
   *  meshes. The triangles of the innermost ring meet at the vertex. The radius
   *  decreases from ring to ring by a factor of about 2. */
  struct Fan
  {
    dealii::Point<dim> apex;
    double             radius = 0., inner_radius = 0.;
    std::vector<double>
      rays; ///< angles to x, counterclockwise, from side to side

    /** Outer radii of all rings (m), in increasing order. */
    std::vector<double>
    radii() const
    {
      const unsigned int  n   = std::lround(std::log2(radius / inner_radius));
      std::vector<double> all = {radius};
      for (unsigned int i = 1; i <= n; ++i)
        all.insert(all.begin(),
                   radius * std::pow(inner_radius / radius, double(i) / n));
      return all;
    }

    /** Point on a ray at a given distance from the apex. */
    dealii::Point<dim>
    at(const unsigned int ray, const double distance) const
    {
      dealii::Point<dim> x = apex;
      x[0] += distance * std::cos(rays[ray]);
      x[1] += distance * std::sin(rays[ray]);
      return x;
    }

    /** Length of the shortest edge on the outer boundary of the fan (m). */
    double
    chord() const
    {
      double least = 2. * radius;
      for (unsigned int i = 1; i < rays.size(); ++i)
        least = std::min(least, at(i - 1, radius).distance(at(i, radius)));
      return least;
    }

    /** Number of triangles in all rings. */
    std::size_t
    n_triangles() const
    {
      return (rays.size() - 1) * (2 * radii().size() - 1);
    }

    void
    state(StateRow &row)
    {
      row(apex, radius, inner_radius, rays);
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
