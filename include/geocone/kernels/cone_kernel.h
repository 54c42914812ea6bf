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
   * is returned by ConeReturn. With the mean m = (s_xx + s_yy)/2, the half
   * difference d = (s_xx - s_yy)/2 and tau = sqrt(d^2 + s_xy^2), the cone is
   * tau <= -a m + k/sqrt2. In three dimensions m = tr(s)/3, tau = |dev
   * s|/sqrt3, and k/sqrt3 replaces k/sqrt2. Rankine's cut-off is ignored.
   *
   * With friction memory (strength that follows the normal stress with a
   * delay), the yield surface at each point is cone.delayed(part, p), and the
   * delayed normal stress p is then replaced by part p + (1 - part) s_n.
   * @param cone with a > 0 if there is memory
   * @param part memory factor lambda
   * @param place index of p (Pa) in the history; 0: no memory
   */
  void
  advance_cone(const FlowCone    &cone,
               const Elasticity  &elasticity,
               const PointBlock  &block,
               const double       part  = 0.,
               const unsigned int place = 0);
} // namespace geocone::GEOCONE_DIM

#endif
