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
   * Creates the mesh of a scene, with material ids of cells and boundary ids of
   * sides. Collective.
   * @param parameters prepared for the scene and the method
   * @param sizes cell sizes that replace the parameters; the mesh is then
   * created by gmsh
   * @param parts_bodies whether to split the mesh between bodies in contact
   * (not for particles)
   * @throws InputError
   */
  CoarseMesh
  fitted_mesh(const MeshParameters &parameters,
              const Scene          &scene,
              const MPI_Comm        comm,
              const CellSizes      *sizes        = nullptr,
              const bool            parts_bodies = true);

  /**
   * Creates a triangular mesh of the body with gmsh, or reads the mesh file of
   * the scene. Materials and sides are assigned. Collective.
   * @param vertices points on the outline that become vertices of the mesh
   * @param lines lines that become edges of the mesh, as far as they lie in the
   * body
   * @param sizes of the cells
   */
  CoarseMesh
  triangles_of_body(const Scene                           &scene,
                    const std::vector<dealii::Point<dim>> &vertices,
                    const MeshLines                       &lines,
                    const CellSizes                       &sizes,
                    const MPI_Comm                         comm);

  /**
   * Boundary ids of the sides on which a boundary condition acts.
   * @param sides boundary ids by side name
   * @param all boundary ids of the complete boundary, for the name "all"
   * @throws InputError if no side has the given name
   */
  std::set<dealii::types::boundary_id>
  side_ids(const BoundaryPart                                      &condition,
           const std::map<std::string, dealii::types::boundary_id> &sides,
           const std::vector<dealii::types::boundary_id>           &all);
} // namespace geocone::GEOCONE_DIM

#endif
