// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/model_of_tetrahedra.h>

#include <deal.II/base/bounding_box.h>

#include <utility>

namespace geocone::GEOCONE_DIM
{
  ModelMesh
  model_mesh_of(const Tetrahedra &tetrahedra)
  {
    const auto face_of = [&](const unsigned int f) {
      ModelMesh::Face face;
      for (const unsigned int v : tetrahedra.facets[f].vertices)
        face.push_back(tetrahedra.vertices[v]);
      if (cross_product_3d(face[1] - face[0], face[2] - face[0]) *
            tetrahedra.normal(f) <
          0.)
        std::swap(face[1], face[2]);
      return face;
    };
    ModelMesh  mesh;
    const auto corners =
      dealii::BoundingBox<dim>(tetrahedra.vertices).get_boundary_points();
    mesh.box = {{corners.first, corners.second}};
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      if (const auto &cells = tetrahedra.facets[f].cells;
          cells[1] == Tetrahedra::none)
        {
          mesh.cells.push_back(face_of(f));
          mesh.materials.push_back(tetrahedra.material[cells[0]]);
        }
    mesh.faces_of = [&tetrahedra, face_of](const BoundaryCondition &condition) {
      std::vector<SidePart> faces;
      for (const unsigned int f : tetrahedra.held_facets(condition))
        faces.push_back({face_of(f)});
      return faces;
    };
    return mesh;
  }
} // namespace geocone::GEOCONE_DIM
