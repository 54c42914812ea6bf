// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_cone_kernel_h
#define geocone_kernels_cone_kernel_h

#include <geocone/cone/second_order_cone.h>
#include <geocone/kernels/elasticity.h>
#include <geocone/kernels/point_block.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Explicit stress update of an elastoplastic material with a conical yield
   * surface, for a block of points. The trial stress, rotated stress plus D e,
   * is returned as by return_map(), without branches. With the mean m = (s_xx +
   * s_yy)/2, the half difference d = (s_xx - s_yy)/2 and tau = sqrt(d^2 +
   * s_xy^2), the cone is tau <= -a m + k/sqrt2. In three dimensions m =
   * tr(s)/3, tau = |dev s|/sqrt3, and k/sqrt3 replaces k/sqrt2. A tension
   * cut-off of the cone is ignored.
   */
  void
  advance_cone(const FlowCone   &cone,
               const Elasticity &elasticity,
               const PointBlock &block);

  /**
   * Explicit stress update of a material with friction memory (strength that
   * follows the normal stress with a delay), for a block of points. The yield
   * surface at each point is cone.delayed(part, p), with tension cut-off. The
   * delayed normal stress p is then replaced by part p + (1 - part) s_n.
   * @param cone with a > 0
   * @param part memory factor lambda
   * @param place index of p (Pa) in the history
   */
  void
  advance_cone(const FlowCone    &cone,
               const Elasticity  &elasticity,
               const PointBlock  &block,
               const double       part,
               const unsigned int place);
} // namespace geocone::GEOCONE_DIM

#endif
