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
   * Computes cell sizes that equalise the contributions of the triangles to the gap
   * between strict bounds. The sizes are for a mesh of about MeshParameters::number
   * triangles, for incremental analyses of the limit load. Starting from the mesh of the
   * other parameters, the number of triangles is doubled until it is reached; three more
   * meshes of this number refine singularities further. Flow is assumed to be associated.
   * Collective; the first rank computes and also returns the bracket of the load, with
   * Davis's estimate for non-associated flow.
   * @throws InputError for scenes without finite bounds on the load
   */
  std::pair<CellSizes, LoadBracket>
  sizes_from_bounds(const MeshParameters &parameters,
                    const Scene          &scene,
                    const MPI_Comm        comm,
                    Log                  &log);
} // namespace geocone::GEOCONE_DIM

#endif
