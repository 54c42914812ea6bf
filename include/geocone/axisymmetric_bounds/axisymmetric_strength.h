// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_axisymmetric_bounds_axisymmetric_strength_h
#define geocone_axisymmetric_bounds_axisymmetric_strength_h

#include <geocone/conic/strength_law.h>

/** Strength laws of points of axisymmetric bodies. Stresses are the vectors (s_rr, s_zz,
 *  sqrt2 s_rz, s_tt), tension positive; the hoop stress s_tt is a principal stress. */
namespace geocone
{
  /** Cone of positive semidefinite 3 x 3 matrices with two blocks, in the plane and
   *  around the axis. The block in the plane is the vector of its mean normal component,
   *  half of the difference of the normal components, and the shear component. */
  using HoopCone = ProductCone<SecondOrderCone<3>, SecondOrderCone<1>>;

  /** Mohr-Coulomb strength (1 + S) s_1 - (1 - S) s_3 <= k of an axisymmetric stress,
   *  expressed by two matrices like MohrCoulombCones. */
  using AxisymmetricMohrCoulomb =
    StrengthLaw<ProductCone<HoopCone, HoopCone>, 4, 1>;

  inline AxisymmetricMohrCoulomb
  axisymmetric_mohr_coulomb(const double sine)
  {
    // Maps stresses to the vectors of the cone.
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M(0, 0) = M(0, 1) = M(1, 0) = 0.5;
    M(1, 1)                     = -0.5;
    M(2, 2)                     = M_SQRT1_2;
    M(3, 3)                     = 1.;
    return two_matrices<AxisymmetricMohrCoulomb, 4>(
      sine, M, Eigen::Vector4d(1., 1., 0., 1.));
  }
} // namespace geocone

#endif
