// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_scene_simulation_h
#define geocone_run_scene_simulation_h

#include <geocone/base/parameter_file.h>
#include <geocone/mesh/method.h>
#include <geocone/points/observed_points.h>
#include <geocone/run/simulation.h>
#include <geocone/scene/scene.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A run of a scene: its programme is that of the section "Loading". */
  class SceneSimulation : public Simulation
  {
  protected:
    SceneSimulation(const MPI_Comm comm, const ParameterFile &file, Log &log);

    /** @name What a method does. All collective. */
    /** @{ */

    /** As prepare(), where scene and method are prepared. */
    virtual std::vector<std::string>
    prepare_method(const RunOptions &options) = 0;

    virtual void
    begin_stage(const Stage &stage, const double t) = 0;

    /** A step from place.time to h later, or what is left of it. */
    virtual Ended
    advance_step(const Stage &stage, const Place &place, const double h) = 0;

    virtual void
    record_step(const Stage &stage, const Place &place) = 0;

    virtual std::string
    progress_of_step() const = 0;

    /** Tests after the last step of a stage. */
    virtual void
    end_stage(const Stage &)
    {}

    /** Whether fields are written before the first step. */
    virtual bool
    has_fields_at_start() const = 0;
    /** @} */

    Scene          scene;
    Method         method;
    ObservedPoints observed_points;

  private:
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override;
    void
    record_start() override;
    void
    begin(const Place &place) override;
    Ended
    advance(Place &place) override;
    void
    record(const Place &place) override;
    std::string
    progress(const Place &place) const override;
    void
    end(const Place &place) override;
    bool
    wants_fields(const Place &place) const override;

    const Stage &
    stage_of(const Place &place) const;

    std::vector<double> sizes; ///< of the steps of the present stage (s)
  };
} // namespace geocone::GEOCONE_DIM

#endif
