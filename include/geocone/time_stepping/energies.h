// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_energies_h
#define geocone_time_stepping_energies_h

#include <geocone/base/state_row.h>

namespace geocone
{
  /** Kinetic, elastic and potential energy of the body (J/m). */
  struct Energies
  {
    double kinetic = 0.; ///< v'Mv/2 of nodes (FEM) or particles (MPM)
    /** Elastic strain energy sum V s'Ss/2 over all points, with volume V,
     *  stress s and elastic compliance S. For undrained soil, the energy of the
     *  pore fluid sum V p^2/(2 K_w/n) is included. Not available in explicit
     *  steps, in which constitutive laws provide only the stress work. */
    double elastic = 0.;
    /** Gravitational potential energy in MPM, -sum m g.(x - x0), with a fixed
     *  reference point x0. The reference point x0 is the lower left corner of
     *  the mesh. In FEM the work done by the weight is part of the external
     *  work. */
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

  /** Returns the ratio of the gain of kinetic energy to the plastic work in a
   *  step. It is 0 while the kinetic energy is small against the elastic one:
   *  decaying waves and creep. */
  inline double
  share_of_plastic_work(const double gain,
                        const double plastic_work,
                        const double kinetic_energy,
                        const double elastic_energy)
  {
    return plastic_work > 0. && kinetic_energy > 1e-4 * elastic_energy
             ? gain / plastic_work
             : 0.;
  }

  /** Work done on the body and energy dissipated during one or more steps
   *  (J/m). */
  struct Works
  {
    double external    = 0.; ///< work done by loads and supports
    double dissipation = 0.; ///< plastic work, sum V s'(-z) >= 0
    /** Excess plastic work due to friction with memory or lagged friction. It
     *  is caused by the difference between the exact and the regularised
     *  strength: sum V |z_t| ||s_t| - a s_n - k|. */
    double excess_work = 0.;
    /** Energy dissipated by friction and impact at contacts, -sum h r.u (step
     *  size h, contact force r, relative velocity u). */
    double contact_dissipation = 0.;
    double ghost_work          = 0.; ///< work of GhostStiffness

    Works &
    operator+=(const Works &other)
    {
      external += other.external;
      dissipation += other.dissipation;
      excess_work += other.excess_work;
      contact_dissipation += other.contact_dissipation;
      ghost_work += other.ghost_work;
      return *this;
    }

    /** Returns the total dissipated energy in the soil and at contacts. */
    double
    dissipated() const
    {
      return dissipation + contact_dissipation;
    }

    void
    state(StateRow &row)
    {
      row(external, dissipation, excess_work, contact_dissipation, ghost_work);
    }
  };
} // namespace geocone

#endif
