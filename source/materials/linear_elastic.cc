// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/kernels/cone_kernel.h>
#include <geocone/materials/linear_elastic.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  void
  LinearElastic::update(const Increment &increment,
                        const Response  &response) const
  {
    if (axisymmetric)
      return SpatialLaw::update(increment, response);
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        response.stress[p] =
          increment.stress_n[p] + elasticity().stress(increment.strain[p]);
        response.mode[p] = Mode::elastic;
      }
    for (MandelMatrix &tangent : response.tangent)
      tangent = elasticity().stiffness();
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
    counts.updates += block.n_points;
    FlowCone everything;
    everything.k = std::numeric_limits<double>::max();
    advance_cone(everything, elasticity(), block);
  }
} // namespace geocone::GEOCONE_DIM
