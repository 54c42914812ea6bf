// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "anisotropic_clay.h"

#include <geocone/base/exceptions.h>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** (s_xx - p, s_yy - p, sqrt2 s_xy) with p = (s_xx + s_yy)/2. */
    Mandel
    deviator(const Mandel &s)
    {
      const double p = (s[0] + s[1]) / 2.;
      return s - p * unit_tensor<n_mandel>();
    }
  } // namespace

  AnisotropicClay::AnisotropicClay(const std::string &section)
    : Material(section)
  {
    add_parameter("Active strength",
                  active,
                  "s_A (Pa), > 0: undrained strength where the soil is "
                  "compressed vertically.");
    add_parameter("Passive strength",
                  passive,
                  "s_P (Pa), > 0: undrained strength where the soil is "
                  "compressed horizontally.");
  }

  void
  AnisotropicClay::prepare()
  {
    Material::prepare();
    for (const auto &[name, value] : {std::pair("Active strength", active),
                                      std::pair("Passive strength", passive)})
      if (!(value > 0.))
        throw InputError(parameter(name),
                         value,
                         "a strength > 0 Pa",
                         "soft clay has 5 to 50 kPa");
    reduce_strength(1.);
  }

  void
  AnisotropicClay::reduce_strength(const double F)
  {
    const double half = (active - passive) / 2. / F;
    centre << half, -half, 0.;
    radius = sqrt2 * (active + passive) / 2. / F;
  }

  std::optional<double>
  AnisotropicClay::overstress(const Mandel &stress, const double *) const
  {
    return (deviator(stress) - centre).norm() - radius;
  }

  void
  AnisotropicClay::update(const Increment &increment,
                          const Response  &response) const
  {
    const MandelMatrix D     = elasticity().stiffness();
    const double       two_G = elasticity().two_G;
    const Mandel       unit  = unit_tensor<n_mandel>();
    const MandelMatrix mean  = unit * unit.transpose() / 2.,
                       dev   = MandelMatrix::Identity() - mean;
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        const Mandel trial =
          increment.stress_n[p] + elasticity().stress(increment.strain[p]);
        const Mandel from_centre = deviator(trial) - centre;
        const double size        = from_centre.norm();
        const bool   elastic     = size <= radius;
        // Radial return to the circle; the mean stress is that of the trial.
        const double part = elastic ? 1. : radius / size;
        response.mode[p]  = elastic ? Mode::elastic : Mode::cone;
        response.stress[p] =
          elastic ? trial : Mandel(trial - (1. - part) * from_centre);
        if (response.tangent.size() == 0)
          continue;
        response.tangent[p] = D;
        if (!elastic)
          {
            const Mandel n      = from_centre / size;
            response.tangent[p] = elasticity().normal_stiffness() * mean +
                                  two_G * part * (dev - n * n.transpose());
          }
      }
  }
} // namespace geocone::GEOCONE_DIM
