// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/constants.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/number_in.h>
#include <geocone/materials/frictional_strength.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  void
  FrictionalStrength::declare(dealii::ParameterAcceptor &law)
  {
    declare_cohesion(law, "Cohesion c [Pa], >= 0; > 0 if phi = 0.");
    law.add_parameter(
      "Friction angle", phi, "Friction angle phi [degrees], 0 <= phi < 90.");
    law.add_parameter(
      "Dilatancy angle",
      theta,
      "Dilatancy angle theta (psi in most textbooks) [degrees], 0 <= theta <= "
      "phi. theta = phi: associated flow.");
  }

  void
  FrictionalStrength::declare_cohesion(dealii::ParameterAcceptor &law,
                                       const std::string         &documentation)
  {
    law.add_parameter("Cohesion", c, documentation);
  }

  void
  FrictionalStrength::declare_growth(dealii::ParameterAcceptor &law)
  {
    law.add_parameter(
      "Cohesion gradient",
      gradient,
      "Increase of the cohesion with depth [Pa/m]: c + gradient (level - y), "
      "evaluated at the initial position of a point.");
    law.add_parameter("Cohesion level",
                      level,
                      "Level y [m] at which the cohesion is 'Cohesion', for a "
                      "'Cohesion gradient'.");
  }

  void
  FrictionalStrength::declare_tension(dealii::ParameterAcceptor &law)
  {
    law.add_parameter(
      "Tensile strength",
      tension_text,
      "Tensile strength [Pa], >= 0: tension cut-off (Rankine) of the principal "
      "stresses, of those in the plane in plane strain, with associated flow. "
      "Three-dimensional scenes have it for 'Analysis/Kind' = limit load and "
      "strength reduction. none: tension is limited only by the cone, to "
      "c cot(phi).");
  }

  void
  FrictionalStrength::prepare(const std::string &section)
  {
    if (tension_text != "none")
      {
        const auto value = number_in(tension_text);
        if (!value || !(*value >= 0. && std::isfinite(*value)))
          throw InputError(section + "/Tensile strength",
                           tension_text,
                           "none, or a number >= 0 (Pa)",
                           "0 is soil that carries no tension");
        tension = *value;
      }
    if (!(phi >= 0. && phi < 90.))
      throw InputError(section + "/Friction angle",
                       phi,
                       "0 <= phi < 90 degrees",
                       "give the angle in degrees; soils have 0 to 45");
    if (!(theta >= 0. && theta <= phi))
      throw InputError(
        section + "/Dilatancy angle",
        theta,
        "0 <= theta <= phi = " + std::to_string(phi).substr(0, 6) + " degrees",
        "theta = phi is associated flow, theta = 0 flow without "
        "dilatancy; more dilatancy than friction would create "
        "energy");
    if (!(c >= 0.))
      throw InputError(section + "/Cohesion",
                       c,
                       "c >= 0 Pa",
                       "give a cohesion that is not negative");
    if (c == 0. && phi == 0. && gradient == 0.)
      throw InputError(section + "/Cohesion",
                       c,
                       "c > 0 Pa where phi = 0",
                       "a material without cohesion and friction has no "
                       "strength at all: give it one of them");
  }

  FrictionalStrength
  FrictionalStrength::reduced(const double F) const
  {
    if (F == 1.)
      return *this;
    const double angle     = std::atan(std::tan(radians(phi)) / F) * 180. / pi;
    FrictionalStrength now = *this;
    now.c                  = c / F;
    now.phi                = angle;
    now.theta              = theta == phi ? angle : std::min(theta, angle);
    now.tension            = tension / F;
    now.gradient           = gradient / F;
    return now;
  }
} // namespace geocone
