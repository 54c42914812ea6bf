// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/materials/spatial_law.h>

namespace geocone
{
  SpatialMandel
  SpatialLaw::whole_stress(const Mandel &in_plane, const double *history) const
  {
    SpatialMandel stress;
    stress << in_plane,
      stress_zz({{in_plane[0], in_plane[1], in_plane[2] / sqrt2}}, history);
    return stress;
  }

  void
  SpatialLaw::update(const Increment &increment, const Response &response) const
  {
    const bool linear = response.tangent.size() > 0;
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        const double *const history_n =
          increment.history_n + increment.n_history * p;
        const SpatialMandel stress_n =
          whole_stress(increment.stress_n[p], history_n);
        SpatialMandel strain;
        strain << increment.strain[p],
          increment.strain_zz != nullptr ? increment.strain_zz[p] : 0.;
        SpatialMandel       stress;
        SpatialMandelMatrix C;
        response.mode[p] =
          return_to_strength(stress_n + elasticity().stress(strain),
                             stress_n,
                             increment.step,
                             stress,
                             linear ? &C : nullptr);
        response.stress[p] = stress.head<3>();
        if (linear)
          response.tangent[p] = C.topLeftCorner<3, 3>();
        if (linear && response.tangent_zz != nullptr)
          response.tangent_zz[p] = {C.topRightCorner<3, 1>(),
                                    C.bottomLeftCorner<1, 3>().transpose(),
                                    C(3, 3)};
        if (response.stress_zz != nullptr)
          response.stress_zz[p] = stress[3];
        if (response.history != nullptr)
          {
            double *const history = response.history + increment.n_history * p;
            const Stress  whole =
              plane_strain_stress(stress.head<3>(), stress[3]);
            Material::initialise(whole, 0., history);
          }
      }
  }

  double
  SpatialLaw::elastic_energy(const Mandel &in_plane,
                             const double *history) const
  {
    const SpatialMandel stress = whole_stress(in_plane, history);
    return stress.dot(elasticity().strain(stress)) / 2.;
  }

  SpatialMandel
  SpatialLaw::plastic_strain(const Mandel &strain,
                             const double  strain_zz,
                             const Mandel &change,
                             const double  change_zz) const
  {
    SpatialMandel whole, whole_change;
    whole << strain, strain_zz;
    whole_change << change, change_zz;
    return whole - elasticity().strain(whole_change);
  }

  std::optional<double>
  SpatialLaw::overstress(const Mandel &stress, const double *history) const
  {
    return yield_function(whole_stress(stress, history));
  }
} // namespace geocone
