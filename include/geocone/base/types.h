// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_types_h
#define geocone_base_types_h

#include <geocone/base/constants.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <string>

/**
 * The space dimension of a scene, which the build gives: all that depends on it is
 * compiled once for each, in the namespace geocone::dim2 or geocone::dim3, so that both
 * are in one program and neither pays for the other. It is an inline namespace: nobody
 * but main.cc has to name it. CONTRIBUTING.md explains how this is written.
 */
#ifndef GEOCONE_DIMENSION
#define GEOCONE_DIMENSION 2
#endif
#if GEOCONE_DIMENSION == 2
#define GEOCONE_DIM dim2
#else
#define GEOCONE_DIM dim3
#endif
namespace geocone
{
  inline namespace GEOCONE_DIM
  {}
} // namespace geocone

/**
 * Conventions of the whole code, stated once:
 *  - plane strain in the (x, y) plane, unit thickness: forces are N/m, energies
 *    J/m; or axisymmetric, x the radius, y the axis, z around it: forces are N,
 *    energies J, of the whole body; or three dimensions, forces are N, energies J;
 *    where weight needs a vertical, it is y in all of them;
 *  - SI units, angles in parameter files in degrees;
 *  - tension is positive, in stress and strain alike;
 *  - symmetric tensors are Mandel vectors, so that the scalar product of two
 *    vectors is the double contraction of the two tensors.
 */
namespace geocone::GEOCONE_DIM
{
  constexpr unsigned int dim = GEOCONE_DIMENSION;
  static_assert(dim == 2 || dim == 3);

  /** Number of Mandel components of the strain of a motion. */
  constexpr int n_mandel = dim == 2 ? 3 : 6;

  /** Mandel vector of a symmetric tensor: (t11, t22, sqrt(2) t12) in the plane,
   *  (t11, t22, sqrt(2) t12, t33, sqrt(2) t23, sqrt(2) t31) in three dimensions. */
  using Mandel = Eigen::Matrix<double, n_mandel, 1>;

  /** Linear map between Mandel vectors, e.g. a tangent stiffness (Pa). */
  using MandelMatrix =
    Eigen::Matrix<double, n_mandel, n_mandel, Eigen::RowMajor>;

  /** All of a stress that can be other than zero. In the plane it has a direction
   *  besides: (t11, t22, sqrt(2) t12, t33), 33 being along z, or around the axis of
   *  an axisymmetric scene. In three dimensions it is the Mandel vector. */
  constexpr int n_spatial = dim == 2 ? 4 : 6;
  using SpatialMandel     = Eigen::Matrix<double, n_spatial, 1>;
  using SpatialMandelMatrix =
    Eigen::Matrix<double, n_spatial, n_spatial, Eigen::RowMajor>;

  /** Places in Mandel vectors of the normal components, and those of the shear ones
   *  with the two directions that they are between. */
  constexpr int place_of_normal[3] = {0, 1, 3};
  struct ShearPlace
  {
    int place, first, second;
  };
  constexpr ShearPlace shears[3] = {{2, 0, 1}, {4, 1, 2}, {5, 2, 0}};
  constexpr int        n_shears  = dim == 2 ? 1 : 3;

  /** The place of t_ij in all that is in the order of Mandel vectors. */
  constexpr int place_of_component[3][3] = {{0, 2, 5}, {2, 1, 4}, {5, 4, 3}};

  /** The sum of the normal components of a Mandel vector, of the plane or spatial. */
  template <int n>
  double
  trace(const Eigen::Matrix<double, n, 1> &t)
  {
    if constexpr (n == 3)
      return t[0] + t[1];
    else
      return t[0] + t[1] + t[3];
  }

  /** The unit tensor as a Mandel vector, of the plane or spatial. */
  template <int n>
  Eigen::Matrix<double, n, 1>
  unit_tensor()
  {
    Eigen::Matrix<double, n, 1> I = Eigen::Matrix<double, n, 1>::Zero();
    I[0] = I[1] = 1.;
    if constexpr (n > 3)
      I[3] = 1.;
    return I;
  }

