// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_linear_elastic_h
#define geocone_laws_linear_elastic_h

#include <geocone/laws/spatial_law.h>
#include <geocone/laws/with_stiffness_formula.h>

namespace geocone::GEOCONE_DIM
{
  /** Isotropic linear elasticity, s = s_n + D e, with the stress s_n at t_n and
   *  the strain increment e. No parameters of its own. */
  class LinearElastic : public WithStiffnessFormula<SpatialReturnMap>
  {
  public:
    using WithStiffnessFormula::WithStiffnessFormula;

    /** Returns true if the law computes all stress components, which is the
     *  case in axisymmetry only. In plane strain s_zz follows from the in-plane
     *  stresses. */
    bool
    is_spatial() const override
    {
      return axisymmetric;
    }

    bool
    has_natural_map() const override
    {
      return dim == 3 || !axisymmetric;
    }

    bool
    set_axisymmetric() override;

    void
    update(const Increment &increment, const Response &response) const override;

    /** Explicit stress update by the cone kernel with an infinitely large yield
     *  cone. */
    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to,
                   const double        *history) const override
    {
      if (axisymmetric)
        return SpatialReturnMap::elastic_strain(from, to, history);
      return has_constant_stiffness()
               ? Material::elastic_strain(from, to, history)
               : WithStiffnessFormula::elastic_strain(from, to, history);
    }

  protected:
    Mode
    return_to_strength(const SpatialMandel &trial,
                       const OwnStrength   &own,
                       SpatialMandel       &stress,
                       SpatialMandelMatrix *tangent) const override;

  private:
    bool axisymmetric = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
