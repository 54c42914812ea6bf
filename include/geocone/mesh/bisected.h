// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_bisected_h
#define geocone_mesh_bisected_h

#include <geocone/mesh/coarse_mesh.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Triangular mesh in which each triangle lies inside a triangle of the first
   *  mesh. */
  struct NestedMesh
  {
    explicit NestedMesh(const CoarseMesh &first);

    CoarseMesh                mesh;
    std::vector<unsigned int> parent; ///< triangle of the first mesh
  };

  /** Refines a mesh by bisecting the triangles with the largest contributions to an
   *  error at their longest edges. Further triangles are bisected until the mesh is
   *  conforming (Rivara 1984). All angles are at least half of the smallest angle of the
   *  first mesh. The error of a half is assumed to scale with the area A as A^(3/2).
   *  @param error contribution of each triangle, >= 0
   *  @param n_wanted number of triangles; conformity adds a few more
   *  @return the same mesh if no triangle contributes */
  NestedMesh
  bisected(NestedMesh          nested,
           std::vector<double> error,
           const std::size_t   n_wanted);
} // namespace geocone::GEOCONE_DIM

#endif
