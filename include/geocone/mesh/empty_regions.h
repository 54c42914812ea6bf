// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_empty_regions_h
#define geocone_mesh_empty_regions_h

#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Checks that no material region is empty. @throws InputError if a material
   *  that must occupy a region has no cell
   *  @param n_cells number of cells by material, over all ranks */
  void
  refuse_empty_regions(const Scene                     &scene,
                       const std::vector<unsigned int> &n_cells);
} // namespace geocone::GEOCONE_DIM

#endif
