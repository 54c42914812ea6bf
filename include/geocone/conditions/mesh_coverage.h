// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_conditions_mesh_coverage_h
#define geocone_conditions_mesh_coverage_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Returns a warning for each boundary condition whose nodes, and each traction
   *  with a formula whose whole faces, are not as wide as the selected part of the
   *  boundary. Collective. */
  std::vector<std::string>
  warn_of_partial_coverage(const Scene          &scene,
                           const BackgroundMesh &mesh,
                           const Space          &space);

  /** Returns a warning for each traction that acts for the most part along
   *  velocities that boundary conditions prescribe in all stages, so that the body
   *  carries little of it. For methods whose mesh fits the body. Collective. */
  std::vector<std::string>
  warn_of_held_tractions(const Scene          &scene,
                         const BackgroundMesh &mesh,
                         const Space          &space);

  /** Returns a warning for each material region and each excavation whose cells
   *  differ in volume from the region in the mesh by more than 2 %: cells belong
   *  to regions by their centres. For methods whose points are those of cells.
   *  Collective. */
  std::vector<std::string>
  warn_of_cut_cells(const Scene &scene, const BackgroundMesh &mesh);

  /** Returns a warning of pore pressures that change within a cell by more than
   *  the seepage forces at its points, or nothing. Collective. */
  std::string
  warn_of_steep_water(const Scene &scene, const BackgroundMesh &mesh);
} // namespace geocone::GEOCONE_DIM

#endif
