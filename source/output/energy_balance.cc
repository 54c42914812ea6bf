// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/energy_balance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
{
  void
  EnergyBalance::begin(const Energies &energies)
  {
    at_start = last = energies;
    kinetic_max     = energies.kinetic;
  }

  void
  EnergyBalance::add_step(const Energies &end,
                          const Energies &of_lost,
                          const Works    &of_step)
  {
    const double step_loss = last.sum() + of_step.external - end.sum() -
                             of_lost.sum() - of_step.dissipated();
    remove(of_lost);
    done += of_step;
    last = end;
    lost += step_loss;
    least_step_loss = std::min(least_step_loss, step_loss);
    largest_loss    = std::max(largest_loss, std::abs(lost));
    kinetic_max     = std::max(kinetic_max, end.kinetic);
  }

  void
  EnergyBalance::set(const Energies &now,
                     const Works    &since_start,
                     const double    removed,
                     const double    potential_part)
  {
    last                = now;
    done                = since_start;
    taken_away          = removed;
    removed_potential   = potential_part;
    const double before = lost;
    // Differences first: the potential energy may be large compared with its changes.
    lost = done.external + released() - done.dissipated() -
           (taken_away - removed_potential) -
           (last.kinetic - at_start.kinetic) -
           (last.elastic - at_start.elastic);
    least_step_loss = std::min(least_step_loss, lost - before);
    largest_loss    = std::max(largest_loss, std::abs(lost));
    kinetic_max     = std::max(kinetic_max, now.kinetic);
  }

  void
  EnergyBalance::change_body(const Energies &before, const Energies &after)
  {
    last = after;
    remove(before - after);
  }

  void
  EnergyBalance::remove(const Energies &energies)
  {
    taken_away += energies.sum();
    removed_potential += energies.potential;
  }

  double
  EnergyBalance::turnover() const
  {
    return std::max({kinetic_max,
                     last.elastic,
                     std::abs(done.external),
                     done.dissipated(),
                     std::abs(released())});
  }

  void
  EnergyBalance::warn_if_created(Log               &log,
                                 const double       time,
                                 const std::string &unit,
                                 const double       least,
                                 const std::string &remedy)
  {
    // Energy within rounding of zero is ignored.
    const double scale = std::max(turnover(), least);
    if (warned || !(lost < -tolerance * scale) || !(lost < -1e-12))
      return;
    warned = true;
    log.warn(format("the numerical method has created %.3g %s, %.2g %% of the "
                    "energy that was turned over until t = %.4g s: ",
                    -lost,
                    unit.c_str(),
                    -100. * lost / scale,
                    time) +
             remedy);
  }

  Json
  EnergyBalance::json(
    const std::function<std::string(const std::string &)> &unit,
    const bool                                             weight_changes) const
  {
    const auto ratio = [](const double a, const double b) {
      return b > 0. ? Json(a / b) : Json();
    };
    // The zero of the potential energy is arbitrary.
    const double     begin = at_start.kinetic + at_start.elastic;
    const Json       out   = weight_changes ? Json() : Json(released());
    constexpr double least = std::numeric_limits<double>::min();
    const double     scale = std::max(turnover(), least);
    // Rounding error of a step's loss.
    const double rounding = std::max({std::abs(done.external),
                                      std::abs(released()),
                                      last.elastic,
                                      last.kinetic,
                                      at_start.sum(),
                                      least});
    Json         json     = {
                  {unit("external_work_J_per_m"), done.external},
                  {unit("kinetic_J_per_m"), last.kinetic},
                  {unit("largest_kinetic_J_per_m"), kinetic_max},
                  {unit("potential_J_per_m"), last.potential},
                  {"potential_datum", "lower left corner of the mesh"},
                  {unit("initial_J_per_m"), at_start.sum()},
                  {unit("released_potential_J_per_m"), out},
                  {unit("numerical_loss_J_per_m"), lost},
                  {"numerical_loss_relative", lost / scale},
                  {"numerical_loss_max_relative", largest_loss / scale},
                  {"loss_to_released", out.is_null() ? out : ratio(lost, released())},
                  {"loss_to_initial", ratio(lost, begin)},
                  {"least_step_loss_relative", least_step_loss / rounding}};
    if (begin > 0.)
      json["loss_max_to_initial"] = largest_loss / begin;
    if (at_start.kinetic > 0.)
      json["kinetic_to_initial"] = last.kinetic / at_start.kinetic;
    if (taken_away != 0.)
      json[unit("removed_J_per_m")] = taken_away;
    return json;
  }
} // namespace geocone
