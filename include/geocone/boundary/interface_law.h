// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_interface_law_h
#define geocone_boundary_interface_law_h

#include <geocone/base/units.h>

#include <deal.II/base/parameter_acceptor.h>

namespace geocone
{
  /** Interface law of obstacles and contacts, with friction, adhesion, tensile
   *  strength and restitution. */
  struct InterfaceLaw
  {
    double friction    = 0.; ///< friction coefficient mu (-)
    double adhesion    = 0.; ///< shear strength at zero pressure (Pa)
    double tension     = 0.; ///< tensile strength (Pa)
    double restitution = 0.; ///< coefficient of restitution e (-)

    /** Returns true if the tensile strength is so large (at least 1 GPa) that
     *  the interface never separates. */
    bool
    never_opens() const
    {
      return tension * mass_unit() >= 1e9;
    }

    /** Declares the parameters 'Friction coefficient', 'Adhesion', 'Tensile
     *  strength' and 'Restitution'. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** Checks the values. @throws InputError for inadmissible values */
    void
    check(const dealii::ParameterAcceptor &section) const;

    /** Rejects adhesion and tensile strength of the interface. For methods with
     *  contact of particles, which have no contact area.
     *  @param section name of the section with a slash
     *  @throws InputError */
    void
    check_without_area(const std::string &section) const;
  };
} // namespace geocone

#endif
