// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_fitted_mesh_h
#define geocone_mesh_fitted_mesh_h

#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/scene/scene.h>

#include <array>
#include <set>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Mesh of a scene, with the materials of its cells and the sides of its
   * boundary. Collective.
   * @param parameters prepared for the scene and the method
   * @param sizes replace those of the parameters; gmsh then makes the mesh
   * @param parts_bodies whether to split it between bodies in contact (not for
   * particles)
   * @throws InputError
   */
  CoarseMesh
  fitted_mesh(const MeshParameters &parameters,
              const Scene          &scene,
              const MPI_Comm        comm,
              const CellSizes      *sizes        = nullptr,
              const bool            parts_bodies = true);

  /**
   * Mesh of triangles of the body of a scene, with its materials and sides: by gmsh, or
   * that of the file. Collective.
   * @param vertices on the outline that become vertices of the mesh
   * @param lines that become edges of it, as far as they lie in the body
   * @param sizes of the cells
   */
  CoarseMesh
  triangles_of_body(const Scene                           &scene,
                    const std::vector<dealii::Point<dim>> &vertices,
                    const MeshLines                       &lines,
                    const CellSizes                       &sizes,
                    const MPI_Comm                         comm);

  /**
   * Side numbers of a condition.
   * @param sides their names
   * @param all numbers of the complete boundary, for "all"
   * @throws InputError for a name without a side
   */
  std::set<dealii::types::boundary_id>
  side_ids(const BoundaryPart                                      &condition,
           const std::map<std::string, dealii::types::boundary_id> &sides,
           const std::vector<dealii::types::boundary_id>           &all);
} // namespace geocone::GEOCONE_DIM

#endif
