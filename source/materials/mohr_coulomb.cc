// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/materials/mohr_coulomb.h>

namespace geocone
{
  MohrCoulomb::MohrCoulomb(const std::string &section)
    : Material(section)
  {
    add_parameter("Cohesion", c, "c (Pa), >= 0; > 0 where phi = 0.");
    add_parameter("Friction angle", phi, "phi (degrees), 0 <= phi < 90.");
    add_parameter("Dilatancy angle",
                  theta,
                  "theta (degrees), 0 <= theta <= phi. theta = phi is "
                  "associated flow.");
  }

  MohrCoulomb::MohrCoulomb(const std::string &section, const WithoutFriction &)
    : Material(section)
    , phi(0.)
    , theta(0.)
  {
    add_parameter("Cohesion", c, "Undrained shear strength c (Pa), > 0.");
  }

  void
  MohrCoulomb::prepare()
  {
    Material::prepare();
    if (!(phi >= 0. && phi < 90.))
      throw InputError(parameter("Friction angle"),
                       phi,
                       "0 <= phi < 90 degrees",
                       "give the angle in degrees; soils have 0 to 45");
    if (!(theta >= 0. && theta <= phi))
      throw InputError(
        parameter("Dilatancy angle"),
        theta,
        "0 <= theta <= phi = " + std::to_string(phi).substr(0, 6) + " degrees",
        "theta = phi is associated flow, theta = 0 flow without "
        "dilatancy; more dilatancy than friction would create "
        "energy");
    if (!(c >= 0.))
      throw InputError(
        parameter("Cohesion"), c, "c >= 0 Pa", "give the cohesion in Pa");
    if (c == 0. && phi == 0.)
      throw InputError(parameter("Cohesion"),
                       c,
                       "c > 0 Pa where phi = 0",
                       "a material without cohesion and friction has no "
                       "strength at all: give it one of them");
    cone.a = std::sin(radians(phi));
    cone.b = theta == phi ? cone.a : std::sin(radians(theta));
    cone.k = sqrt2 * c * std::cos(radians(phi));
  }

  void
  MohrCoulomb::update(const Increment &increment,
                      const Response  &response) const
  {
    const double       K               = elasticity().normal_stiffness();
    const double       two_G           = elasticity().two_G;
    const bool         linear          = response.tangent.size() > 0;
    const double       lag             = increment.friction_lag;
    const MandelMatrix elastic_tangent = elasticity().stiffness();
    const bool         fixed           = !hardens();
    const auto         s_n             = [&](const std::size_t p) {
      return to_cone_axes(increment.stress_n[p])[0];
    };
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        const std::size_t first = increment.n_history * p;
        const FlowCone    law =
          fixed ? cone : *flow_cone(increment.history_n + first);
        const Mandel trial =
          increment.stress_n[p] + elasticity().stress(increment.strain[p]);
        const Mandel in_axes = to_cone_axes(trial);
        Mandel       returned;
        MandelMatrix tangent;
        response.mode[p] = return_map(lag > 0. ? law.delayed(lag, s_n(p)) : law,
                                      K,
                                      two_G,
                                      in_axes,
                                      returned,
                                      linear ? &tangent : nullptr);
        if (!fixed && response.history != nullptr)
          add_to_history(FlowCone::tangential_norm(Mandel(in_axes - returned)) /
                           two_G,
                         response.history + first);
        // An elastic point keeps its trial stress to the last digit.
        const bool elastic = response.mode[p] == Mode::elastic;
        response.stress[p] = elastic ? trial : from_cone_axes(returned);
        if (linear)
          response.tangent[p] =
            elastic ? elastic_tangent : from_cone_axes(tangent);
      }
  }
} // namespace geocone
