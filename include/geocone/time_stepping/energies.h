// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_energies_h
#define geocone_time_stepping_energies_h

#include <geocone/base/state_row.h>

namespace geocone
{
  /** Energies of the body (J/m). */
  struct Energies
  {
    double kinetic = 0.; ///< v'Mv/2 of the nodes (FEM) or the particles (MPM)
    /** sum V s'Ss/2, and of fluid in pores sum V p^2/(2 K_w/n). Explicit steps do
     *  not know it: their laws tell the work of the stress only. */
    double elastic = 0.;
    /** MPM: -sum m g.(x - x0), x0 the lower left corner of the mesh. FEM counts
     *  the work of the weight as external instead. */
    double potential = 0.;

    double
    sum() const
    {
      return kinetic + elastic + potential;
    }

    Energies
    operator-(const Energies &other) const
    {
      return {kinetic - other.kinetic,
              elastic - other.elastic,
              potential - other.potential};
    }

    void
    state(StateRow &row)
    {
      row(kinetic, elastic, potential);
    }
  };

  /** What has been done to the body and in it, over a step or more (J/m). */
  struct Works
  {
    double external    = 0.; ///< of loads and supports
    double dissipation = 0.; ///< sum V s'(-z) >= 0, without that of contact
    /** sum V |z_t| ||s_t| - a s_n - k|, the plastic work by which friction that lags or
     *  has a memory differs from the exact strength. */
    double of_excess = 0.;
    /** -sum h r.u of what touches obstacles, friction and impact. */
    double contact_dissipation = 0.;
    double of_ghosts           = 0.; ///< of GhostStiffness; a part of the loss

    Works &
    operator+=(const Works &other)
    {
      external += other.external;
      dissipation += other.dissipation;
      of_excess += other.of_excess;
      contact_dissipation += other.contact_dissipation;
      of_ghosts += other.of_ghosts;
      return *this;
    }

    /** What leaves the energies of the body for good. */
    double
    dissipated() const
    {
      return dissipation + contact_dissipation;
    }

    void
    state(StateRow &row)
    {
      row(external, dissipation, of_excess, contact_dissipation, of_ghosts);
    }
  };
} // namespace geocone

#endif
