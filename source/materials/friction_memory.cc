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
      "Time (s) in which the strength follows the normal stress, "
      ">= 0; it makes flow with little dilatancy well-posed. 0: at "
      "once, the exact law. Automatic: 0, but for FEM (for MPM if "
      "nu > 0.49) and a soil with theta below about phi/2 and "
      "sin(phi) - sin(theta) > 0.2 that a part of the boundary is "
      "pushed into: B/1000 over its speed, B its length (twice "
      "that where it is a part of a side and ends in a plane of "
      "symmetry: a side left or right on all of which only "
      "'Velocity x' is held, at 0; of a round body its radius); with "
      "'Time stepping/Friction' = exact it is 0 always, and for "
      "Drucker-Prager's cone, which is easy without.");
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
    return non_associativity > Material::hard_flow && aperture_left > least;
  }
} // namespace geocone::GEOCONE_DIM
