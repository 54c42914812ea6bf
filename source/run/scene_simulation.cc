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
    for (const auto &stage : scene.loading.stages)
      n.push_back(stage->step_sizes().size());
    return n;
  }

  const Stage &
  SceneSimulation::stage_of(const Place &place) const
  {
    return *scene.loading.stages[place.stage];
  }

  void
  SceneSimulation::record_start()
  {
    if (has_fields_at_start())
      write_fields(0.);
  }

  void
  SceneSimulation::begin(const Place &place)
  {
    begin_stage(stage_of(place), place.time);
  }

  Simulation::Ended
  SceneSimulation::advance(Place &place)
  {
    if (place.in_stage == 0 || sizes.empty()) // of this stage, or resumed
      sizes = stage_of(place).step_sizes();
    const double h     = sizes[place.in_stage];
    const Ended  ended = advance_step(stage_of(place), place, h);
    if (ended != Ended::run)
      place.time += h;
    return ended;
  }

  void
  SceneSimulation::record(const Place &place)
  {
    record_step(stage_of(place), place);
  }

  std::string
  SceneSimulation::progress(const Place &place) const
  {
    return format("t = %.4g s  ", place.time) + progress_of_step();
  }

  void
  SceneSimulation::end(const Place &place)
  {
    end_stage(stage_of(place));
  }

  bool
  SceneSimulation::wants_fields(const Place &place) const
  {
    const unsigned int every = stage_of(place).output_every;
    return every > 0 && place.in_stage % every == 0;
  }
} // namespace geocone::GEOCONE_DIM
