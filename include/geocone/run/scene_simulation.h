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
  /** Run of a scene with the loading programme of the section "Loading". */
  class SceneSimulation : public Simulation
  {
  protected:
    SceneSimulation(const MPI_Comm comm, const ParameterFile &file, Log &log);

    /** @name Functions implemented by a method. All collective. */
    /** @{ */

    /** Prepares the numerical method (e.g. its mesh) after the scene has been
     *  prepared. Called by prepare(). @return warnings */
    virtual std::vector<std::string>
    prepare_method(const RunOptions &options) = 0;

    /** @} */

    const Stage &
    stage_of(const TimePoint &now) const;

    void
    state(StateRow &row) override
    {
      row(observed_points);
    }

    /** Size of the next step of the loading programme (s). */
    double
    step_size(const TimePoint &now);

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
    bool
    wants_fields(const TimePoint &now) const override;

    std::vector<double> sizes; ///< step sizes of the current stage (s)
  };
} // namespace geocone::GEOCONE_DIM

#endif
