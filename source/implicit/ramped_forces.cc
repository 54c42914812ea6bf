// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/implicit/ramped_forces.h>
#include <geocone/time_stepping/time_stepper.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  void
  RampedForces::add(Vector       difference,
                    const double begin,
                    const double duration)
  {
    // Forces of earlier stages end with these, up to rounding.
    list.erase(
      std::remove_if(list.begin(),
                     list.end(),
                     [&](const Ramp &other) { return other.begin < begin; }),
      list.end());
    if (duration > 0.)
      list.push_back({std::move(difference), begin, duration});
  }

  void
  RampedForces::add_to(Vector &force, const double t) const
  {
    for (const Ramp &ramped : list)
      {
        const double left = 1. - (t - ramped.begin) / ramped.duration;
        if (left > 1e-12)
          force.add(left, ramped.force);
      }
  }

  void
  RampedForces::save(Archive              &archive,
                     const BackgroundMesh &mesh,
                     const Space          &space) const
  {
    std::vector<double> times;
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        times.push_back(list[i].begin);
        times.push_back(list[i].duration);
        save_nodes(
          archive, "fading " + std::to_string(i), mesh, space, list[i].force);
      }
    StateRow row;
    row(times);
    archive.write_row("fading", row);
  }

  void
  RampedForces::load(const Archive        &archive,
                     const BackgroundMesh &mesh,
                     const Space          &space)
  {
    std::vector<double> times;
    archive.read_row("fading")(times);
    list.clear();
    for (unsigned int i = 0; 2 * i + 1 < times.size(); ++i)
      {
        list.push_back(
          {Vector(space.partitioner()), times[2 * i], times[2 * i + 1]});
        load_nodes(
          archive, "fading " + std::to_string(i), mesh, space, list[i].force);
      }
  }
} // namespace geocone::GEOCONE_DIM
