// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/laws/drucker_prager.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const double sqrt3 = std::sqrt(3.);
  } // namespace

  DruckerPrager::DruckerPrager(const std::string &section)
    : FrictionalSpatialLaw(section)
  {
    match.declare(
      *this,
      "Match",
      ": match of the cone with Mohr-Coulomb's pyramid. Plane strain: same "
      "strength in plane strain with associated flow. Outer: in triaxial "
      "compression. Inner: in triaxial extension.");
  }

  void
  DruckerPrager::set_strength(const double F)
  {
    const FrictionalStrength strength = given.reduced(F);
    // Alpha, and kappa over c cos(angle).
    const auto sizes = [&](const double degrees) {
      const double s = std::sin(radians(degrees)),
                   q = std::cos(radians(degrees));
      if (match == Match::plane_strain)
        {
          const double root = std::sqrt(9. * q * q + 12. * s * s);
          return std::pair(s / root, 3. / root);
        }
      const double sign = match == Match::outer ? -1. : 1.;
      const double size = sqrt3 * (3. + sign * s);
      return std::pair(2. * s / size, 6. / size);
    };
    const auto [alpha, kappa] = sizes(strength.phi);
    cone.a                    = std::sqrt(6.) * alpha;
    cone.b = std::min(std::sqrt(6.) * sizes(strength.theta).first, cone.a);
    cone.k = sqrt2 * kappa * strength.c * std::cos(radians(strength.phi));
    k_per_cohesion = sqrt2 * kappa * std::cos(radians(strength.phi)) / F;
  }

  std::optional<FlowCone>
  DruckerPrager::step_cone(const Mandel   &stress_n,
                           const double   *history_n,
                           const StepData &step) const
  {
    if (dim == 2)
      return std::nullopt;
    return cone_of(own_strength(extended(stress_n, 0.), history_n, step));
  }

  FlowCheck
  DruckerPrager::check_plastic_strain(const SpatialMandel &plastic_strain,
                                      const SpatialMandel &stress,
                                      const OwnStrength   &own) const
  {
    return FlowCheck::of_cone(cone_of(own),
                              cone_with(own.cohesion),
                              SpatialMandel(spatial_axes() * -plastic_strain),
                              SpatialMandel(spatial_axes() * stress),
                              elasticity().two_G);
  }

  double
  DruckerPrager::excess_work_density(const SpatialMandel &plastic_strain,
                                     const SpatialMandel &stress,
                                     const double        *history) const
  {
    return FlowCone::tangential_norm(
             SpatialMandel(spatial_axes() * plastic_strain)) *
           std::abs(*yield_function(stress, history));
  }

  Mode
  DruckerPrager::return_to_strength(const SpatialMandel &trial,
                                    const OwnStrength   &own,
                                    SpatialMandel       &stress,
                                    SpatialMandelMatrix *tangent) const
  {
    const SpatialMandel t = spatial_axes() * trial;
    SpatialMandel       s;
    const Mode          mode = return_map(cone_of(own),
                                 elasticity().spatial_normal_stiffness(),
                                 elasticity().two_G,
                                 t,
                                 s,
                                 tangent);
    // Elastic points keep their trial stress exactly.
    stress = mode == Mode::elastic
               ? trial
               : SpatialMandel(spatial_axes().transpose() * s);
    if (tangent != nullptr)
      *tangent = spatial_axes().transpose() * (*tangent * spatial_axes());
    return mode;
  }

  std::optional<double>
  DruckerPrager::yield_function(const SpatialMandel &stress,
                                const double        *history) const
  {
    return cone_with(cohesion_increase(history))
      .yield_function(SpatialMandel(spatial_axes() * stress));
  }
} // namespace geocone::GEOCONE_DIM
