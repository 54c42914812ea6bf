// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_energy_balance_h
#define geocone_output_energy_balance_h

#include <geocone/base/log.h>
#include <geocone/output/json.h>
#include <geocone/time_stepping/energies.h>

#include <functional>
#include <string>

namespace geocone
{
  /**
   * The balance of energy since the start of a run, by whatever method (J/m):
   *   numerical loss = E_0 + W - E - D - R,
   * E the energies of the body, W the external work, D what was dissipated, R what
   * was removed with parts of the body. It is what the time integration and the
   * transfer take; where it is negative, they have created energy. Explicit steps
   * know the work of the stress only, stored and dissipated: there it is in D, with
   * what damping takes.
   */
  class EnergyBalance
  {
  public:
    /** The part of what was turned over that may be created without a warning. */
    static constexpr double tolerance = 0.01;

    /** The energies at the start. */
    void
    begin(const Energies &energies);

    /** A step has led to these energies. @param of_lost those of particles that left
     *  the mesh, which are no more among them */
    void
    add_step(const Energies &end,
             const Energies &of_lost,
             const Works    &of_step);

    /** The energies now, with all works since the start, and what was removed, of
     *  which a part was potential energy. */
    void
    set(const Energies &now,
        const Works    &since_start,
        const double    removed,
        const double    removed_potential);

    /** The energies before and after a change of the body. */
    void
    change_body(const Energies &before, const Energies &after);

    /** At the start. */
    const Energies &
    initial() const
    {
      return at_start;
    }

    /** Since the start. */
    const Works &
    works() const
    {
      return done;
    }

    /** See the class. */
    double
    loss() const
    {
      return lost;
    }

    /** R of the class. */
    double
    removed() const
    {
      return taken_away;
    }

    double
    largest_kinetic() const
    {
      return kinetic_max;
    }

    /** E + D + R - W, which falls by the loss. */
    double
    total() const
    {
      return last.sum() + done.dissipated() + taken_away - done.external;
    }

    /** The potential energy that is no longer there, but for what was removed. */
    double
    released() const
    {
      return at_start.potential - removed_potential - last.potential;
    }

    /** The energy that was turned over, for relative losses. */
    double
    turnover() const;

    /**
     * Warns once more than 1 % of the energy was created by the method.
     * @param least what counts as turned over at the start (J/m)
     */
    void
    warn_if_created(Log               &log,
                    const double       time,
                    const std::string &unit,
                    const double       least,
                    const std::string &remedy);

    /**
     * The topic of a summary.
     * @param unit turns the unit of plane strain into that of the scene
     * @param weight_changes whether the potential energy does with it
     */
    Json
    json(const std::function<std::string(const std::string &)> &unit,
         const bool weight_changes) const;

    void
    state(StateRow &row)
    {
      row(at_start,
          last,
          done,
          lost,
          least_step_loss,
          largest_loss,
          kinetic_max,
          taken_away,
          removed_potential,
          warned);
    }

  private:
    /** What has left the body with a part of it. */
    void
    remove(const Energies &energies);

    Energies at_start, last;
    Works    done; ///< since the start
    double lost = 0., least_step_loss = 0., largest_loss = 0., kinetic_max = 0.,
           taken_away = 0., removed_potential = 0.;
    bool warned = false;
  };
} // namespace geocone

#endif
