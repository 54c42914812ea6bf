// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_bisected_h
#define geocone_mesh_bisected_h

#include <geocone/mesh/coarse_mesh.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Mesh of triangles, each inside of a triangle of a first mesh. */
  struct NestedMesh
  {
    explicit NestedMesh(const CoarseMesh &first);

    CoarseMesh                mesh;
    std::vector<unsigned int> parent; ///< triangle of the first mesh
  };

  /** Bisects marked triangles at their longest edges, and others until the mesh conforms
   *  (Rivara 1984): angles stay above half of the smallest one.
   *  @param marked whether each triangle is to be divided */
  NestedMesh
  bisected(const NestedMesh &nested, const std::vector<bool> &marked);
} // namespace geocone::GEOCONE_DIM

#endif
