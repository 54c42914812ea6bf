// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_spatial_law_h
#define geocone_materials_spatial_law_h

#include <geocone/materials/material.h>

namespace geocone
{
  /**
   * A perfectly plastic law of the whole stress (s_xx, s_yy, s_xy, s_zz), for plane
   * strain and for axisymmetric scenes: laws give a return map of four components.
   * In plane strain flow along z is balanced by elastic strain, so that s_zz moves to
   * where the flow rule wants it; the result then depends on it.
   */
  class SpatialLaw : public Material
  {
  public:
    using Material::Material;

    bool
    is_spatial() const override
    {
      return true;
    }

    void
    update(const Increment &increment, const Response &response) const override;

    double
    elastic_energy(const Mandel &stress, const double *history) const override;

    SpatialMandel
    plastic_strain(const Mandel &strain,
                   const double  strain_zz,
                   const Mandel &change,
                   const double  change_zz) const override;

    std::optional<double>
    overstress(const Mandel &stress, const double *history) const override;

  protected:
    /** s at t_{n+1} from the trial stress s_n + D e. @param[out] tangent ds/de, or
     *  null */
    virtual Mode
    return_to_strength(const SpatialMandel &trial,
                       const SpatialMandel &stress_n,
                       const StepLaw       &step,
                       SpatialMandel       &stress,
                       SpatialMandelMatrix *tangent) const = 0;

    SpatialMandel
    whole_stress(const Mandel &in_plane, const double *history) const;
  };
} // namespace geocone

#endif
