// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_fields_h
#define geocone_solid_bounds_solid_fields_h

#include <geocone/output/simplex_table.h>
#include <geocone/solid_bounds/solid_certificate.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Creates the field file of a tetrahedral mesh, with the failure mechanism of the upper
   * bound, the stresses of the lower bound, and the contribution of each cell to the gap
   * between the bounds. The dissipation of a cell, per volume over the mean of the body,
   * includes half of the dissipation in the velocity jumps on its inner faces. The
   * arguments must outlive the table.
   */
  SimplexTable<Tetrahedra>
  table_of_bounds(const Tetrahedra          &tetrahedra,
                  const BoundUnits          &units,
                  const SolidBound          &upper,
                  const SolidBound          &lower,
                  const std::vector<double> &gap);
} // namespace geocone::GEOCONE_DIM

#endif
