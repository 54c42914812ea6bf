// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_domain_of_triangles_h
#define geocone_mesh_domain_of_triangles_h

#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/triangles.h>
#include <geocone/scene/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Domain of a triangular mesh for remeshing: outline, holes, sides and
   * materials. A new mesh retains the corners of the outline and of material
   * interfaces; straight lines between corners obtain new vertices.
   */
  class DomainOfTriangles
  {
  public:
    /** @param is_end whether a vertex of the outline must be retained, e.g.
     *  where a condition ends on a side */
    DomainOfTriangles(
      const Triangles                                       &triangles,
      const std::function<bool(const dealii::Point<dim> &)> &is_end);

    /** Reason why the domain cannot be remeshed; empty if it can. */
    const std::string &
    obstacle() const
    {
      return why_not;
    }

    /** New mesh of the domain with prescribed cell sizes. Collective.
     *  @param lines additional lines that become edges @param algorithm number
     *  of gmsh's meshing algorithm */
    CoarseMesh
    mesh(const CellSizes &sizes,
         MeshLines        lines,
         const int        algorithm,
         const MPI_Comm   comm) const;

  private:
    /** Boundary edge, given by its end points and boundary id. */
    struct Side
    {
      std::array<dealii::Point<dim>, 2> ends;
      dealii::types::boundary_id        id;
    };

    std::string       why_not;
    MeshDomain        domain;
    MeshLines         borders; ///< interfaces of materials
    std::vector<Side> sides;
    Triangles         triangles;
  };

  /** Domain of the mesh in a file; retains the vertices where boxes of boundary
   *  conditions end. */
  DomainOfTriangles
  domain_of_file(const Triangles &triangles, const Scene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
