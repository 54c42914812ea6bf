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
  /** Gradients of the barycentric coordinates of a triangle along x and y (1/m).
   *  @param corners in either orientation */
  std::array<dealii::Tensor<1, 2>, 3>
  barycentric_gradients(const std::array<dealii::Point<dim>, 3> &corners);

  /** A continuous field that is linear in each triangle of a mesh of the plane, in three
   *  dimensions uniform along z, and zero outside of the mesh. */
  class TriangleField
  {
  public:
    using Cell = std::array<unsigned int, 3>;

    /** @param vertices their coordinates (m) @param values at the vertices */
    TriangleField(std::vector<dealii::Point<dim>> vertices,
                  std::vector<Cell>               cells,
                  std::vector<double>             values);

    double
    value(const dealii::Point<dim> &x) const;

    /** Gradient in the triangle at x (per m). */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

  private:
    /** A triangle, and the barycentric coordinates of a point in it. */
    struct At
    {
      unsigned int          cell;
      std::array<double, 3> parts;
    };

    /** The triangle around x; none outside of the mesh. */
    std::optional<At>
    locate(const dealii::Point<dim> &x) const;

    std::array<dealii::Tensor<1, 2>, 3>
    gradients(const unsigned int cell) const
    {
      const auto &[i, j, k] = cells[cell];
      return barycentric_gradients({{vertices[i], vertices[j], vertices[k]}});
    }

    /** Column and row of the box around x, within the grid of boxes. */
    std::array<unsigned int, 2>
    box_at(const double x, const double y) const;

    std::vector<dealii::Point<dim>> vertices;
    std::vector<Cell>               cells;
    std::vector<double>             values;

    /** @name Grid of boxes, with the triangles that overlap each */
    /** @{ */
    std::array<double, 2>       corner{{0., 0.}}, size{{0., 0.}};
    std::array<unsigned int, 2> n_boxes{{1, 1}};
    std::vector<unsigned int>   start, in_box;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
