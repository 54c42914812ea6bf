// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_yield_curve_h
#define geocone_kernels_yield_curve_h

#include <array>
#include <utility>
#include <vector>

namespace geocone
{
  /** Components xx, yy, zz, xy, yz, zx of a tensor (no Mandel factors). */
  using Tensor6 = std::array<double, 6>;

  /** A section of a yield surface in the plane of p and q, for pictures (Pa);
   *  p compression positive. */
  using YieldCurve = std::vector<std::pair<double, double>>;

  /** The plane of such a section: that of the hydrostatic axis and the deviator of a
   *  stress. */
  struct SectionPlane
  {
    Tensor6 stress; ///< tension positive (Pa)

    /** 0 to 2: q counts positive where this component is compressed more than the
     *  others; else the deviator points to positive q. */
    unsigned int axis;

    double largest_p; ///< how far open surfaces are drawn (Pa)
  };
} // namespace geocone

#endif
