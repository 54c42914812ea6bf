// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Stages of the explicit material point method beyond stepping: resets, removals,
// kinetic damping, and the required final equilibrium.
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/explicit/explicit_mpm.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  std::vector<std::string>
  ExplicitMPM::begin_stage(const Stage &stage, const double t)
  {
    std::vector<std::string> remarks;
    if (stage.reset_displacement)
      body.reset_displacements();
    if (stage.reset_velocity)
      {
        body.reset_velocity();
        must_refresh = true;
      }
    if (stage.reset_history)
      body.reset_history(remarks);
    if (stage.removes())
      {
        if (fade_end > 0.)
          end_removal(); // of an earlier stage, up to rounding
        remarks.push_back(body.remove(stage));
        if (boundary)
          boundary->remove(stage, t);
        if (stage.removal_duration > 0.)
          fade_end = t + stage.removal_duration;
        must_refresh = true;
      }
    damping     = KineticDamping();
    stage_start = exchange();
    return remarks;
  }

  void
  ExplicitMPM::end_removal()
  {
    body.end_removal();
    fade_end     = 0.;
    must_refresh = true;
  }

  void
  ExplicitMPM::stop_at_peak()
  {
    double energy = body.kinetic_energy();
    if (damping.rising && energy < damping.energy)
      {
        body.stop();
        must_refresh = true;
        energy       = 0.;
      }
    damping = {energy, energy > damping.energy};
  }

  void
  ExplicitMPM::check_equilibrium(const Stage          &stage,
                                 const ExplicitState  &state,
                                 const ExplicitReport &report) const
  {
    const std::string section = "'Loading/" + stage.name + "/";
    const double      weight  = state.mass * gravity.norm();
    // Work of this stage, at least a thousandth of the work of the weight over
    // a cell, since a stage that starts at rest does almost no work.
    const double work =
      std::max(std::abs(exchange().stress_work - stage_start.stress_work),
               1e-3 * weight * body.grid().cell_size());
    if (stage.largest_unbalanced_force > 0. &&
        !(report.unbalanced_force <= stage.largest_unbalanced_force * weight))
      throw StepFailure(
        format("the stage '%s' has not ended in equilibrium: the largest "
               "unbalanced force is %.3g of the weight, not %.3g",
               stage.name.c_str(),
               report.unbalanced_force / weight,
               stage.largest_unbalanced_force) +
        "\n  remedy:  give it more time or damping, or check whether the "
        "body can stand; the limit is " +
        section + "Largest unbalanced force'");
    if (stage.largest_kinetic_energy > 0. &&
        !(state.energies.kinetic <= stage.largest_kinetic_energy * work))
      throw StepFailure(
        format("the stage '%s' has not ended in equilibrium: the kinetic "
               "energy is %.3g of the stress work, not %.3g",
               stage.name.c_str(),
               work > 0. ? state.energies.kinetic / work : 0.,
               stage.largest_kinetic_energy) +
        "\n  remedy:  give it more time or damping, or check whether the "
        "body can stand; the limit is " +
        section + "Largest kinetic energy'");
  }
} // namespace geocone::GEOCONE_DIM
