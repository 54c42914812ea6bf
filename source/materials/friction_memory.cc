// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/materials/friction_memory.h>
#include <geocone/materials/material.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  void
  FrictionMemory::declare(dealii::ParameterAcceptor &section)
  {
    section.add_parameter(
      entry,
      text,
      "Time [s] with which the frictional strength follows the normal stress, "
      ">= 0, or automatic. It regularises flow with small dilatancy (friction "
      "with memory). 0: exact law. Automatic: 0, except for FEM (and MPM if nu "
      "> 0.49) if a part of the boundary is pushed into a soil with theta "
      "below about phi/2 and sin(phi) - sin(theta) > 0.2: then B/1000 over its "
      "speed. B is its length, twice that length if it ends in a plane of "
      "symmetry (an end of the body along x where only 'Velocity x' = 0 is "
      "prescribed), and its radius in axisymmetric problems. Automatic is "
      "always 0 with 'Time stepping/Friction' = exact, for Drucker-Prager, and "
      "for soil that softens, where a delayed strength would lower the peak "
      "load.");
  }

  void
  FrictionMemory::prepare(const dealii::ParameterAcceptor &section,
                          const bool                       is_useful)
  {
    tau = 0.;
    if (text == "automatic")
      return;
    std::optional<double> given;
    try
      {
        given = dealii::Utilities::string_to_double(text);
      }
    catch (const dealii::ExceptionBase &)
      {}
    if (!given || !(*given >= 0.) || !std::isfinite(*given))
      throw InputError(section.get_section_name().substr(1) + "/" + entry,
                       text,
                       "automatic | a time >= 0 s",
                       "0 is the exact law; take a time in which what is "
                       "loaded moves by a thousandth of its length");
    if (is_useful) // otherwise there is nothing to delay
      tau = *given;
  }

  bool
  FrictionMemory::is_hard(const double non_associativity,
                          const double aperture_left)
  {
    // As for theta = 0 and phi = 12; smaller differences converge without
    // memory.
    constexpr double least = 0.2;
    return non_associativity > Material::strong_non_associativity &&
           aperture_left > least;
  }
} // namespace geocone::GEOCONE_DIM
