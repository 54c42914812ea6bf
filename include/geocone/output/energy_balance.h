// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_energy_balance_h
#define geocone_output_energy_balance_h

#include <geocone/base/log.h>
#include <geocone/folder/json.h>
#include <geocone/time_stepping/energies.h>

#include <functional>
#include <string>

namespace geocone
{
  /**
   * Energy balance of a run, for all methods (J/m). With the energy E of the body
   * (E_0 at the start), the external work W, the dissipation D and the energy R of
   * removed parts of the body, the numerical loss is
   *   loss = E_0 + W - E - D - R.
   * The loss is the energy dissipated by time integration and transfer; a negative
   * loss is energy created by them. Explicit steps provide only the total stress
   * work (stored and dissipated), which D then includes together with damping.
   */
  class EnergyBalance
  {
  public:
    /** Threshold for a warning: ratio of numerically created energy to the
     *  reference energy turnover(). */
    static constexpr double tolerance = 0.01;

    /** Sets the energies of the body at the start of the run. */
    void
    begin(const Energies &energies);

    /**
     * Adds the energies and the work of a step to the energy balance.
     * @param end energies of the body at the end of the step
     * @param of_lost energies of particles that left the mesh, not included in `end`
     */
    void
    add_step(const Energies &end,
             const Energies &of_lost,
             const Works    &of_step);

    /** Sets the current terms of the energy balance: the energies of the body,
     *  the work since the start of the run, and the total energy and potential
     *  energy of the removed parts. */
    void
    set(const Energies &now,
        const Works    &since_start,
        const double    removed,
        const double    removed_potential);

    /** Updates the energy balance for parts of the body that are added or
     *  removed. The change follows from the energies before and after. */
    void
    change_body(const Energies &before, const Energies &after);

    /** Initial energies. */
    const Energies &
    initial() const
    {
      return at_start;
    }

    /** Work since the start of the run, by contribution (J/m). */
    const Works &
    works() const
    {
      return done;
    }

    /** Numerical loss of energy since the start of the run (J/m). */
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

    /** Sum of energy, dissipation and removed energy minus external work, E + D + R
     *  - W (J/m). It decreases by the numerical loss. */
    double
    total() const
    {
      return last.sum() + done.dissipated() + taken_away - done.external;
    }

    /** Potential energy released by the body since the start of the run (J/m),
     *  without removed parts of the body. */
    double
    released() const
    {
      return at_start.potential - removed_potential - last.potential;
    }

    /** Reference energy for relative losses: the largest energy or work so far
     *  in the run (J/m). */
    double
    turnover() const;

    /** Warns once if the numerically created energy exceeds 1 % of the
     *  reference energy turnover().
     *  @param least lower limit of the turnover (J/m) */
    void
    warn_if_created(Log               &log,
                    const double       time,
                    const std::string &unit,
                    const double       least,
                    const std::string &remedy);

    /**
     * Returns the section "energy" of summary.json.
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
    /** Adds the energies of a removed part of the body to the balance. */
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
