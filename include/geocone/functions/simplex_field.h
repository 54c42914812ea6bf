// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_functions_simplex_field_h
#define geocone_functions_simplex_field_h

#include <geocone/functions/lagrange_simplex.h>

#include <deal.II/base/point.h>

#include <array>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Gradients of the barycentric coordinates of a triangle or tetrahedron
   *  (1/m). @param corners of the simplex, in either orientation */
  std::array<dealii::Tensor<1, dim>, dim + 1>
  barycentric_gradients(const std::array<dealii::Point<dim>, dim + 1> &corners);

  /** Continuous field on a mesh of triangles, or of tetrahedra in three
   *  dimensions, linear or of a higher degree in each cell. The field is zero
   *  outside the mesh. */
  class SimplexField
  {
  public:
    using Cell = std::array<unsigned int, dim + 1>;

    /** Constructs the field from vertex coordinates (m), cells and field values
     *  at the vertices. */
    SimplexField(std::vector<dealii::Point<dim>> vertices,
                 std::vector<Cell>               cells,
                 std::vector<double>             values);

    /** Constructs a field of a higher degree.
     *  @param nodes of each cell, in the order of LagrangeSimplex::nodes()
     *  @param values at the nodes */
    SimplexField(std::vector<dealii::Point<dim>>        vertices,
                 std::vector<Cell>                      cells,
                 const unsigned int                     degree,
                 std::vector<std::vector<unsigned int>> nodes,
                 std::vector<double>                    values);

    double
    value(const dealii::Point<dim> &x) const;

    /** Gradient of the field in the cell that contains x (field unit per
     *  metre). */
    dealii::Tensor<1, dim>
    gradient(const dealii::Point<dim> &x) const;

  private:
    /** Location of a point: index of the cell that contains the point, and
     *  barycentric coordinates. */
    struct At
    {
      unsigned int                 cell;
      LagrangeSimplex::Barycentric barycentric;
    };

    /** Locates the point x in the mesh. No value is returned for a point
     *  outside the mesh. */
    std::optional<At>
    locate(const dealii::Point<dim> &x) const;

    std::array<dealii::Tensor<1, dim>, dim + 1>
    gradients(const unsigned int cell) const;

    using Box = std::array<unsigned int, dim>;

    /** Place in the grid of the search box that contains the point x. For
     *  points outside all boxes, the nearest box is returned. */
    Box
    box_at(const std::array<double, dim> &x) const;

    unsigned int
    number_of(const Box &box) const;

    /** Calls a function for the numbers of all boxes that overlap a cell. */
    template <typename Function>
    void
    for_boxes_of(const Cell &cell, const Function &f) const;

    /** Value at a node of a cell. */
    double
    at_node(const unsigned int cell, const unsigned int i) const
    {
      return values[nodes.empty() ? cells[cell][i] : nodes[cell][i]];
    }

    std::vector<dealii::Point<dim>>        vertices;
    std::vector<Cell>                      cells;
    LagrangeSimplex                        shape;
    std::vector<std::vector<unsigned int>> nodes; ///< empty: vertices
    std::vector<double>                    values;

    /** @name Grid of search boxes, with the cells that overlap each box */
    /** @{ */
    std::array<double, dim>   corner, size;
    Box                       n_boxes;
    std::vector<unsigned int> start, in_box;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
