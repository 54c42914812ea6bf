// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_fans_of_jumps_h
#define geocone_limit_analysis_fans_of_jumps_h

#include <geocone/limit_analysis/bound_problem.h>
#include <geocone/mesh/fan.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Fans at the vertices of the outline where prescribed tractions jump. Principal
   * stresses turn there by a finite angle, and stresses that are linear in triangles turn
   * from triangle to triangle only, however small they are: the number of triangles at
   * such a vertex limits the lower bound (doc/theory/limit_analysis.md). The rays are
   * those of the sector of the turn, at which the limit is closest to the exact load.
   * Where less than 0.4 of what a continuous turn carries acts, there is no fan.
   * @param load of the problem, about
   * @param tolerance relative error of the load that the number of rays may cause
   */
  std::vector<Fan>
  fans_of_jumps(const BoundScene &bound,
                const double      load,
                const double      tolerance);

  /**
   * Ratio of the pressure that n stress discontinuities carry beside a free surface to that
   * of a continuous turn. Across each, principal stresses turn by turn/n; with
   * sin(rho) = sin(phi) cos(turn/n), mean stresses, to which c cot(phi) is added, grow by
   * cos(turn/n - rho)/cos(turn/n + rho).
   * @param sin_phi of the soil, or 0
   */
  double
  part_carried(const unsigned int n, const double turn, const double sin_phi);
} // namespace geocone::GEOCONE_DIM

#endif
