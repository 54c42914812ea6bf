// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_yield_curve_h
#define geocone_kernels_yield_curve_h

#include <array>
#include <utility>
#include <vector>

namespace geocone
{
  /** Components xx, yy, zz, xy, yz, zx of a symmetric tensor, without Mandel
   *  factors. */
  using Tensor6 = std::array<double, 6>;

  /** Section of a yield surface for plots, as points (p, q) in Pa with p
   *  positive in compression. */
  using YieldCurve = std::vector<std::pair<double, double>>;

  /** Section plane in stress space, spanned by the hydrostatic axis and the
   *  deviator of a stress. */
  struct SectionPlane
  {
    Tensor6 stress; ///< a stress in the plane, tension positive (Pa)

    /** Index of the normal stress component that determines the sign of the
     *  deviatoric stress q. For 0 to 2, q is positive where this component is
     *  the most compressive; otherwise q is positive along the deviator of the
     *  stress. */
    unsigned int axis;

    double largest_p; ///< end of the curve if the surface is open (Pa)
  };
} // namespace geocone

#endif
