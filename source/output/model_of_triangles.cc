// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/model_of_triangles.h>

#include <deal.II/base/bounding_box.h>

namespace geocone::GEOCONE_DIM
{
  ModelMesh
  model_mesh_of(const Triangles &triangles)
  {
    ModelMesh mesh;
    mesh.materials = triangles.material;
    const auto corners =
      dealii::BoundingBox<dim>(triangles.vertices).get_boundary_points();
    mesh.box = {{corners.first, corners.second}};
    for (const auto &cell : triangles.cells)
      mesh.cells.push_back({triangles.vertices[cell[0]],
                            triangles.vertices[cell[1]],
                            triangles.vertices[cell[2]]});
    mesh.faces_of = [&](const BoundaryCondition &condition) {
      std::vector<SidePart> faces;
      for (const auto &held : triangles.held_edges(condition))
        {
          const auto &cell = triangles.cells[held.cell];
          const auto  end  = [&](const unsigned int i) {
            return triangles.vertices[cell[(held.opposite_vertex + i) % 3]];
          };
          faces.push_back({{end(1), end(2)}});
        }
      return faces;
    };
    return mesh;
  }
} // namespace geocone::GEOCONE_DIM
