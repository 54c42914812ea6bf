// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_consistent_integration_h
#define geocone_points_consistent_integration_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/points/material_points.h>
#include <geocone/space/space.h>

#include <deal.II/base/bounding_box.h>

namespace geocone::GEOCONE_DIM
{
  /** A part of a held side of the body normal to an axis: soil is on one side of it. */
  struct SoilLimit
  {
    unsigned int             axis;
    double                   level;         ///< coordinate along the axis (m)
    bool                     soil_is_below; ///< at smaller coordinates
    dealii::BoundingBox<dim> extent;        ///< its thickness does not matter
  };

  /**
   * Integration over points that is exact for constant stresses, cell by cell
   * (variationally consistent integration of first order; Chen, Hillman and Rueter,
   * International Journal for Numerical Methods in Engineering 95, 2013). In a cell that
   * is full of soil, with the part |c| of its volume on the soil's side of the limits,
   *
   *   w_p   = V_p |c| / sum_q V_q ,
   *   g_p,i = grad N_i(x_p) + 1/|c| ( int_c grad N_i - sum_q w_q grad N_i(x_q) ) ,
   *
   * so that sum_p w_p g_p,i = int_c grad N_i wherever the points are: constant stress is
   * in balance, and the strain of a linear velocity remains exact. Around an axis the
   * integrals are over 2 pi r dA and N_i/r is corrected likewise. Volumes, masses and
   * values N_i stay.
   *
   * Full are cells whose neighbours are all filled to two fifths (or lie beyond a
   * limit), cells at a surface filled to 3 %, and cells that a limit cuts. Where the
   * part of such a cell has no points, the cell beside it stands for it. In other cells
   * w_p = V_p and nothing changes; points beyond a limit have no weight.
   * @pre the cells are boxes, the axes' lines a grid. Collective.
   */
  void
  make_consistent(const BackgroundMesh         &mesh,
                  const Space                  &space,
                  const std::vector<SoilLimit> &limits,
                  MaterialPoints               &points);
} // namespace geocone::GEOCONE_DIM

#endif
