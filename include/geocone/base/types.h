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
 * Space dimension, set at compile time. All dimension-dependent code is compiled
 * once for each dimension, in the namespaces geocone::dim2 and geocone::dim3, so
 * that one program supports both without a run-time cost. The namespaces are inline:
 * only main.cc has to name them. CONTRIBUTING.md explains how dimension-dependent
 * code is written.
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
 * Conventions for geometry, units and tensors. They apply to all files:
 *
 *  - geometry is plane strain in the (x, y) plane per unit thickness (forces in
 *    N/m, energies in J/m), axisymmetric with x the radius, y the axis and z the
 *    hoop direction (forces in N, energies in J, of the full body), or
 *    three-dimensional (N, J);
 *  - the vertical axis is y in all geometries;
 *  - SI units; angles in degrees in parameter files;
 *  - stress and strain are positive in tension;
 *  - symmetric tensors are Mandel vectors, so that the scalar product of two
 *    vectors is the double contraction of the two tensors.
 */
namespace geocone::GEOCONE_DIM
{
  constexpr unsigned int dim = GEOCONE_DIMENSION;
  static_assert(dim == 2 || dim == 3);

  /** Number of components of a Mandel vector: 3 in two dimensions (in-plane
   *  components only), 6 in three. */
  constexpr int n_mandel = dim == 2 ? 3 : 6;

  /** Mandel vector of a symmetric tensor: (t11, t22, sqrt(2) t12) in two dimensions,
   *  (t11, t22, sqrt(2) t12, t33, sqrt(2) t23, sqrt(2) t31) in three dimensions. */
  using Mandel = Eigen::Matrix<double, n_mandel, 1>;

  /** Linear map between Mandel vectors, e.g. a tangent stiffness (Pa). */
  using MandelMatrix =
    Eigen::Matrix<double, n_mandel, n_mandel, Eigen::RowMajor>;

  /** Number of stress components that can be nonzero: 4 in two dimensions, 6 in
   *  three. In two dimensions the spatial Mandel vector (t11, t22, sqrt(2) t12,
   *  t33) includes the out-of-plane (z) or hoop component t33; in three
   *  dimensions it equals the Mandel vector. */
  constexpr int n_spatial = dim == 2 ? 4 : 6;
  using SpatialMandel     = Eigen::Matrix<double, n_spatial, 1>;
  using SpatialMandelMatrix =
    Eigen::Matrix<double, n_spatial, n_spatial, Eigen::RowMajor>;

  /** Indices of the normal components t11, t22 and t33 in a Mandel vector. For
   *  each shear component t_ij, `shears` contains the index in a Mandel vector
   *  and the directions i and j. */
  constexpr int index_of_normal[3] = {0, 1, 3};
  struct ShearPlace
  {
    int place, first, second;
  };
  constexpr ShearPlace shears[3] = {{2, 0, 1}, {4, 1, 2}, {5, 2, 0}};
  constexpr int        n_shears  = dim == 2 ? 1 : 3;

  /** Index of the tensor component t_ij in a Mandel vector. */
  constexpr int index_of_component[3][3] = {{0, 2, 5}, {2, 1, 4}, {5, 4, 3}};

  /** Trace of a tensor given as an in-plane or spatial Mandel vector. */
  template <int n>
  double
  trace(const Eigen::Matrix<double, n, 1> &t)
  {
    if constexpr (n == 3)
      return t[0] + t[1];
    else
      return t[0] + t[1] + t[3];
  }

  /** Second-order unit tensor as an in-plane or spatial Mandel vector. */
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

  /** Number of rotational degrees of freedom: one in two dimensions (about z),
   *  three in three. A positive rotation turns the first axis of its plane
   *  towards the second. */
  constexpr unsigned int n_rotations             = dim == 2 ? 1 : 3;
  constexpr unsigned int plane_of_rotation[3][2] = {{0, 1}, {1, 2}, {2, 0}};

  /** Returns the name of a rotation axis: "x", "y" or "z". */
  inline std::string
  axis_of_rotation(const unsigned int rotation)
  {
    const auto [a, b] = plane_of_rotation[rotation];
    return std::string(1, "xyz"[3 - a - b]);
  }

  /** Side length (m) of a square of given area or a cube of given volume. */
  inline double
  side_length(const double volume)
  {
    return dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
  }

  /** Coordinate names, as single characters and as a comma-separated list. */
  constexpr char        coordinate[3] = {'x', 'y', 'z'};
  constexpr const char *coordinates   = dim == 2 ? "x, y" : "x, y, z";

  /** Names of the tensor components in the order of Mandel vectors. */
  constexpr const char *tensor_component[6] = {
    "xx", "yy", "xy", "zz", "yz", "zx"};

  /** Returns true for the shear components of a Mandel vector, which are scaled
   *  by sqrt(2). */
  constexpr bool
  is_shear(const int component)
  {
    return component == 2 || component > 3;
  }

  /** Converts tensor components, in the order of tensor_component, to a Mandel
   *  vector. */
  inline Mandel
  mandel_of_components(const std::array<double, n_mandel> &values)
  {
    Mandel t;
    for (int i = 0; i < n_mandel; ++i)
      t[i] = is_shear(i) ? sqrt2 * values[i] : values[i];
    return t;
  }

  /** Converts a Mandel vector to tensor components, in the order of
   *  tensor_component. */
  inline std::array<double, n_mandel>
  components_of(const Mandel &t)
  {
    std::array<double, n_mandel> values;
    for (int i = 0; i < n_mandel; ++i)
      values[i] = is_shear(i) ? t[i] / sqrt2 : t[i];
    return values;
  }

  /** Returns the Mandel vector of the strain or strain rate sym(l) = (l + l')/2.
   *  The component l_ij of the displacement or velocity gradient is stored at
   *  index dim i + j. */
  inline Mandel
  symmetric_part(const std::array<double, dim * dim> &l)
  {
    Mandel t;
    for (unsigned int d = 0; d < dim; ++d)
      t[index_of_normal[d]] = l[(dim + 1) * d];
    for (int i = 0; i < n_shears; ++i)
      {
        const auto [place, a, b] = shears[i];
        t[place] = sqrt2 * ((l[dim * a + b] + l[dim * b + a]) / 2.);
      }
    return t;
  }

  /** Symmetric 3 x 3 tensor from its Mandel vector; inverse: spatial_mandel(). */
  inline Eigen::Matrix3d
  spatial_tensor(const Eigen::Matrix<double, 6, 1> &t)
  {
    Eigen::Matrix3d tensor;
    for (int d = 0; d < 3; ++d)
      tensor(d, d) = t[index_of_normal[d]];
    for (const auto &[place, a, b] : shears)
      tensor(a, b) = tensor(b, a) = t[place] / sqrt2;
    return tensor;
  }

  inline Eigen::Matrix<double, 6, 1>
  spatial_mandel(const Eigen::Matrix3d &tensor)
  {
    Eigen::Matrix<double, 6, 1> t;
    for (int d = 0; d < 3; ++d)
      t[index_of_normal[d]] = tensor(d, d);
    for (const auto &[place, a, b] : shears)
      t[place] = (tensor(a, b) + tensor(b, a)) / sqrt2;
    return t;
  }

  /** Mandel vector of a symmetric tensor with in-plane components only. */
  inline Mandel
  in_plane(const double xx, const double yy, const double xy)
  {
    Mandel t = Mandel::Zero();
    t[0]     = xx;
    t[1]     = yy;
    t[2]     = sqrt2 * xy;
    return t;
  }

  /** Extends a Mandel vector by the out-of-plane component @p zz. In three
   *  dimensions, @p zz is ignored. */
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
