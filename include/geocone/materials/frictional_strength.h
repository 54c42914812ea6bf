// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_frictional_strength_h
#define geocone_materials_frictional_strength_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
  /** Cohesion, friction and dilatancy of a law. */
  struct FrictionalStrength
  {
    double c     = 2000.; ///< cohesion (Pa)
    double phi   = 25.;   ///< friction angle (degrees)
    double theta = 25.;   ///< dilatancy angle (degrees)

    /** Of clay: phi = theta = 0. */
    static FrictionalStrength
    without_friction()
    {
      return {2000., 0., 0.};
    }

    /** Declares its three parameters in the section of a law. */
    void
    declare(dealii::ParameterAcceptor &law);

    /** Declares the cohesion alone. */
    void
    declare_cohesion(dealii::ParameterAcceptor &law,
                     const std::string         &documentation);

    /** @throws InputError @param section of the law */
    void
    check(const std::string &section) const;

    /** c and tan(phi) divided by F; theta as phi where both are the same, and else what
     *  it was, at most phi. F = 1: to the last digit what the file says. */
    FrictionalStrength
    reduced(const double F) const;
  };
} // namespace geocone

#endif
