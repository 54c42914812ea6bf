// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_plate_points_h
#define geocone_terms_plate_points_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/scene/structures.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Computes the points at which a plate is tied to the body. They are the same
   * on all ranks. They include the corners of the plate's polyline. If the plate
   * has a spacing, the corners are joined by points at most this distance apart;
   * otherwise by the points where the plate crosses cell sides, with @p degree
   * intervals between two crossings. Along sides of the mesh these are the
   * nodes. Crossings very close to others are omitted.
   * @param degree polynomial degree of the displacements
   */
  std::vector<dealii::Point<dim>>
  points_of_plate(const Structure      &plate,
                  const BackgroundMesh &mesh,
                  const unsigned int    degree);
} // namespace geocone::GEOCONE_DIM

#endif
