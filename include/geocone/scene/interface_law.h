// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_interface_law_h
#define geocone_scene_interface_law_h

#include <deal.II/base/parameter_acceptor.h>

namespace geocone
{
  /** Interface law: friction, adhesion, tensile strength and restitution, the
   *  parameters common to obstacles and contacts. */
  struct InterfaceLaw
  {
    double friction    = 0.; ///< mu of Coulomb's law
    double adhesion    = 0.; ///< shear strength without pressure (Pa)
    double tension     = 0.; ///< tensile strength (Pa)
    double restitution = 0.; ///< e of Newton's law of impact

    /** Whether the tensile strength exceeds that of any soil. */
    bool
    never_parts() const
    {
      return tension >= 1e9;
    }

    /** Declares 'Friction coefficient', 'Adhesion', 'Tensile strength' and
     *  'Restitution'. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** @throws InputError for inadmissible values */
    void
    check(const dealii::ParameterAcceptor &section) const;

    /** Check for particles. @param section with a slash @throws InputError for
     *  strengths per area */
    void
    check_without_area(const std::string &section) const;
  };
} // namespace geocone

#endif
