// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_plate_points_h
#define geocone_problem_plate_points_h

#include <geocone/mesh/background_mesh.h>
#include <geocone/scene/structures.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Points at which a plate is tied to the body: the corners of its polyline, and
   * between them points at most its spacing apart or, without one, those where it
   * crosses the sides of cells, and a number of intervals between them. Along
   * sides of the mesh these are the nodes. Crossings very near to others are left
   * out. The same on all ranks.
   * @param degree of the displacements, the number of intervals
   */
  std::vector<dealii::Point<dim>>
  points_of_plate(const Structure      &plate,
                  const BackgroundMesh &mesh,
                  const unsigned int    degree);
} // namespace geocone::GEOCONE_DIM

#endif
