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

  /** Section of a yield surface in the plane of p and q, for figures (Pa); p
   *  compression positive. */
  using YieldCurve = std::vector<std::pair<double, double>>;

  /** Plane of such a section, spanned by the hydrostatic axis and the deviator
   *  of a stress. */
  struct SectionPlane
  {
    Tensor6 stress; ///< tension positive (Pa)

    /** 0 to 2: q is positive if this component is more compressed than the
     *  others; otherwise the deviator points to positive q. */
    unsigned int axis;

    double largest_p; ///< limit of p for open surfaces (Pa)
  };
} // namespace geocone

#endif
