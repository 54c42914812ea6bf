// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/materials/hardening_mohr_coulomb.h>

namespace geocone
{
  HardeningMohrCoulomb::HardeningMohrCoulomb(const std::string &section)
    : MohrCoulomb(section)
  {
    add_parameter("Hardening modulus",
                  modulus,
                  "H (Pa), >= 0: the cohesion is c + H gamma_p, with gamma_p "
                  "the plastic shear strain.");
  }

  void
  HardeningMohrCoulomb::prepare()
  {
    MohrCoulomb::prepare();
    if (!(modulus >= 0.))
      throw InputError(parameter("Hardening modulus"),
                       modulus,
                       "H >= 0 Pa",
                       "0 is perfect plasticity; softening would make results "
                       "depend on the mesh");
    slope = 2. * modulus * std::cos(radians(friction_angle()));
  }

  std::string
  HardeningMohrCoulomb::initialise(const Stress &stress, double *history) const
  {
    history[plastic_shear()] = 0.;
    return MohrCoulomb::initialise(stress, history);
  }

  std::vector<ConstitutiveLaw::Shown>
  HardeningMohrCoulomb::shown() const
  {
    std::vector<Shown> all = MohrCoulomb::shown();
    all.push_back({"cohesion", "cohesion (Pa)"});
    return all;
  }

  void
  HardeningMohrCoulomb::show(const std::array<double, 3> &in_plane,
                             const double                *history,
                             double                      *values) const
  {
    MohrCoulomb::show(in_plane, history, values);
    values[MohrCoulomb::shown().size()] =
      cohesion() + modulus * history[plastic_shear()];
  }

  std::optional<FlowCone>
  HardeningMohrCoulomb::flow_cone(const double *history) const
  {
    FlowCone cone = *MohrCoulomb::flow_cone(nullptr);
    cone.k += slope / sqrt2 * history[plastic_shear()];
    cone.hardening = slope;
    return cone;
  }

  bool
  HardeningMohrCoulomb::has_symmetric_tangent() const
  {
    return MohrCoulomb::has_symmetric_tangent() &&
           (slope == 0. || friction_angle() == 0.);
  }

  void
  HardeningMohrCoulomb::add_to_history(const double slip, double *history) const
  {
    history[plastic_shear()] += sqrt2 * slip;
  }
} // namespace geocone
