// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_divided_at_chords_h
#define geocone_mesh_divided_at_chords_h

#include <geocone/mesh/coarse_mesh.h>

namespace geocone::GEOCONE_DIM
{
  /** Divides triangles at their centroids at those vertices of the outline where too few
   *  of them meet for linear stresses that are free on both sides, but not zero: fewer
   *  than three where it turns by less than 30 degrees, as chords of an arc do, and a
   *  single one at other corners without a right angle, as between chords and a plane of
   *  symmetry. */
  CoarseMesh
  divided_at_chords(CoarseMesh mesh);
} // namespace geocone::GEOCONE_DIM

#endif
