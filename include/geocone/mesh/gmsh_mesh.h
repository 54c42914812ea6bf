// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_gmsh_mesh_h
#define geocone_mesh_gmsh_mesh_h

#include <geocone/boundary/contacts.h>
#include <geocone/geometry/fan.h>
#include <geocone/geometry/regions.h>
#include <geocone/mesh/coarse_mesh.h>
#include <geocone/mesh/mesh_parameters.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Estimated number of cells of an unstructured mesh with the cell size field
   * h(x). Triangles are nearly equilateral, so that the number of triangles is
   *   4/sqrt(3) times the integral of 1/h^2 over the domain;
   * each pair of triangles becomes four quadrilaterals. Within a factor of 2 of
   * gmsh's number, unless edges of materials force small cells.
   */
  double
  unstructured_size(const MeshParameters &parameters);

  /** Straight lines that become mesh edges inside the domain. */
  using MeshLines = std::vector<std::array<dealii::Point<dim>, 2>>;

  /** Creates an unstructured mesh of a box or polygon with gmsh. Collective. */
  CoarseMesh
  unstructured_mesh(const MeshParameters &parameters,
                    const Regions        &regions,
                    const MeshLines      &lines,
                    const MPI_Comm        comm);

  /** Prescribed cell sizes of an unstructured mesh (m), piecewise linear on
   *  triangles that cover the domain, with its fans of triangles. */
  struct CellSizes
  {
    std::vector<std::array<dealii::Point<dim>, 3>> triangles;
    std::vector<std::array<double, 3>>             sizes; ///< at the corners
    std::vector<Fan> fans = {}; ///< in plane meshes only
  };

  /** Domain of an unstructured mesh: outline, holes, prescribed edges and
   *  vertices. */
  struct MeshDomain
  {
    Polygon                         outline;
    std::vector<Polygon>            holes;
    std::vector<Polygon>            inner;    ///< polygons of mesh edges
    std::vector<dealii::Point<dim>> vertices; ///< prescribed vertices
    int                             algorithm      = 5; ///< number in gmsh
    bool                            quadrilaterals = false;
  };

  MeshDomain
  domain_of(const MeshParameters &parameters);

  /** Creates an unstructured mesh with prescribed cell sizes. Collective. */
  CoarseMesh
  mesh_with_sizes(const MeshDomain     &domain,
                  const Regions        &regions,
                  const MeshLines      &lines,
                  const CellSizes      &sizes,
                  const MPI_Comm        comm);

  /**
   * Reads a mesh from a .msh file (see msh_file.h), or generates it from a .geo
   * script if scripts are allowed. Collective: the first rank reads the file or
   * runs the script.
   * @param contacts contacts along which nodes of bodies can be separate, or
   * null
   * @throws InputError if the file is neither, or the mesh is not supported
   */
  CoarseMesh
  mesh_of_file(const Geometry &geometry,
               const Regions  &regions,
               const Contacts *contacts,
               const MPI_Comm  comm);
} // namespace geocone::GEOCONE_DIM

#endif
