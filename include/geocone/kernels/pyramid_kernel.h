// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_pyramid_kernel_h
#define geocone_kernels_pyramid_kernel_h

#include <geocone/kernels/point_block.h>

namespace geocone::GEOCONE_DIM
{
  /** Material constants of the kernel advance_pyramid(). */
  struct PyramidConstants
  {
    double sine; ///< sin(phi) of f_ij = s_i - s_j + (s_i + s_j) sine - size
    double flow; ///< sin(theta), theta the dilatancy angle
    double size; ///< 2 c cos(phi) (Pa)

    double lambda, two_G; ///< (Pa)

    /** @name Indices of history variables (no_place: absent) and their
     *  parameters */
    /** @{ */
    static constexpr unsigned int no_place = -1;
    unsigned int memory = no_place;  ///< index of p, friction with memory (Pa)
    double       memory_factor = 0.; ///< memory factor lambda of the step
    double       delayed_sine  = 0.; ///< part of sin(phi) multiplied by p
    unsigned int growth = no_place;  ///< index of the cohesion increment (Pa)
    double       size_per_cohesion = 0.;
    /** @} */
  };

  /**
   * Explicit stress update by the three-dimensional Mohr-Coulomb model, for a
   * block of points. The trial stress, rotated stress plus D e, is returned as
   * by SpatialMohrCoulomb, four points at once. Principal stresses are computed
   * by Jacobi rotations, which are accurate for equal principal stresses as
   * well; the rotations are skipped if all four points lie within the cone
   * inscribed in the pyramid.
   */
  void
  advance_pyramid(const PyramidConstants &pyramid, const PointBlock &block);
} // namespace geocone::GEOCONE_DIM

#endif
