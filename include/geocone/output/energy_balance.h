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
   * Energy balance since the start of a run, for all methods (J/m):
   *   numerical loss = E_0 + W - E - D - R,
   * E the energy of the body, W the external work, D the dissipation, R the energy
   * of removed parts of the body. The loss is the energy dissipated by time
   * integration and transfer; if negative, they have created energy. Explicit steps
   * provide only the total stress work (stored and dissipated), which D then
   * includes together with damping.
   */
  class EnergyBalance
  {
  public:
    /**
     * Tolerance for spuriously created energy, relative to the energy turnover.
     */
    static constexpr double tolerance = 0.01;

    /** Sets the initial energies. */
    void
    begin(const Energies &energies);

    /**
     * Appends a step to the balance, given the energies at its end.
     * @param of_lost energies of particles that left the mesh, not included in `end`
     */
    void
    add_step(const Energies &end,
             const Energies &of_lost,
             const Works    &of_step);

    /** Sets the current energies, the work done since the start, and the energy of
     *  removed parts of the body, in total and potential. */
    void
    set(const Energies &now,
        const Works    &since_start,
        const double    removed,
        const double    removed_potential);

    /** Accounts for parts added to or removed from the body, by the energies before
     *  and after. */
    void
    change_body(const Energies &before, const Energies &after);

    /** Initial energies. */
    const Energies &
    initial() const
    {
      return at_start;
    }

    /** Work done since the start, by contribution (J/m). */
    const Works &
    works() const
    {
      return done;
    }

    /** Numerical loss of energy (J/m). */
    double
    loss() const
    {
      return lost;
    }

    /** Energy R of removed parts of the body (J/m). */
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

    /** Balance E + D + R - W, which decreases by the numerical loss (J/m). */
    double
    total() const
    {
      return last.sum() + done.dissipated() + taken_away - done.external;
    }

    /** Released potential energy, excluding removed parts of the body (J/m). */
    double
    released() const
    {
      return at_start.potential - removed_potential - last.potential;
    }

    /** Energy turnover (largest energy or work), the reference of relative losses
     *  (J/m). */
    double
    turnover() const;

    /** Warns once if spuriously created energy exceeds 1 % of the energy turnover.
     *  @param least lower limit of the turnover (J/m) */
    void
    warn_if_created(Log               &log,
                    const double       time,
                    const std::string &unit,
                    const double       least,
                    const std::string &remedy);

    /**
     * Topic "energy" of a summary.
     * @param unit converts a unit of plane strain into the unit of the scene
     * @param weight_changes whether the potential energy changes with the weight
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
    /** Accounts for the energies of a removed part of the body. */
    void
    remove(const Energies &energies);

    Energies at_start, last;
    Works    done; ///< work done since the start
    double lost = 0., least_step_loss = 0., largest_loss = 0., kinetic_max = 0.,
           taken_away = 0., removed_potential = 0.;
    bool warned = false;
  };
} // namespace geocone

#endif
