// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_fans_of_jumps_h
#define geocone_limit_analysis_fans_of_jumps_h

#include <geocone/geometry/fan.h>
#include <geocone/plane_bounds/bound_problem.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Returns fans of triangles (Fan) at the vertices of the outline where
   * prescribed tractions are discontinuous. At such a vertex, the principal
   * stresses rotate by a finite angle. Stresses that are linear in each
   * triangle rotate only from triangle to triangle, however small the triangles
   * are. The number of triangles at the vertex therefore limits the lower bound
   * (doc/theory/limit_analysis.md). The rays divide the sector in which the
   * stresses rotate, for which the limit is closest to the exact load. There is
   * no fan if the pressure is less than 0.4 of the pressure that a continuous
   * rotation can carry.
   * @param load approximate load of the problem
   * @param tolerance relative error of the load that the number of rays may cause
   */
  std::vector<Fan>
  fans_of_jumps(const BoundScene &bound,
                const double      load,
                const double      tolerance);

  /**
   * Fraction of the exact limit pressure beside a free surface that n stress
   * discontinuities can carry. The exact limit requires a continuous rotation
   * of the principal stresses by the angle @p turn. Across each discontinuity,
   * the principal stresses rotate by turn/n. With sin(rho) = sin(phi)
   * cos(turn/n), the mean stress plus c cot(phi) increases by the factor
   * cos(turn/n - rho)/cos(turn/n + rho).
   * @param sin_phi of the soil, or 0
   */
  double
  part_carried(const unsigned int n, const double turn, const double sin_phi);
} // namespace geocone::GEOCONE_DIM

#endif
