// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_triangle_field_h
#define geocone_functions_triangle_field_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Gradients of the three barycentric coordinates of a triangle with respect
   *  to x and y (1/m).
   *  @param corners of the triangle, in either orientation */
  std::array<dealii::Tensor<1, 2>, 3>
  barycentric_gradients(const std::array<dealii::Point<dim>, 3> &corners);

  /** Continuous, piecewise linear field on a triangular mesh in the x-y plane.
   *  The field is zero outside the mesh and, in three dimensions, uniform along
   *  z. */
  class TriangleField
  {
  public:
    using Cell = std::array<unsigned int, 3>;

    /** Constructs the field from vertex coordinates (m), cells and field values
     *  at the vertices. */
    TriangleField(std::vector<dealii::Point<dim>> vertices,
                  std::vector<Cell>               cells,
                  std::vector<double>             values);

    double
    value(const dealii::Point<dim> &x) const;

    /** Gradient of the field in the triangle that contains x (field unit per
     *  metre). */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

  private:
    /** Location of a point: index of the triangle that contains the point, and
     *  barycentric coordinates. */
    struct At
    {
      unsigned int          cell;
      std::array<double, 3> barycentric;
    };

    /** Locates the point x in the mesh. No value is returned for a point
     *  outside the mesh. */
    std::optional<At>
    locate(const dealii::Point<dim> &x) const;

    std::array<dealii::Tensor<1, 2>, 3>
    gradients(const unsigned int cell) const
    {
      const auto &[i, j, k] = cells[cell];
      return barycentric_gradients({{vertices[i], vertices[j], vertices[k]}});
    }

    /** Column and row of the search box that contains the point (x, y). For
     *  points outside all boxes, the nearest column and row are returned. */
    std::array<unsigned int, 2>
    box_at(const double x, const double y) const;

    std::vector<dealii::Point<dim>> vertices;
    std::vector<Cell>               cells;
    std::vector<double>             values;

    /** @name Grid of search boxes, with the triangles that overlap each box */
    /** @{ */
    std::array<double, 2>       corner{{0., 0.}}, size{{0., 0.}};
    std::array<unsigned int, 2> n_boxes{{1, 1}};
    std::vector<unsigned int>   start, in_box;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
