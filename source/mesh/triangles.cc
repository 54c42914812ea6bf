// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/functions/simplex_field.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/mesh/triangles.h>
#include <geocone/shapes/part_in_box.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Share of the edge from a to b that is in the box of a condition, snapped to all or
     *  nothing within rounding. */
    double
    share_in_box(const BoundaryPart &condition,
                 const Point<dim>   &a,
                 const Point<dim>   &b)
    {
      const auto corners = condition.box_corners();
      if (!corners)
        return 1.;
      const auto   wide = *condition.wide_box();
      const auto   part = part_in_box(wide, a, b);
      const double share =
        part ? (*part)[0].distance((*part)[1]) / a.distance(b) : 0.;
      const double rounding =
        1e-6 + 3. * ((*corners)[0][0] - wide[0][0]) / a.distance(b);
      return share < rounding ? 0. : share > 1. - rounding ? 1. : share;
    }
  } // namespace

  Triangles::Triangles(const CoarseMesh &mesh)
    : vertices(mesh.points)
    , sides(mesh.sides)
  {
    if (!mesh.cells.empty() && !mesh.has_simplices())
      throw InputError("Geometry/File",
                       "a mesh of quadrilaterals",
                       "a mesh of triangles for strict bounds",
                       "mesh the domain with triangles");
    std::map<std::array<unsigned int, 2>, unsigned int> number;
    const auto sorted = [](const unsigned int a, const unsigned int b) {
      return std::array<unsigned int, 2>{{std::min(a, b), std::max(a, b)}};
    };
    for (const auto &cell : mesh.cells)
      {
        cells.push_back(
          {{cell.vertices[0], cell.vertices[1], cell.vertices[2]}});
        if (area(cells.size() - 1) < 0.)
          std::swap(cells.back()[1], cells.back()[2]);
        material.push_back(cell.material_id);
        edges_of_cell.emplace_back();
        for (unsigned int i = 0; i < 3; ++i)
          {
            const auto ends =
              sorted(cells.back()[(i + 1) % 3], cells.back()[(i + 2) % 3]);
            const auto [entry, is_new] = number.emplace(ends, edges.size());
            if (is_new)
              edges.push_back({ends, -1});
            edges_of_cell.back()[i] = entry->second;
          }
      }
    for (const auto &line : mesh.boundary.boundary_lines)
      edges[number.at(sorted(line.vertices[0], line.vertices[1]))].side =
        line.boundary_id;
  }

  std::vector<Triangles::HeldEdge>
  Triangles::outer_edges() const
  {
    std::vector<HeldEdge> outer;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int i = 0; i < 3; ++i)
        if (edges[edges_of_cell[c][i]].side >= 0)
          outer.push_back({edges_of_cell[c][i], c, i});
    return outer;
  }

  std::vector<std::array<unsigned int, 2>>
  Triangles::edges_between_materials() const
  {
    constexpr unsigned int                   none = -1;
    std::vector<unsigned int>                first(edges.size(), none);
    std::vector<std::array<unsigned int, 2>> all;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (const unsigned int e : edges_of_cell[c])
        if (first[e] == none)
          first[e] = material[c];
        else if (first[e] != material[c])
          all.push_back(edges[e].vertices);
    return all;
  }

  std::vector<Triangles::HeldEdge>
  Triangles::held_edges(const BoundaryPart &condition) const
  {
    std::set<dealii::types::boundary_id> all;
    for (const Edge &edge : edges)
      if (edge.side >= 0)
        all.insert(edge.side);
    const auto ids = side_ids(condition, sides, {all.begin(), all.end()});
    std::vector<HeldEdge> held;
    for (const HeldEdge &outer : outer_edges())
      {
        const Edge &edge = edges[outer.edge];
        if (ids.count(edge.side) == 0)
          continue;
        const Point<dim> &a = vertices[edge.vertices[0]],
                         &b = vertices[edge.vertices[1]];
        const double part   = share_in_box(condition, a, b);
        if (part == 0.)
          continue;
        if (part < 1.)
          throw InputError(
            condition.parameter("Box"),
            condition.part(),
            "a box that ends at vertices of the mesh",
            format("the edge from (%g, %g) to (%g, %g) is partly in it, "
                   "but a bound needs the exact part; add the ends of the "
                   "box to 'Mesh/Grading points'",
                   a[0],
                   a[1],
                   b[0],
                   b[1]));
        held.push_back(outer);
      }
    condition.check_selection(held.size());
    return held;
  }

  double
  Triangles::area(const unsigned int cell) const
  {
    const auto &[i, j, k]  = cells[cell];
    const Tensor<1, dim> a = vertices[j] - vertices[i],
                         b = vertices[k] - vertices[i];
    return (a[0] * b[1] - a[1] * b[0]) / 2.;
  }

  dealii::Point<dim>
  Triangles::centre(const unsigned int cell) const
  {
    const auto &[i, j, k] = cells[cell];
    return dealii::Point<dim>((vertices[i] + Tensor<1, dim>(vertices[j]) +
                               Tensor<1, dim>(vertices[k])) /
                              3.);
  }

  std::array<Tensor<1, dim>, 3>
  Triangles::gradients(const unsigned int cell) const
  {
    const auto &[i, j, k] = cells[cell];
    return barycentric_gradients({{vertices[i], vertices[j], vertices[k]}});
  }
} // namespace geocone::GEOCONE_DIM
