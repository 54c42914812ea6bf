// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_consistent_integration_h
#define geocone_points_consistent_integration_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/points/material_points.h>
#include <geocone/points/soil_part.h>
#include <geocone/space/space.h>
#include <geocone/surfaces/side_part.h>

namespace geocone::GEOCONE_DIM
{
  /** Boundaries of the soil that are known while its points move. */
  struct SoilBoundary
  {
    std::vector<SoilLimit> limits;
    std::vector<SidePart>  loaded; ///< facets of loaded sides
  };

  /**
   * Applies variationally consistent integration of first order to the weights
   * and gradients of material points. In each cell, integration over the points
   * is then exact for a constant stress (Chen, Hillman and Rueter,
   * International Journal for Numerical Methods in Engineering 95, 2013). In a
   * cell full of soil, with the fraction |c| of its volume on the soil's side
   * of the limits and the loaded sides,
   *
   *   w_p   = V_p |c| / sum_q V_q,
   *   g_p,i = grad N_i(x_p) + 1/|c| (int_c grad N_i - sum_q w_q grad N_i(x_q)),
   *
   * so that sum_p w_p g_p,i = int_c grad N_i for any positions of the points: a
   * constant stress is in equilibrium, and the strain of a linear velocity
   * remains exact. In axisymmetry the integrals are over 2 pi r dA, and N_i/r
   * is corrected likewise. Volumes, masses and values N_i do not change.
   *
   * Cells are full if all their neighbours are filled to two fifths (or lie
   * beyond a limit); at a surface, if they are filled to 3 %; and if a limit
   * or a loaded side intersects them. If the soil part of an intersected cell
   * has no points, the adjacent cell represents it. In other cells w_p = V_p and
   * the gradients do not change; points beyond a limit or a loaded side have no
   * weight. Loaded sides with soil beyond them, such as fill of a later stage,
   * limit nothing. @pre the cells are boxes of an axis-aligned grid. Collective.
   */
  void
  make_consistent(const BackgroundMesh &mesh,
                  const Space          &space,
                  const SoilBoundary   &boundary,
                  MaterialPoints       &points);
} // namespace geocone::GEOCONE_DIM

#endif
