// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_pyramid_kernel_h
#define geocone_kernels_pyramid_kernel_h

#include <geocone/kernels/point_block.h>

namespace geocone::GEOCONE_DIM
{
  /** The numbers of advance_pyramid(). */
  struct PyramidNumbers
  {
    double sine; ///< sin(phi) of f_ij = s_i - s_j + (s_i + s_j) sine - size
    double flow; ///< sin(theta)
    double size; ///< 2 c cos(phi) (Pa)

    double lambda, two_G; ///< (Pa)

    /** @name What is a point's own, by places in the history; no_place: nothing */
    /** @{ */
    static constexpr unsigned int no_place = -1;
    unsigned int memory  = no_place; ///< the p that friction remembers (Pa)
    double       part    = 0.;       ///< lambda of the step
    double       lagging = 0.;       ///< of sine, the part that p has
    unsigned int growth  = no_place; ///< of the cohesion (Pa)
    double       size_per_cohesion = 0.;
    /** @} */
  };

  /**
   * An explicit step of a linear elastic material with Mohr-Coulomb's law of all
   * principal stresses, for a block of points: the return map of SpatialMohrCoulomb of
   * the turned stress plus D e, four points at once. Principal stresses are found by
   * Jacobi's rotations, which lose nothing where two of them are equal; where all four
   * are within the round cone in the pyramid, none are.
   */
  void
  advance_pyramid(const PyramidNumbers &pyramid, const PointBlock &block);
} // namespace geocone::GEOCONE_DIM

#endif
