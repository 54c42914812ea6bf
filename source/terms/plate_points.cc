// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/terms/plate_points.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** A crossing: its parameter in [0, 1] along a line, and the length of the side of
     *  a cell. */
    using Crossing = std::pair<double, double>;

    /** Component of the vector product normal to the plane. */
    double
    normal_product(const Tensor<1, dim> &a, const Tensor<1, dim> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /** Sorted crossings of a line from a to b and the sides of cells, with the ends of
     *  the sides that lie on it. */
    std::vector<Crossing>
    crossings_of_line(const Point<dim>     &a,
                      const Point<dim>     &b,
                      const BackgroundMesh &mesh)
    {
      const Tensor<1, dim>  line      = b - a;
      const double          tolerance = BackgroundMesh::tolerance;
      std::vector<Crossing> all;
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        {
          const double size = cell->diameter(); // of a ball around it
          if (std::abs(normal_product(cell->vertex(0) - a, line)) >
              size * line.norm() * (1. + tolerance))
            continue;
          for (const unsigned int f : cell->face_indices())
            {
              const Point<dim>     p    = cell->face(f)->vertex(0);
              const Tensor<1, dim> side = cell->face(f)->vertex(1) - p;
              const double         sine = normal_product(line, side);
              if (std::abs(sine) > tolerance * line.norm() * side.norm())
                {
                  const double at_side = normal_product(p - a, line) / sine;
                  if (at_side >= -tolerance && at_side <= 1. + tolerance)
                    all.emplace_back(normal_product(p - a, side) / sine,
                                     side.norm());
                }
              else if (std::abs(normal_product(p - a, line)) <=
                       tolerance * line.norm() * side.norm())
                for (const Tensor<1, dim> &end : {p - a, p + side - a})
                  all.emplace_back(end * line / line.norm_square(),
                                   side.norm());
            }
        }
      std::sort(all.begin(), all.end());
      return all;
    }

    /** Parameters in (0, 1) of the ties along a line. */
    std::vector<double>
    places_on_line(const Point<dim>     &a,
                   const Point<dim>     &b,
                   const Structure      &plate,
                   const BackgroundMesh &mesh,
                   const unsigned int    degree)
    {
      const double        length = a.distance(b);
      std::vector<double> ends   = {0.};
      unsigned int        parts  = degree;
      if (std::isfinite(plate.spacing))
        {
          parts = std::ceil(length / plate.spacing * (1. - 1e-9));
          ends.push_back(1.);
        }
      else
        {
          // Nearer points would tie more displacements than the cells have, and
          // their axial forces would oscillate.
          constexpr double least = 0.7; // parts of a side
          for (const auto &[place, side] : crossings_of_line(a, b, mesh))
            if ((place - ends.back()) * length > least * side &&
                (1. - place) * length > least * side)
              ends.push_back(place);
          ends.push_back(1.);
        }
      std::vector<double> places;
      for (std::size_t i = 1; i < ends.size(); ++i)
        for (unsigned int part = i == 1 ? 1 : 0; part < parts; ++part)
          places.push_back(ends[i - 1] +
                           (ends[i] - ends[i - 1]) * part / parts);
      return places;
    }
  } // namespace

  std::vector<Point<dim>>
  points_of_plate(const Structure      &plate,
                  const BackgroundMesh &mesh,
                  const unsigned int    degree)
  {
    std::vector<Point<dim>> points = {plate.points.front()};
    for (std::size_t i = 1; i < plate.points.size(); ++i)
      {
        const Point<dim> &a = plate.points[i - 1], &b = plate.points[i];
        for (const double place : places_on_line(a, b, plate, mesh, degree))
          points.push_back(a + place * (b - a));
        points.push_back(b);
      }
    if (points.size() == 2) // which would not bend
      points.insert(points.begin() + 1,
                    points[0] + 0.5 * (points[1] - points[0]));
    return points;
  }
} // namespace geocone::GEOCONE_DIM
