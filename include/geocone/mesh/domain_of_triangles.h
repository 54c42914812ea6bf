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
   * The domain of a mesh of triangles: its outline, holes and sides, and its
   * materials. Other meshes of it are made like those of a polygon: corners of
   * the outline and of the borders between materials stay, the straight lines
   * between them obtain vertices of their own.
   */
  class DomainOfTriangles
  {
  public:
    /** @param is_end whether a vertex of the outline must stay one, e.g. where a
     *  condition ends on a side */
    DomainOfTriangles(
      const Triangles                                       &triangles,
      const std::function<bool(const dealii::Point<dim> &)> &is_end);

    /** Why no other mesh can be made of it; empty if one can. */
    const std::string &
    obstacle() const
    {
      return why_not;
    }

    /** A mesh with prescribed sizes. Collective.
     *  @param lines that become edges, too @param algorithm gmsh's number */
    CoarseMesh
    mesh(const CellSizes &sizes,
         MeshLines        lines,
         const int        algorithm,
         const MPI_Comm   comm) const;

  private:
    /** Ends of an edge of the boundary, with its boundary id. */
    struct Side
    {
      std::array<dealii::Point<dim>, 2> ends;
      dealii::types::boundary_id        id;
    };

    std::string       why_not;
    MeshDomain        domain;
    MeshLines         borders; ///< of materials
    std::vector<Side> sides;
    Triangles         triangles;
  };

  /** The domain of the mesh of a file. Vertices where the boxes of conditions
   *  end stay. */
  DomainOfTriangles
  domain_of_file(const Triangles &triangles, const Scene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
