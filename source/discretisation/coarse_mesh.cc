// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/discretisation/coarse_mesh.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>

namespace geocone
{
  using dealii::Point;

  bool
  CoarseMesh::has_simplices() const
  {
    return std::any_of(cells.begin(), cells.end(), [](const auto &cell) {
      return cell.vertices.size() == dim + 1;
    });
  }

  Point<dim>
  CoarseMesh::centre(const dealii::CellData<dim> &cell) const
  {
    Point<dim> sum;
    for (const unsigned int v : cell.vertices)
      sum += points[v];
    return sum / double(cell.vertices.size());
  }

  CoarseMesh::Face
  CoarseMesh::sorted(Face face)
  {
    std::sort(face.begin(), face.end());
    return face;
  }

  std::vector<CoarseMesh::Face>
  CoarseMesh::outer_faces() const
  {
    // By their sorted vertices, which neighbours share.
    std::vector<std::pair<Face, Face>> faces;
    for (const auto &cell : cells)
      {
        const auto reference =
          dealii::ReferenceCell::n_vertices_to_type(dim, cell.vertices.size());
        for (const unsigned int f : reference.face_indices())
          {
            Face face;
            face.fill(no_vertex);
            for (unsigned int i = 0;
                 i < reference.face_reference_cell(f).n_vertices();
                 ++i)
              face[i] =
                cell.vertices[reference.face_to_cell_vertices(f, i, true)];
            faces.emplace_back(sorted(face), dim == 2 ? sorted(face) : face);
          }
      }
    std::sort(faces.begin(), faces.end());
    std::vector<Face> outer;
    for (std::size_t i = 0, j; i < faces.size(); i = j)
      {
        for (j = i; j < faces.size() && faces[j].first == faces[i].first;)
          ++j;
        if (j == i + 1)
          outer.push_back(faces[i].second);
      }
    return outer;
  }

  Point<dim>
  CoarseMesh::centre(const Face &face) const
  {
    Point<dim>   sum;
    unsigned int n = 0;
    for (const unsigned int v : face)
      if (v != no_vertex)
        {
          sum += points[v];
          ++n;
        }
    return sum / double(n);
  }

  void
  CoarseMesh::add_boundary(const Face                      &face,
                           const dealii::types::boundary_id side)
  {
    if constexpr (dim == 2)
      {
        dealii::CellData<1> line(2);
        line.vertices    = {face[0], face[1]};
        line.boundary_id = side;
        boundary.boundary_lines.push_back(line);
      }
    else
      {
        dealii::CellData<2> quad(face.back() == no_vertex ? 3 : 4);
        std::copy_n(face.begin(), quad.vertices.size(), quad.vertices.begin());
        quad.boundary_id = side;
        boundary.boundary_quads.push_back(quad);
      }
  }
} // namespace geocone
