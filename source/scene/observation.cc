// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/number_in.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/laws/material_library.h>
#include <geocone/scene/observation.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_observation[] = {
      {"Observation/*",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Observation/Component", "Discretisation/Method", {"FEM", "MPM"}},
      {"Observation/Factor", "Discretisation/Method", {"FEM", "MPM"}},
      {"Observation/Plateau tolerance",
       "Discretisation/Method",
       {"FEM", "MPM"}},
      {"Observation/Component", "Observation/Conditions", {}},
      {"Observation/Factor",
       "Observation/Conditions",
       {},
       "Loading/*/Scaled loads"},
      {"Observation/Plateau tolerance",
       "Observation/Conditions",
       {},
       "Loading/*/Scaled loads"},
      {"Observation/Reference", "Discretisation/Method", {"FEM", "MPM"}},
      {"Observation/Reference material", "Observation/Reference", {"Prandtl"}},
      {"Observation/Reference width", "Observation/Reference", {"Prandtl"}},
      {"Observation/Reference surcharge",
       "Observation/Reference",
       {"Prandtl"}}};
  } // namespace

  double
  bearing_capacity_factor_q(const double phi)
  {
    const double t = std::tan(radians(45. + phi / 2.));
    return std::exp(pi * std::tan(radians(phi))) * t * t;
  }

  double
  bearing_capacity_factor_c(const double phi)
  {
    // Below a thousandth of a degree the difference Nq - 1 cancels; the limit
    // is more accurate then.
    return phi < 1e-3
             ? 2. + pi
             : (bearing_capacity_factor_q(phi) - 1.) / std::tan(radians(phi));
  }

  Observation::Observation()
    : dealii::ParameterAcceptor("/Observation")
  {
    add_parameter("Conditions",
                  names,
                  "Names of boundary conditions, obstacles and contacts (force "
                  "on 'Body') whose reactions are reported; the first gives "
                  "the load-displacement curve.");
    observed.declare(
      *this, "Component", ": component of the reaction that is the load.");
    add_parameter(
      "Factor",
      factor,
      "Load = factor x reaction of the support on the body [-]: -1 for a "
      "positive downward load, -2 if half of a symmetric body is modelled. "
      "Without 'Conditions', with load stepping: |factor| x load factor.");
    add_parameter(
      "Reference",
      value,
      "Reference load: none, a number [N/m, or - where the load is a factor], "
      "or Prandtl: the exact load width x (c Nc + surcharge x Nq) of a strip "
      "footing on weightless soil.");
    add_parameter("Reference material",
                  material,
                  "Material with the c and phi of Prandtl's load; empty: the "
                  "first material.");
    add_parameter("Reference width",
                  width,
                  "Full width of the footing for Prandtl's load [m].");
    add_parameter("Reference surcharge",
                  surcharge,
                  "Surcharge beside the footing for Prandtl's load [Pa].");
    add_parameter("Points",
                  points,
                  "Initial positions [m] of points whose displacements are "
                  "reported. FEM: displacement field at this position. MPM: "
                  "nearest material point, which is tracked.");
    add_parameter("Moment centre",
                  centre,
                  "Reference point of the moments of the reactions [m], about "
                  "z, counterclockwise positive; in three dimensions about x, "
                  "y and z. Empty: for each condition the centre of the "
                  "initial bounding box of its points.");
    add_parameter(
      "Plateau tolerance",
      plateau_tolerance,
      "Relative drift of the load [-] that defines the plateau: the limit load "
      "is the mean over the last part of the curve with a smaller drift.");
  }

  void
  Observation::prepare(const std::vector<std::string> &supports,
                       const Materials                &materials,
                       const Gravity                  &gravity,
                       const bool                      scales_loads)
  {
    conditions.clear();
    for (const std::string &name : names)
      {
        const auto found = std::find(supports.begin(), supports.end(), name);
        if (found == supports.end())
          throw InputError("Observation/Conditions",
                           name,
                           "names of the lists 'Boundary conditions/Names' and "
                           "'Obstacles/Names'",
                           "check the spelling");
        conditions.push_back(found - supports.begin());
      }
    of_scaled_loads = scales_loads && conditions.empty();
    component = observed == Component::x ? 0 : observed == Component::y ? 1 : 2;
    if (!std::isfinite(factor) || factor == 0. || std::abs(factor) > 1e6)
      throw InputError("Observation/Factor",
                       factor,
                       "a number other than zero, of 1e6 at most",
                       "-1 makes a downward load positive, -2 where only half "
                       "of a symmetric body is modelled");
    if (centre.size() > 1)
      throw InputError("Observation/Moment centre",
                       dealii::Patterns::Tools::to_string(centre),
                       std::string("one point ") + coordinates + ", or nothing",
                       "all observed conditions share one; leave it empty for "
                       "the centre of each");
    for (const auto &[entry, list] :
         {std::pair<const char *, const std::vector<dealii::Point<dim>> *>(
            "Points", &points),
          {"Moment centre", &centre}})
      for (const dealii::Point<dim> &x : *list)
        if (!std::isfinite(x.square()))
          throw InputError(std::string("Observation/") + entry,
                           dealii::Patterns::Tools::to_string(*list),
                           "finite numbers (m)",
                           std::string("give coordinates ") + coordinates);
    if (!(plateau_tolerance > 0.))
      throw InputError("Observation/Plateau tolerance",
                       plateau_tolerance,
                       "> 0",
                       "0.01 is usual");

    reference.reset();
    reference_name.clear();
    if (value == "none")
      return;
    if (!has_load())
      throw InputError("Observation/Reference",
                       value,
                       "none, where no condition is observed",
                       "name the loaded part in 'Observation/Conditions'");
    if (value == "Prandtl" && dim == 3)
      throw InputError("Observation/Reference",
                       value,
                       "none or a number (N) in three dimensions",
                       "Prandtl's load is that of a strip: give the load of "
                       "this footing");
    if (value == "Prandtl")
      {
        take_prandtl(materials, gravity);
        return;
      }
    const auto number = number_in(value);
    if (!number || !std::isfinite(*number) || *number == 0.)
      throw InputError("Observation/Reference",
                       value,
                       "none, Prandtl, or a number other than zero (N/m)",
                       "choose one of them");
    reference      = *number;
    reference_name = "reference";
  }

  void
  Observation::take_prandtl(const Materials &materials, const Gravity &gravity)
  {
    unsigned int index = materials.size();
    for (unsigned int i = 0; i < materials.size(); ++i)
      if (materials.name(i) == material || (material.empty() && i == 0))
        index = i;
    const auto law = index < materials.size()
                       ? materials.law(index).plane_strain_strength()
                       : std::nullopt;
    if (!law)
      throw InputError("Observation/Reference material",
                       material,
                       "the name of a Mohr-Coulomb or Tresca material",
                       "Prandtl's load needs c and phi");
    if (!(width > 0. && std::isfinite(width)))
      throw InputError("Observation/Reference width",
                       width,
                       "> 0 m, finite",
                       "give the width of the whole footing");
    if (!(surcharge >= 0. && std::isfinite(surcharge)))
      throw InputError("Observation/Reference surcharge",
                       surcharge,
                       ">= 0 Pa, finite",
                       "give the pressure beside the footing");
    if (law->gradient != 0.)
      throw InputError("Observation/Reference",
                       value,
                       "none or a number (N/m) where the cohesion grows with "
                       "depth",
                       "Prandtl's soil has the same strength everywhere");
    const double phi = law->phi;
    if (materials.law(index).fluid_modulus() > 0.)
      throw InputError(
        "Observation/Reference",
        value,
        "none or a number (N/m) on undrained soil, whose strength is that of "
        "the stress before the load",
        "without dilatancy s_u = c cos(phi) + p sin(phi), p the mean effective "
        "pressure in the plane; a strip carries (2 + pi) s_u times its width");
    // Weight increases the bearing capacity of frictional soil only.
    if (phi > 0. && materials.law(index).density() > 0. && gravity.acts())
      throw InputError(
        "Observation/Reference",
        value,
        "none or a number (N/m), where gravity acts on soil with "
        "friction: Prandtl's load is that of weightless soil",
        "set Reference = none or give the load of the soil with "
        "its weight, or set Gravity/Acceleration = 0, 0");
    const double load = width * (law->c * bearing_capacity_factor_c(phi) +
                                 surcharge * bearing_capacity_factor_q(phi));
    if (!(load > 0. && std::isfinite(load)))
      throw InputError("Observation/Reference",
                       value,
                       "none or a number (N/m), where Prandtl's load, here " +
                         format("%g", load) + " N/m, is not > 0 and finite",
                       "give the soil cohesion or the ground a surcharge "
                       "('Reference surcharge'), or set Reference = none");
    reference      = load;
    reference_name = "Prandtl";
  }
} // namespace geocone::GEOCONE_DIM
