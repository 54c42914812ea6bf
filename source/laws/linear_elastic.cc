// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/cone_kernel.h>
#include <geocone/laws/linear_elastic.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  void
  LinearElastic::update(const Increment &increment,
                        const Response  &response) const
  {
    if (axisymmetric)
      return SpatialLaw::update(increment, response);
    if (!has_constant_stiffness())
      {
        for (std::size_t p = 0; p < increment.strain.size(); ++p)
          {
            const Elasticity own =
              own_elasticity(increment.history_n + increment.n_history * p);
            response.stress[p] =
              increment.stress_n[p] + own.stress(increment.strain[p]);
            response.mode[p] = Mode::elastic;
            if (response.tangent.size() > 0)
              response.tangent[p] = own.stiffness();
          }
        return;
      }
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        response.stress[p] =
          increment.stress_n[p] + elasticity().stress(increment.strain[p]);
        response.mode[p] = Mode::elastic;
      }
    for (MandelMatrix &tangent : response.tangent)
      tangent = elasticity().stiffness();
  }

  bool
  LinearElastic::set_axisymmetric()
  {
    if (!has_constant_stiffness())
      throw InputError(parameter(entry),
                       "a formula",
                       "empty in axisymmetric scenes",
                       "take layers of constant stiffness");
    return axisymmetric = true;
  }

  Mode
  LinearElastic::return_to_strength(const SpatialMandel &trial,
                                    const OwnStrength &,
                                    SpatialMandel       &stress,
                                    SpatialMandelMatrix *tangent) const
  {
    stress = trial;
    if (tangent != nullptr)
      *tangent = elasticity().stiffness<n_spatial>();
    return Mode::elastic;
  }

  void
  LinearElastic::advance(const PointBlock &block, LawCounts &counts) const
  {
    if (axisymmetric)
      return SpatialLaw::advance(block, counts);
    if (!has_constant_stiffness())
      return Material::advance(block, counts);
    counts.updates += block.n_points;
    FlowCone everything;
    everything.k = std::numeric_limits<double>::max();
    advance_cone(everything, elasticity(), block);
  }
} // namespace geocone::GEOCONE_DIM
