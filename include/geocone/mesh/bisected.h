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

  /** Refines a mesh by bisecting the marked triangles at their longest edges.
   *  Further triangles are bisected until the mesh is conforming (Rivara 1984).
   *  All angles are at least half of the smallest angle of the first mesh.
   *  @param marked whether each triangle is to be divided */
  NestedMesh
  bisected(const NestedMesh &nested, const std::vector<bool> &marked);
} // namespace geocone::GEOCONE_DIM

#endif
