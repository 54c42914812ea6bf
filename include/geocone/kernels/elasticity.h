// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_kernels_elasticity_h
#define geocone_kernels_elasticity_h

#include <geocone/base/types.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Isotropic linear elasticity,
   *   s = lambda tr(e) I + 2G e,
   * in plane strain (zero strain along z) or in three dimensions. In cone axes the
   * stiffness is diagonal: D = diag(K, 2G, ..., 2G), K = normal_stiffness().
   */
  class Elasticity
  {
  public:
    Elasticity() = default;

    /**
     * Computes the Lame constants from Young's modulus and Poisson's ratio.
     * @param young_modulus E > 0 (Pa)
     * @param poisson_ratio nu in (-1, 0.5)
     */
    Elasticity(const double young_modulus, const double poisson_ratio)
      : lambda(young_modulus * poisson_ratio /
               ((1. + poisson_ratio) * (1. - 2. * poisson_ratio)))
      , two_G(young_modulus / (1. + poisson_ratio))
    {}

    /** Young's modulus E (Pa). */
    double
    young_modulus() const
    {
      return two_G * (3. * lambda + two_G) / (2. * lambda + two_G);
    }

    /** Elastic stiffness along the cone axis, dim lambda + 2G (Pa), with the
     *  space dimension dim. */
    double
    normal_stiffness() const
    {
      return dim * lambda + two_G;
    }

    /** Three times the bulk modulus, 3 lambda + 2G (Pa). */
    double
    spatial_normal_stiffness() const
    {
      return 3. * lambda + two_G;
    }

    /** Elastic stress lambda tr(e) I + 2G e (Pa). @param strain in two or three
     *  dimensions */
    template <int n>
    Eigen::Matrix<double, n, 1>
    stress(const Eigen::Matrix<double, n, 1> &strain) const
    {
      return two_G * strain + (lambda * trace(strain)) * unit_tensor<n>();
    }

    /** Elastic strain that corresponds to a stress, in plane strain or in three
     *  dimensions. */
    template <int n>
    Eigen::Matrix<double, n, 1>
    strain(const Eigen::Matrix<double, n, 1> &stress) const
    {
      const double bulk =
        n == 3 ? 2. * lambda + two_G : spatial_normal_stiffness();
      return (stress - (lambda / bulk * trace(stress)) * unit_tensor<n>()) /
             two_G;
    }

    /** Elastic stiffness matrix D in Mandel components (Pa). */
    template <int n = n_mandel>
    Eigen::Matrix<double, n, n, Eigen::RowMajor>
    stiffness() const
    {
      using Matrix = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
      Matrix     D = two_G * Matrix::Identity();
      const auto I = unit_tensor<n>();
      D += lambda * I * I.transpose();
      return D;
    }

    double lambda = 0.; ///< first Lame modulus (Pa)
    double two_G  = 0.; ///< twice the shear modulus (Pa)
  };
} // namespace geocone::GEOCONE_DIM

#endif
