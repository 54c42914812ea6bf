// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_elasticity_h
#define geocone_materials_elasticity_h

#include <geocone/base/types.h>

namespace geocone
{
  /**
   * Isotropic linear elasticity in plane strain (zero strain along z):
   *   s = lambda tr(e) I + 2G e.
   * In cone axes the stiffness is diagonal: D = diag(K, 2G, 2G),
   * K = 2(lambda + G) acting on the normal part.
   */
  class Elasticity
  {
  public:
    Elasticity() = default;

    /**
     * @param young_modulus E > 0 (Pa)
     * @param poisson_ratio nu in (-1, 0.5)
     */
    Elasticity(const double young_modulus, const double poisson_ratio)
      : lambda(young_modulus * poisson_ratio /
               ((1. + poisson_ratio) * (1. - 2. * poisson_ratio)))
      , two_G(young_modulus / (1. + poisson_ratio))
    {}

    /** E (Pa). */
    double
    young_modulus() const
    {
      return two_G * (3. * lambda + two_G) / (2. * lambda + two_G);
    }

    /** In-plane bulk stiffness K = 2(lambda + G) of the cone's axis (Pa). */
    double
    normal_stiffness() const
    {
      return 2. * lambda + two_G;
    }

    Mandel
    stress(const Mandel &strain) const
    {
      const double volumetric = lambda * (strain[0] + strain[1]);
      return {volumetric + two_G * strain[0],
              volumetric + two_G * strain[1],
              two_G * strain[2]};
    }

    /** S s: the elastic strain of a stress. */
    Mandel
    strain(const Mandel &stress) const
    {
      const double volumetric =
        lambda / normal_stiffness() * (stress[0] + stress[1]);
      return {(stress[0] - volumetric) / two_G,
              (stress[1] - volumetric) / two_G,
              stress[2] / two_G};
    }

    /** @name The same with strain out of the plane */
    /** @{ */
    SpatialMandel
    stress(const SpatialMandel &strain) const
    {
      const double volumetric = lambda * (strain[0] + strain[1] + strain[3]);
      return two_G * strain + volumetric * SpatialMandel(1., 1., 0., 1.);
    }

    SpatialMandel
    strain(const SpatialMandel &stress) const
    {
      const double volumetric = lambda / spatial_normal_stiffness() *
                                (stress[0] + stress[1] + stress[3]);
      return (stress - volumetric * SpatialMandel(1., 1., 0., 1.)) / two_G;
    }

    /** Three times the bulk modulus, 3 lambda + 2G (Pa). */
    double
    spatial_normal_stiffness() const
    {
      return 3. * lambda + two_G;
    }
    /** @} */

    MandelMatrix
    stiffness() const
    {
      MandelMatrix D = two_G * MandelMatrix::Identity();
      D.topLeftCorner<2, 2>().array() += lambda;
      return D;
    }

    double lambda = 0.; ///< first Lame modulus (Pa)
    double two_G  = 0.; ///< twice the shear modulus (Pa)
  };
} // namespace geocone

#endif
