// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_msh_mesh_h
#define geocone_mesh_msh_mesh_h

#include <geocone/boundary/contacts.h>
#include <geocone/geometry/regions.h>
#include <geocone/mesh/coarse_mesh.h>
#include <geocone/mesh_files/msh_file.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Creates the mesh from the cells of a .msh file. Vertices are ordered by
   * their first use in cells; cells by surface, with the triangles of each
   * surface first. Edges of physical curves form the sides.
   * @param contacts contacts between bodies whose nodes can be separate, or
   * null
   * @throws InputError if nodes are missing, not finite, not in the plane z =
   * 0, or too close together for their coordinates; if there are no cells, or
   * some are inverted, overlap, or have hanging nodes
   */
  CoarseMesh
  coarse_mesh(const MshData     &data,
              const std::string &what,
              const Regions     &regions,
              const Contacts    *contacts = nullptr);
} // namespace geocone::GEOCONE_DIM

#endif
