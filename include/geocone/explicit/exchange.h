// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_explicit_exchange_h
#define geocone_explicit_exchange_h

#include <geocone/base/archive.h>
#include <geocone/base/types.h>

#include <deal.II/base/tensor.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Momentum, energy and mass exchanged between the body and the environment.
   * They are sums over all explicit steps since the start; global sums are
   * returned by ExplicitMPM::exchange().
   */
  struct Exchange
  {
    double stress_work  = 0.; ///< stress work, sum of s : de V (J/m)
    double gravity_work = 0.; ///< work of gravity, sum of m g dx (J/m)
    double damping_work = 0.; ///< dissipated by local damping (J/m)
    double contact_dissipation =
      0.;                     ///< by friction and impact on obstacles (J/m)
    double seepage_work = 0.; ///< dissipated by flowing pore water (J/m)
    double outflow      = 0.; ///< volume of pore water that has left (m^2)
    /** Work done by prescribed velocities, obstacles, tractions, absorbing boundaries
     *  and the buoyancy of pore water (J/m). */
    double support_work = 0.;

    /** Total impulse of gravity, damping and support forces (N s/m). */
    dealii::Tensor<1, dim> impulse;

    /** Mass, momentum and energy of removed points: excavated in a stage
     *  (Stage::removes()) or lost through the edge of the grid. */
    double                 removed_mass = 0.;      ///< (kg/m)
    dealii::Tensor<1, dim> removed_momentum;       ///< (N s/m)
    double                 removed_energy    = 0.; ///< kinetic energy (J/m)
    double                 removed_potential = 0.; ///< from the lower corner

    /** Volume of removed saturated points, and of the water that their pore
     *  pressure stores (m^2). */
    double removed_volume = 0., removed_stored = 0.;

    /** Kinetic energy removed by kinetic damping (J/m). */
    double stopped_energy = 0.;

    unsigned long small_masses = 0; ///< nodes skipped, mass too small

    void
    state(StateRow &row)
    {
      row(stress_work,
          gravity_work,
          damping_work,
          contact_dissipation,
          seepage_work,
          outflow,
          support_work,
          impulse,
          removed_mass,
          removed_momentum,
          removed_energy,
          removed_potential,
          removed_volume,
          removed_stored,
          stopped_energy,
          small_masses);
    }
  };
} // namespace geocone::GEOCONE_DIM

#endif
