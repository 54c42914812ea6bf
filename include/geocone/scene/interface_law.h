// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_interface_law_h
#define geocone_scene_interface_law_h

#include <deal.II/base/parameter_acceptor.h>

namespace geocone
{
  /** What an interface bears while it is closed, and how it rebounds: the entries that
   *  obstacles and contacts share. */
  struct InterfaceLaw
  {
    double friction    = 0.; ///< mu of Coulomb's law
    double adhesion    = 0.; ///< shear stress borne besides (Pa)
    double tension     = 0.; ///< largest pull that it bears (Pa)
    double restitution = 0.; ///< e of Newton's law of impact

    /** No soil pulls that hard. */
    bool
    never_parts() const
    {
      return tension >= 1e9;
    }

    /** Declares 'Friction coefficient', 'Adhesion', 'Tensile strength' and
     *  'Restitution'. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** @throws InputError for what no interface has */
    void
    check(const dealii::ParameterAcceptor &section) const;

    /** For particles. @param section with a slash @throws InputError for what is borne
     *  per area */
    void
    check_without_area(const std::string &section) const;
  };
} // namespace geocone

#endif
