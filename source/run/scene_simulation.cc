// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/run/scene_simulation.h>

namespace geocone::GEOCONE_DIM
{
  SceneSimulation::SceneSimulation(const MPI_Comm       comm,
                                   const ParameterFile &file,
                                   Log                 &log)
    : Simulation(comm, log)
    , scene(file)
  {}

  std::vector<std::string>
  SceneSimulation::prepare(const RunOptions &options)
  {
    scene.geometry.may_run_script = options.may_run_scripts;
    scene.prepare();
    return prepare_method(options);
  }

  std::vector<unsigned int>
  SceneSimulation::programme() const
  {
    std::vector<unsigned int> n;
    for (const auto &stage : scene.loading.list)
      n.push_back(stage->step_sizes().size());
    return n;
  }

  const Stage &
  SceneSimulation::stage_of(const TimePoint &now) const
  {
    return *scene.loading.list[now.stage];
  }

  void
  SceneSimulation::record_start()
  {
    if (method.is_mpm())
      write_fields(0.);
  }

  double
  SceneSimulation::step_size(const TimePoint &now)
  {
    if (now.in_stage == 0 || sizes.empty()) // new stage, or resumed
      sizes = stage_of(now).step_sizes();
    return sizes[now.in_stage];
  }

  bool
  SceneSimulation::wants_fields(const TimePoint &now) const
  {
    const unsigned int every = stage_of(now).output_every;
    return every > 0 && now.in_stage % every == 0;
  }
} // namespace geocone::GEOCONE_DIM
