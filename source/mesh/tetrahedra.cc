// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/functions/simplex_field.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/mesh/tetrahedra.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    using Triple = std::array<unsigned int, 3>;

    Triple
    sorted_triple(Triple vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    }

    /** Six tetrahedra of a hexahedron with edges along the axes, around its diagonal in
     *  the direction (1, 1, 1): those of neighbours match. */
    std::vector<std::array<unsigned int, 4>>
    tetrahedra_of(const std::vector<Point<dim>>   &points,
                  const std::vector<unsigned int> &vertices)
    {
      Point<dim> centre;
      for (const unsigned int v : vertices)
        centre += points[v] / 8.;
      std::array<unsigned int, 8> corner;
      for (const unsigned int v : vertices)
        {
          unsigned int place = 0;
          for (unsigned int d = 0; d < dim; ++d)
            place += (points[v][d] > centre[d]) << d;
          corner[place] = v;
        }
      std::vector<std::array<unsigned int, 4>> all;
      std::array<unsigned int, 3>              axes = {{0, 1, 2}};
      do
        {
          const unsigned int a = 1u << axes[0], b = 1u << axes[1];
          all.push_back({{corner[0], corner[a], corner[a + b], corner[7]}});
        }
      while (std::next_permutation(axes.begin(), axes.end()));
      return all;
    }

    /** Six tetrahedra of any hexahedron, with a common vertex, that of the smallest
     *  number. The diagonal of each face starts at its smallest vertex, so that those of
     *  neighbours match. @param vertices in lexicographic order */
    std::vector<std::array<unsigned int, 4>>
    tetrahedra_at_first(const std::vector<unsigned int> &vertices)
    {
      const unsigned int first =
        std::min_element(vertices.begin(), vertices.end()) - vertices.begin();
      std::vector<std::array<unsigned int, 4>> all;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          // The face across the axis, in cyclic order, without the first vertex.
          const unsigned int a                   = 1u << (axis + 1) % dim,
                             b                   = 1u << (axis + 2) % dim,
                             from                = ~first & (1u << axis);
          const std::array<unsigned int, 4> face = {{vertices[from],
                                                     vertices[from + a],
                                                     vertices[from + a + b],
                                                     vertices[from + b]}};
          const unsigned int                k =
            std::min_element(face.begin(), face.end()) - face.begin();
          for (const unsigned int next : {1, 2})
            all.push_back({{vertices[first],
                            face[k],
                            face[(k + next) % 4],
                            face[(k + next + 1) % 4]}});
        }
      return all;
    }

    /** Area of the part of a polygon that is in a box. */
    double
    area_in_box(std::vector<Point<dim>>          polygon,
                const std::array<Point<dim>, 2> &box)
    {
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int end = 0; end < 2; ++end)
          {
            const auto beyond = [&](const Point<dim> &x) {
              return end == 0 ? box[0][d] - x[d] : x[d] - box[1][d];
            };
            std::vector<Point<dim>> rest;
            for (std::size_t i = 0; i < polygon.size(); ++i)
              {
                const Point<dim> &x = polygon[i],
                                 &y = polygon[(i + 1) % polygon.size()];
                const double a = beyond(x), b = beyond(y);
                if (a <= 0.)
                  rest.push_back(x);
                if ((a < 0. && b > 0.) || (a > 0. && b < 0.))
                  rest.push_back(Point<dim>(x + a / (a - b) * (y - x)));
              }
            polygon = std::move(rest);
          }
      Tensor<1, dim> sum;
      for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += cross_product_3d(polygon[i - 1] - polygon[0],
                                polygon[i] - polygon[0]);
      return sum.norm() / 2.;
    }
  } // namespace

  Tetrahedra::Tetrahedra(const CoarseMesh &mesh)
    : vertices(mesh.points)
    , sides(mesh.sides)
  {
    for (const auto &cell : mesh.cells)
      {
        if (cell.vertices.size() == 4)
          cells.push_back({{cell.vertices[0],
                            cell.vertices[1],
                            cell.vertices[2],
                            cell.vertices[3]}});
        else
          for (const auto &part : mesh.grid[0].empty()
                                    ? tetrahedra_at_first(cell.vertices)
                                    : tetrahedra_of(vertices, cell.vertices))
            cells.push_back(part);
        material.resize(cells.size(), cell.material_id);
      }

    const std::map<Triple, unsigned int> number = connect();
    for (const auto &face : mesh.boundary.boundary_quads)
      for (unsigned int left_out = 0; left_out < face.vertices.size();
           ++left_out)
        {
          // Of a quadrilateral two of four triples are facets.
          if (face.vertices.size() == 3 && left_out > 0)
            break;
          Triple       triple;
          unsigned int n = 0;
          for (unsigned int i = 0; i < face.vertices.size(); ++i)
            if (face.vertices.size() == 3 || i != left_out)
              triple[n++] = face.vertices[i];
          if (const auto found = number.find(sorted_triple(triple));
              found != number.end())
            facets[found->second].side = face.boundary_id;
        }
  }

  std::map<Triple, unsigned int>
  Tetrahedra::connect()
  {
    facets.clear();
    facets_of_cell.clear();
    std::map<Triple, unsigned int> number;
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        if (volume(c) < 0.)
          std::swap(cells[c][2], cells[c][3]);
        facets_of_cell.emplace_back();
        for (unsigned int i = 0; i < 4; ++i)
          {
            const Triple own           = sorted_triple({{cells[c][(i + 1) % 4],
                                                         cells[c][(i + 2) % 4],
                                                         cells[c][(i + 3) % 4]}});
            const auto [entry, is_new] = number.emplace(own, facets.size());
            if (is_new)
              facets.push_back({own, {{c, none}}, -1});
            else
              facets[entry->second].cells[1] = c;
            facets_of_cell[c][i] = entry->second;
          }
      }
    return number;
  }

  void
  Tetrahedra::state(StateRow &row)
  {
    std::vector<Triple> outer;
    std::vector<int>    side;
    for (const Facet &facet : facets)
      if (facet.side >= 0)
        {
          outer.push_back(facet.vertices);
          side.push_back(facet.side);
        }
    row(vertices, cells, material, outer, side);
    if (!row.is_read())
      return;
    const std::map<Triple, unsigned int> number = connect();
    for (std::size_t i = 0; i < outer.size(); ++i)
      facets[number.at(outer[i])].side = side[i];
  }

  std::vector<unsigned int>
  Tetrahedra::held_facets(const BoundaryPart &condition) const
  {
    std::set<dealii::types::boundary_id> all;
    for (const Facet &facet : facets)
      if (facet.side >= 0)
        all.insert(facet.side);
    const auto ids     = side_ids(condition, sides, {all.begin(), all.end()});
    const bool has_box = condition.box_corners().has_value();
    std::vector<unsigned int> held;
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        if (facets[f].side < 0 || ids.count(facets[f].side) == 0)
          continue;
        if (has_box)
          {
            std::vector<Point<dim>> corners;
            for (const unsigned int v : facets[f].vertices)
              corners.push_back(vertices[v]);
            const auto   wide = *condition.wide_box();
            const double part = area_in_box(corners, wide) / area(f);
            // The strip by which the box is wider covers more of a small facet.
            const double strip =
              ((*condition.box_corners())[0][0] - wide[0][0]) *
              (corners[0].distance(corners[1]) +
               corners[1].distance(corners[2]) +
               corners[2].distance(corners[0])) /
              area(f);
            const double rounding = 1e-6 + strip;
            if (part < rounding)
              continue;
            if (part < 1. - rounding)
              throw InputError(
                condition.parameter("Box"),
                condition.part(),
                "a box that ends at edges of the mesh",
                format("the facet at (%g, %g, %g) is partly in it, but a bound "
                       "needs the exact part; take 'Mesh/Type' = graded with "
                       "the corners of the box in 'Mesh/Grading points', or a "
                       "mesh file with these edges",
                       corners[0][0],
                       corners[0][1],
                       corners[0][2]));
          }
        held.push_back(f);
      }
    condition.check_selection(held.size());
    return held;
  }

  double
  Tetrahedra::volume(const unsigned int cell) const
  {
    const auto &[i, j, k, l] = cells[cell];
    return cross_product_3d(vertices[j] - vertices[i],
                            vertices[k] - vertices[i]) *
           (vertices[l] - vertices[i]) / 6.;
  }

  Point<dim>
  Tetrahedra::centre(const unsigned int cell) const
  {
    Point<dim> sum;
    for (const unsigned int v : cells[cell])
      sum += vertices[v] / 4.;
    return sum;
  }

  std::array<Tensor<1, dim>, 4>
  Tetrahedra::gradients(const unsigned int cell) const
  {
    const auto &[i, j, k, l] = cells[cell];
    return barycentric_gradients(
      {{vertices[i], vertices[j], vertices[k], vertices[l]}});
  }

  double
  Tetrahedra::area(const unsigned int facet) const
  {
    const auto &[i, j, k] = facets[facet].vertices;
    return cross_product_3d(vertices[j] - vertices[i],
                            vertices[k] - vertices[i])
             .norm() /
           2.;
  }

  Tensor<1, dim>
  Tetrahedra::normal(const unsigned int facet) const
  {
    const unsigned int c = facets[facet].cells[0];
    const auto         g = gradients(c);
    for (unsigned int i = 0; i < 4; ++i)
      if (facets_of_cell[c][i] == facet)
        return -1. * g[i] / g[i].norm();
    return {};
  }

  unsigned int
  Tetrahedra::index_in_cell(const unsigned int cell,
                            const unsigned int vertex) const
  {
    return std::find(cells[cell].begin(), cells[cell].end(), vertex) -
           cells[cell].begin();
  }
} // namespace geocone::GEOCONE_DIM
