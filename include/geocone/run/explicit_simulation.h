// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_explicit_simulation_h
#define geocone_run_explicit_simulation_h

#include <geocone/explicit/explicit_mpm.h>
#include <geocone/output/explicit_output.h>
#include <geocone/run/scene_simulation.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Run that simulates a scene by the explicit material point method. Each
   *  step of the loading programme is one line of statistics.csv, and is
   *  subdivided into many explicit steps. */
  class ExplicitSimulation : public SceneSimulation
  {
  public:
    ExplicitSimulation(const MPI_Comm       comm,
                       const ParameterFile &file,
                       Log                 &log);

    OutputBase &
    output() override
    {
      return explicit_output;
    }

  private:
    std::vector<std::string>
    prepare_method(const RunOptions &options) override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
    Json
    model() override;
    void
    begin(const TimePoint &now) override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &now) override;
    std::string
    progress(const TimePoint &now) const override;
    void
    end(const TimePoint &now) override;
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    save(Archive &archive) override;
    void
    load(const Archive &archive) override;

    Json
    cost() const;

    ExplicitMPM    stepper;
    ExplicitOutput explicit_output;

    ExplicitState  state;  ///< state at the last record
    ExplicitReport report; ///< statistics of the last step
  };
} // namespace geocone::GEOCONE_DIM

#endif
