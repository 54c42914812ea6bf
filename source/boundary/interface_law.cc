// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/boundary/interface_law.h>

#include <cmath>

namespace geocone
{
  void
  InterfaceLaw::declare(dealii::ParameterAcceptor &section)
  {
    section.add_parameter(
      "Friction coefficient",
      friction,
      "Coefficient mu of Coulomb friction [-], >= 0; 0: smooth.");
    section.add_parameter("Adhesion",
                          adhesion,
                          "Adhesion of the closed interface [Pa], >= 0: shear "
                          "strength in addition to friction.");
    section.add_parameter(
      "Tensile strength",
      tension,
      "Tensile strength of the closed interface [Pa], >= 0, lost after "
      "separation until contact is re-established. From 1e9 on the interface "
      "never separates.");
    section.add_parameter("Restitution",
                          restitution,
                          "Coefficient of restitution [-], 0 to 1 (Newton's "
                          "law): ratio of normal velocities after and before "
                          "an impact. 0: no rebound, the gap closes exactly.");
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
    if (!(tension >= 0. && std::isfinite(tension)))
      throw InputError(name + "Tensile strength",
                       tension,
                       ">= 0 Pa, finite",
                       "0: what is pulled parts; 1e9: it never does");
    // Both are numbers of an input file: equal up to rounding.
    if (friction * tension > adhesion * (1. + 1e-5))
      throw InputError(
        name + "Tensile strength",
        tension,
        format("0 to %.6g Pa, 'Adhesion' over 'Friction coefficient'",
               adhesion / friction),
        "there the cone has its apex; without friction all "
        "pulls are possible");
    if (!(restitution >= 0. && restitution <= 1.))
      throw InputError(name + "Restitution",
                       restitution,
                       "0 to 1",
                       "0: no rebound; 1: elastic impact");
    if (restitution > 0. && tension > 0.)
      throw InputError(name + "Restitution",
                       restitution,
                       "0 beside 'Tensile strength' > 0",
                       "what sticks does not rebound: leave one of both out");
  }

  void
  InterfaceLaw::check_without_area(const std::string &section) const
  {
    const auto check = [&](const char *const entry, const double value) {
      if (value > 0.)
        throw InputError(section + entry,
                         value,
                         "0 with MPM",
                         "the surface of particles has no exact area; take "
                         "FEM");
    };
    check("Adhesion", adhesion);
    check("Tensile strength", tension);
  }
} // namespace geocone
