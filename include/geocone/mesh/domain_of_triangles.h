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
    /** Constructs the remeshing domain of a triangular mesh. @param is_end
     *  whether a vertex of the outline must be retained, e.g. where a condition
     *  ends on a side */
    DomainOfTriangles(
      const Triangles                                       &triangles,
      const std::function<bool(const dealii::Point<dim> &)> &is_end);

    /** Reason why the domain cannot be remeshed; empty if remeshing is
     *  possible. */
    const std::string &
    obstacle() const
    {
      return why_not;
    }

    /** Creates a new mesh of the domain with prescribed cell sizes. Collective.
     *  @param lines additional lines that become edges @param algorithm number
     *  of gmsh's meshing algorithm */
    CoarseMesh
    mesh(const CellSizes &sizes,
         MeshLines        lines,
         const int        algorithm,
         const MPI_Comm   comm) const;

  private:
    /** Boundary edge, defined by end points and boundary id. */
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

  /** Domain of a mesh that was read from a file. The vertices where the boxes
   *  of boundary conditions end are retained. */
  DomainOfTriangles
  domain_of_file(const Triangles &triangles, const Scene &scene);
} // namespace geocone::GEOCONE_DIM

#endif
