// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_adapted_sizes_h
#define geocone_mesh_adapted_sizes_h

#include <geocone/base/state_row.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/triangles.h>

#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Computes the cell sizes of an adapted mesh such that all cells contribute
   * equally to a given error measure (e.g. the gap between bounds).
   * Contributions scale with the cube of the cell size. Contributions are
   * averaged over neighbouring cells: a coarse cell beside refined ones would
   * otherwise be refined one mesh later.
   * @param error contribution of each cell
   * @param n_wanted approximate number of triangles
   * @param fans of the mesh; they become smaller as other cells do, and
   * their sizes are those of their outer edges
   */
  CellSizes
  adapted_sizes(const Triangles           &triangles,
                const std::vector<double> &error,
                const double               n_wanted,
                std::vector<Fan>           fans = {});

  /** Saves or restores cell sizes, if there are any. */
  void
  state_of_sizes(StateRow &row, std::optional<CellSizes> &sizes);
} // namespace geocone::GEOCONE_DIM

#endif
