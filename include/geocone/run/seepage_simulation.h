// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_seepage_simulation_h
#define geocone_run_seepage_simulation_h

#include <geocone/output/field_files.h>
#include <geocone/output/table_output.h>
#include <geocone/run/simulation.h>
#include <geocone/scene/scene.h>
#include <geocone/seepage/flow_on_mesh.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Flow on one of the meshes, or at one of the times. */
  struct FlowLevel
  {
    double              time      = 0.; ///< (s)
    unsigned int        triangles = 0, iterations = 0;
    double              discharge = 0., error = 0.; ///< (m^2/s), (-)
    double              stored = 0.; ///< of a transient flow (m^2)
    std::vector<double> inflows;     ///< through each boundary (m^2/s)

    void
    state(StateRow &row)
    {
      row(time, triangles, iterations, discharge, error, stored, inflows);
    }
  };

  /** Output of a flow: seepage.csv with a line per mesh and time, the fields of the last
   *  mesh, and the summary. */
  class SeepageOutput : public TableOutput<FlowLevel>
  {
  public:
    using TableOutput::TableOutput;

    /** @param names of the boundaries @param geometry for the units */
    void
    prepare(const RunOptions               &options,
            const std::vector<std::string> &names,
            const Geometry                 &geometry,
            const bool                      is_transient);

    /** Writes pressures, heads, relative permeabilities and velocities. */
    void
    write_fields(const FlowOnMesh &flow,
                 const double      unit_weight,
                 const double      time);

    void
    state_of_run(StateRow &row) override;

  private:
    void
    report_results(std::ostream &out) const override;

    std::unique_ptr<FieldFiles> fields;
  };

  /** Flow of water through a scene, without its mechanics. */
  class SeepageSimulation : public Simulation
  {
  public:
    SeepageSimulation(const MPI_Comm comm, const ParameterFile &file, Log &log);

    OutputBase &
    output() override
    {
      return seepage_output;
    }

  private:
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override
    {
      return {static_cast<unsigned int>(steps.size())};
    }
    bool
    wants_fields(const Place &) const override
    {
      return true;
    }
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override
    {
      return name + ": flow of water";
    }
    Json
    model() override;
    void
    begin(const Place &) override
    {}
    Ended
    advance(Place &place) override;
    void
    record(const Place &) override
    {}
    std::string
    progress(const Place &) const override
    {
      return "";
    }
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    finish(const double t) override;

    /** Record of the present flow. */
    FlowLevel
    record_of(const double time) const;

    /** Solves the next of the flows. @return its records */
    std::vector<FlowLevel>
    solve_next();

    Scene                      scene;
    SeepageOutput              seepage_output;
    std::optional<FlowOnMesh>  flow;
    std::vector<Seepage::Step> steps;   ///< flows to be solved
    std::vector<Water::Flow>   results; ///< of those solved so far
  };
} // namespace geocone::GEOCONE_DIM

#endif
