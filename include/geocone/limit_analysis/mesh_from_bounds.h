// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_mesh_from_bounds_h
#define geocone_limit_analysis_mesh_from_bounds_h

#include <geocone/base/log.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/output/load_bracket.h>

#include <utility>

namespace geocone::GEOCONE_DIM
{
  /**
   * The sizes of a mesh of about MeshParameters::number triangles on which a step
   * can find the limit load of a scene: those that make the parts of the triangles
   * in the gap of its strict bounds equal. Meshes grow twofold from that of the
   * other parameters until they have as many triangles, and three more of that size
   * follow: what is singular becomes finer each time. Flow counts as associated.
   * Collective; the first rank computes, and has the bracket of the load on the way,
   * with Davis's estimate where flow is not associated.
   * @throws InputError for scenes that have no such bounds
   */
  std::pair<CellSizes, LoadBracket>
  sizes_from_bounds(const MeshParameters &parameters,
                    const Scene          &scene,
                    const MPI_Comm        comm,
                    Log                  &log);
} // namespace geocone::GEOCONE_DIM

#endif
