// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_space_vertex_interpolation_h
#define geocone_space_vertex_interpolation_h

#include <geocone/linear/nodal_rows.h>
#include <geocone/space/space.h>

namespace geocone::GEOCONE_DIM
{
  /** Returns true for finite elements of degree 2 and 3. */
  inline bool
  has_vertex_interpolation(const Space &space)
  {
    return !space.is_spline() && space.degree() > 1 && !space.has_ties();
  }

  /**
   * Computes the interpolation of nodal values from the vertices of the mesh,
   * with linear shape functions on simplices and bilinear or trilinear ones on
   * other cells. The space must have such an interpolation.
   */
  VertexInterpolation
  interpolation_from_vertices(const BackgroundMesh &mesh, const Space &space);
} // namespace geocone::GEOCONE_DIM

#endif
