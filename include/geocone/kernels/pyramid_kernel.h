// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_pyramid_kernel_h
#define geocone_kernels_pyramid_kernel_h

#include <geocone/kernels/point_block.h>

namespace geocone::GEOCONE_DIM
{
  /** Constants of advance_pyramid(). */
  struct PyramidNumbers
  {
    double sine; ///< sin(phi) of f_ij = s_i - s_j + (s_i + s_j) sine - size
    double flow; ///< sin(theta)
    double size; ///< 2 c cos(phi) (Pa)

    double lambda, two_G; ///< (Pa)

    /** @name Variables of a point, by their index in the history; no_place:
     *  none */
    /** @{ */
    static constexpr unsigned int no_place = -1;
    unsigned int memory  = no_place; ///< p of friction with memory (Pa)
    double       part    = 0.;       ///< lambda of the step
    double       lagging = 0.;       ///< part of sine that acts on p
    unsigned int growth  = no_place; ///< of the cohesion (Pa)
    double       size_per_cohesion = 0.;
    /** @} */
  };

  /**
   * An explicit step of a linear elastic material with the three-dimensional
   * Mohr-Coulomb law, for a block of points: the return map of
   * SpatialMohrCoulomb for the rotated stress plus D e, four points at once.
   * Principal stresses are computed by Jacobi rotations, which are accurate for
   * equal ones as well; they are skipped if all four points lie within the cone
   * inscribed in the pyramid.
   */
  void
  advance_pyramid(const PyramidNumbers &pyramid, const PointBlock &block);
} // namespace geocone::GEOCONE_DIM

#endif
