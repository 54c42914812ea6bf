// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/materials/material.h>

namespace geocone
{
  Material::Material(const std::string &section)
    : dealii::ParameterAcceptor("/" + section)
  {
    add_parameter("Density", rho, "Mass density rho (kg/m^3), > 0.");
    add_parameter("Young modulus", young_modulus, "E (Pa), > 0.");
    add_parameter("Poisson ratio",
                  poisson_ratio,
                  "nu (-), between -1 and 0.5, both excluded.");
  }

  std::string
  Material::parameter(const std::string &name) const
  {
    return get_section_name().substr(1) + "/" + name;
  }

  void
  Material::prepare()
  {
    if (!(rho > 0.))
      throw InputError(
        parameter("Density"),
        rho,
        "rho > 0 kg/m^3",
        "without inertia and gravity any positive value will do");
    if (!(young_modulus > 0.))
      throw InputError(parameter("Young modulus"),
                       young_modulus,
                       "E > 0 Pa",
                       "soils have 1e6 to 1e9 Pa");
    if (!(poisson_ratio > -1. && poisson_ratio < 0.5))
      throw InputError(parameter("Poisson ratio"),
                       poisson_ratio,
                       "-1 < nu < 0.5",
                       "for a nearly incompressible material take 0.49");
    elastic = Elasticity(young_modulus, poisson_ratio);
  }

  double
  Material::non_associativity() const
  {
    const std::optional<FlowCone> cone = flow_cone();
    return cone && cone->a > 0. ? (cone->a - cone->b) / cone->a : 0.;
  }
} // namespace geocone
