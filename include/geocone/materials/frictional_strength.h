// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_frictional_strength_h
#define geocone_materials_frictional_strength_h

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>

namespace geocone
{
  /** Cohesion, friction and dilatancy of a law. */
  struct FrictionalStrength
  {
    double c     = 2000.; ///< cohesion (Pa)
    double phi   = 25.;   ///< friction angle (degrees)
    double theta = 25.;   ///< dilatancy angle (degrees)

    /** Largest principal stress of the plane (Pa). */
    double tension = std::numeric_limits<double>::infinity();

    double gradient = 0.; ///< of the cohesion with depth (Pa/m)
    double level    = 0.; ///< where it is c: y (m)

    /** By how much the cohesion at y is more than c (Pa). */
    double
    growth(const double y) const
    {
      return gradient * (level - y);
    }

    /** Of clay: phi = theta = 0. */
    static FrictionalStrength
    without_friction()
    {
      FrictionalStrength clay;
      clay.phi = clay.theta = 0.;
      return clay;
    }

    /** Declares its three parameters in the section of a law. */
    void
    declare(dealii::ParameterAcceptor &law);

    /** Declares the cohesion alone. */
    void
    declare_cohesion(dealii::ParameterAcceptor &law,
                     const std::string         &documentation);

    /** Declares how the cohesion grows with depth. */
    void
    declare_growth(dealii::ParameterAcceptor &law);

    /** Declares the tensile strength. */
    void
    declare_tension(dealii::ParameterAcceptor &law);

    /** Takes the tensile strength from its text.
     *  @throws InputError @param section of the law */
    void
    prepare(const std::string &section);

    /** c and tan(phi) divided by F; theta as phi where both are the same, and else what
     *  it was, at most phi. F = 1: to the last digit what the file says. */
    FrictionalStrength
    reduced(const double F) const;

  private:
    std::string tension_text = "none";
  };
} // namespace geocone

#endif
