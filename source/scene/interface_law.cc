// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/scene/interface_law.h>

#include <cmath>

namespace geocone
{
  void
  InterfaceLaw::declare(dealii::ParameterAcceptor &section)
  {
    section.add_parameter(
      "Friction coefficient", friction, "mu of Coulomb's law; 0: smooth.");
    section.add_parameter(
      "Adhesion",
      adhesion,
      "Shear stress (Pa) that the interface bears besides friction "
      "while it is closed.");
    section.add_parameter(
      "Restitution",
      restitution,
      "Part of the normal velocity with which a node rebounds that "
      "would hit in a step (Newton's law); 0: it stays, and closes exactly.");
  }

  void
  InterfaceLaw::check(const dealii::ParameterAcceptor &section) const
  {
    const std::string name = section.get_section_name().substr(1) + "/";
    if (!(friction >= 0. && std::isfinite(friction)))
      throw InputError(name + "Friction coefficient",
                       friction,
                       ">= 0, finite",
                       "0 is smooth; tan(phi) lets the soil fail first");
    if (!(adhesion >= 0. && std::isfinite(adhesion)))
      throw InputError(
        name + "Adhesion", adhesion, ">= 0 Pa, finite", "0: friction only");
    if (!(restitution >= 0. && restitution <= 1.))
      throw InputError(name + "Restitution",
                       restitution,
                       "0 to 1",
                       "0: no rebound; 1: elastic impact");
  }
} // namespace geocone
