// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/gmsh_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;

  namespace
  {
    /** Integrates 1/h^2 over triangles, 1/h^3 over boxes, divided into parts
     *  with almost constant h. */
    class IntegralOfSizes
    {
    public:
      explicit IntegralOfSizes(const MeshParameters &parameters)
        : parameters(parameters)
      {}

      /** The integral over a triangle, with the sign of its orientation. */
      double
      over(const std::array<Point<dim>, 3> &corners, const int depth = 60) const
      {
        const auto &[a, b, c]   = corners;
        const Point<dim> centre = a + (b - a) / 3. + (c - a) / 3.;
        const double     radius = std::max(
          {centre.distance(a), centre.distance(b), centre.distance(c)});
        if (depth == 0 || is_even(centre, radius))
          {
            const double h = size(distance(centre));
            return ((b[0] - a[0]) * (c[1] - a[1]) -
                    (b[1] - a[1]) * (c[0] - a[0])) /
                   2. / (h * h);
          }
        const Point<dim> ab = a + (b - a) / 2., bc = b + (c - b) / 2.,
                         ca = c + (a - c) / 2.;
        return over({{a, ab, ca}}, depth - 1) + over({{ab, b, bc}}, depth - 1) +
               over({{ca, bc, c}}, depth - 1) + over({{ab, bc, ca}}, depth - 1);
      }

      /** The integral of 1/h^3 over a box. */
      double
      over_box(const std::array<Point<dim>, 2> &corners,
               const int                        depth = 20) const
      {
        const auto &[a, b]      = corners;
        const Point<dim> centre = a + (b - a) / 2.;
        if (depth == 0 || is_even(centre, a.distance(b) / 2.))
          {
            const double h    = size(distance(centre));
            double       part = 1.;
            for (unsigned int c = 0; c < dim; ++c)
              part *= (b[c] - a[c]) / h;
            return part;
          }
        double sum = 0.;
        for (unsigned int v = 0; v < (1U << dim); ++v)
          {
            std::array<Point<dim>, 2> part;
            for (unsigned int c = 0; c < dim; ++c)
              {
                const bool upper = (v >> c) % 2 == 1;
                part[0][c]       = upper ? centre[c] : a[c];
                part[1][c]       = upper ? b[c] : centre[c];
              }
            sum += over_box(part, depth - 1);
          }
        return sum;
      }

    private:
      /** Distance to the nearest grading point (m). */
      double
      distance(const Point<dim> &x) const
      {
        double nearest = std::numeric_limits<double>::max();
        for (const Point<dim> &point : parameters.grading_points)
          nearest = std::min(nearest, x.distance(point));
        return nearest;
      }

      /** Whether the size is almost constant in a ball: it is monotonic in the
       *  distance, which changes by the radius. */
      bool
      is_even(const Point<dim> &centre, const double radius) const
      {
        const double d = distance(centre);
        return size(d + radius) <= 1.5 * size(d - radius);
      }

      double
      size(const double distance) const
      {
        return parameters.grading_points.empty()
                 ? parameters.cell_size
                 : std::clamp(parameters.size_ratio * distance,
                              parameters.smallest,
                              parameters.largest);
      }

      const MeshParameters &parameters;
    };
  } // namespace

  double
  unstructured_size(const MeshParameters &parameters)
  {
    const Polygon        &outline = parameters.outline;
    const IntegralOfSizes integral(parameters);
    if (dim == 3) // volume h^3/6 sqrt2 of a regular tetrahedron with edge h
      return std::max(
        6., 6. * sqrt2 * integral.over_box({{outline[0], outline[1]}}));
    const auto over = [&](const Polygon &polygon) {
      double sum = 0.;
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += integral.over({{polygon[0], polygon[i], polygon[i + 1]}});
      return std::abs(sum);
    };
    double sum = over(outline), least = outline.size() - 2.;
    for (const Polygon &hole : parameters.holes)
      {
        sum -= over(hole);
        least += hole.size() + 2.; // triangles without further vertices
      }
    const double n_triangles = std::max(4. / std::sqrt(3.) * sum, least);
    return (parameters.cells == MeshParameters::Cells::quadrilaterals ? 2.
                                                                      : 1.) *
           n_triangles;
  }
} // namespace geocone::GEOCONE_DIM
