// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_types_h
#define geocone_base_types_h

#include <Eigen/Core>

#include <cmath>

/**
 * Conventions of the whole code, stated once:
 *  - plane strain in the (x, y) plane, unit thickness: forces are N/m, energies
 *    J/m; or axisymmetric, x the radius, y the axis, z around it: forces are N,
 *    energies J, of the whole body;
 *  - SI units, angles in parameter files in degrees;
 *  - tension is positive, in stress and strain alike;
 *  - symmetric tensors are Mandel vectors, so that the scalar product of two
 *    vectors is the double contraction of the two tensors.
 */
namespace geocone
{
  /** Space dimension of all scenes. */
  constexpr unsigned int dim = 2;

  /** Number of Mandel components in plane strain. */
  constexpr int n_mandel = 3;

  /** Mandel vector (t11, t22, sqrt(2) t12) of a symmetric in-plane tensor. */
  using Mandel = Eigen::Matrix<double, n_mandel, 1>;

  /** Linear map between Mandel vectors, e.g. a tangent stiffness (Pa). */
  using MandelMatrix =
    Eigen::Matrix<double, n_mandel, n_mandel, Eigen::RowMajor>;

  /** The same with the direction out of the plane: (t11, t22, sqrt(2) t12, t33), 33
   *  being along z, or around the axis of an axisymmetric scene. */
  using SpatialMandel       = Eigen::Matrix<double, 4, 1>;
  using SpatialMandelMatrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

  constexpr double pi    = 3.14159265358979323846;
  constexpr double sqrt2 = 1.41421356237309504880;

  inline double
  radians(const double degrees)
  {
    return degrees * (pi / 180.);
  }
} // namespace geocone

#endif
