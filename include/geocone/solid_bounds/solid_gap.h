// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_gap_h
#define geocone_solid_bounds_solid_gap_h

#include <geocone/solid_bounds/solid_certificate.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Returns the contribution of each cell to the gap between the bounds: the
   * dissipation of the upper bound minus the internal power of the lower
   * bound's stresses. By virtual work, it is D - s.e in the cell and D - t.u on
   * its facets, half of which belongs to each adjacent cell. No contribution is
   * negative if the strength of the cell is constant, since the stress is
   * admissible and its power at most the dissipation. The sum is the gap times
   * SolidBound::work.
   * @param order_upper, order_lower of the velocities and the stresses
   */
  std::vector<double>
  gap_of_cells(const SolidScene  &bound,
               const unsigned int order_upper,
               const unsigned int order_lower,
               const SolidBound  &upper,
               const SolidBound  &lower);

  /** Returns the dissipation of the upper bound in each cell, with half of that in the
   *  jumps at its inner faces. */
  std::vector<double>
  dissipation_around_cells(const Tetrahedra &tetrahedra,
                           const SolidBound &upper);

  /**
   * Returns the contribution of each cell to the error by which the mesh is refined: its
   * part of the gap, and as much again where the stresses limit the load of the lower
   * bound, but the mechanism of the upper bound does not dissipate. The second part is
   * the share of the lower bound's dual power in excess of the share of the dissipation,
   * both averaged around the vertices.
   */
  std::vector<double>
  error_of_cells(const Tetrahedra          &tetrahedra,
                 const std::vector<double> &gap,
                 const SolidBound          &upper,
                 const SolidBound          &lower);
} // namespace geocone::GEOCONE_DIM

#endif