  /** Rotations are about z, and in three dimensions about x and y, too; each moves
   *  points in a plane, from its first axis to its second. */
  constexpr unsigned int n_rotations             = dim == 2 ? 1 : 3;
  constexpr unsigned int plane_of_rotation[3][2] = {{0, 1}, {1, 2}, {2, 0}};

  /** The axis of a rotation. */
  inline std::string
  axis_of_rotation(const unsigned int rotation)
  {
    const auto [a, b] = plane_of_rotation[rotation];
    return std::string(1, "xyz"[3 - a - b]);
  }

  /** The side of a square, or of a cube, of a volume (m). */
  inline double
  length_of(const double volume)
  {
    return dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
  }

  /** Names of the coordinates, one by one and in texts. */
  constexpr char        coordinate[3] = {'x', 'y', 'z'};
  constexpr const char *coordinates   = dim == 2 ? "x, y" : "x, y, z";

  /** Names of the components in the order of Mandel vectors. */
  constexpr const char *tensor_component[6] = {
    "xx", "yy", "xy", "zz", "yz", "zx"};

  /** Whether one of these is a shear component, which has a factor of sqrt(2). */
  constexpr bool
  is_shear(const int component)
  {
    return component == 2 || component > 3;
  }

  /** The Mandel vector of components in this order. */
  inline Mandel
  mandel_of_components(const std::array<double, n_mandel> &values)
  {
    Mandel t;
    for (int i = 0; i < n_mandel; ++i)
      t[i] = is_shear(i) ? sqrt2 * values[i] : values[i];
    return t;
  }

  /** The components of a Mandel vector in this order. */
  inline std::array<double, n_mandel>
  components_of(const Mandel &t)
  {
    std::array<double, n_mandel> values;
    for (int i = 0; i < n_mandel; ++i)
      values[i] = is_shear(i) ? t[i] / sqrt2 : t[i];
    return values;
  }

  /** The strain sym(l) of a gradient l_ij at dim i + j. */
  inline Mandel
  symmetric_part(const std::array<double, dim * dim> &l)
  {
    Mandel t;
    for (unsigned int d = 0; d < dim; ++d)
      t[place_of_normal[d]] = l[(dim + 1) * d];
    for (int i = 0; i < n_shears; ++i)
      {
        const auto [place, a, b] = shears[i];
        t[place] = sqrt2 * ((l[dim * a + b] + l[dim * b + a]) / 2.);
      }
    return t;
  }

  /** A tensor of three dimensions, and its Mandel vector. */
  inline Eigen::Matrix3d
  spatial_tensor(const Eigen::Matrix<double, 6, 1> &t)
  {
    Eigen::Matrix3d tensor;
    for (int d = 0; d < 3; ++d)
      tensor(d, d) = t[place_of_normal[d]];
    for (const auto &[place, a, b] : shears)
      tensor(a, b) = tensor(b, a) = t[place] / sqrt2;
    return tensor;
  }

  inline Eigen::Matrix<double, 6, 1>
  spatial_mandel(const Eigen::Matrix3d &tensor)
  {
    Eigen::Matrix<double, 6, 1> t;
    for (int d = 0; d < 3; ++d)
      t[place_of_normal[d]] = tensor(d, d);
    for (const auto &[place, a, b] : shears)
      t[place] = (tensor(a, b) + tensor(b, a)) / sqrt2;
    return t;
  }

  /** The Mandel vector of a tensor in the plane. */
  inline Mandel
  in_plane(const double xx, const double yy, const double xy)
  {
    Mandel t = Mandel::Zero();
    t[0]     = xx;
    t[1]     = yy;
    t[2]     = sqrt2 * xy;
    return t;
  }

  /** A Mandel vector and what it leaves out; in three dimensions that is nothing. */
  inline SpatialMandel
  extended(const Mandel &t, const double zz)
  {
    SpatialMandel whole    = SpatialMandel::Zero();
    whole[3]               = zz;
    whole.head<n_mandel>() = t;
    return whole;
  }
} // namespace geocone::GEOCONE_DIM

#endif
