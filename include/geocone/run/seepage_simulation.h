// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_seepage_simulation_h
#define geocone_run_seepage_simulation_h

#include <geocone/mesh/mesh_parameters.h>
#include <geocone/mesh/method.h>
#include <geocone/output/mesh_output.h>
#include <geocone/run/simulation.h>
#include <geocone/scene/scene.h>
#include <geocone/seepage/flow_on_mesh.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Results of the seepage flow on one mesh or at one time. */
  struct FlowLevel
  {
    double              time      = 0.; ///< (s)
    unsigned int        cells = 0, iterations = 0;
    double              discharge = 0., error = 0.; ///< (m^2/s), (-)
    double              stored = 0.; ///< stored water, transient flow (m^2)
    std::vector<double> inflows;     ///< inflow at each boundary (m^2/s)
    unsigned int        steps     = 0;  ///< time steps of unsaturated flow
    double              imbalance = 0.; ///< error of their water balance (-)

    void
    state(StateRow &row)
    {
      row(time,
          cells,
          iterations,
          discharge,
          error,
          stored,
          inflows,
          steps,
          imbalance);
    }
  };

  /** Output of a seepage run. It contains seepage.csv with a line per mesh and time,
   *  the fields on the finest mesh, and the summary. */
  class SeepageOutput : public MeshOutput<FlowLevel>
  {
  public:
    using MeshOutput::MeshOutput;

    /** Creates the output folder and the columns of seepage.csv.
     *  @param names names of the boundaries @param geometry determines the units */
    void
    prepare(const RunOptions               &options,
            const std::vector<std::string> &names,
            const Geometry                 &geometry,
            const bool                      is_transient,
            const bool                      is_unsaturated);

    /** Writes the fields of pore pressure, hydraulic head, relative permeability and
     *  velocity. */
    void
    write_fields(const FlowOnMesh &flow,
                 const double      unit_weight,
                 const double      time);

  private:
    void
    report_results(std::ostream &out) const override;
  };

  /** Run that computes the seepage flow in a scene, without stresses and
   *  displacements. */
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
    wants_fields(const TimePoint &) const override
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
    begin(const TimePoint &) override
    {}
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &) override
    {}
    std::string
    progress(const TimePoint &) const override
    {
      return "";
    }
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    finish(const double t) override;

    /** Returns the results of the current flow for a given time. */
    FlowLevel
    record_of(const double time) const;

    /** Solves the next flow problem on all meshes. @return one record per mesh */
    std::vector<FlowLevel>
    solve_next();

    Scene                      scene;
    Method                     method;
    MeshParameters             mesh_parameters; ///< three dimensions
    SeepageOutput              seepage_output;
    std::optional<FlowOnMesh>  flow;
    std::vector<Seepage::Step> steps;   ///< flows to be solved
    std::vector<Water::Flow>   results; ///< results of the solved flows
  };
} // namespace geocone::GEOCONE_DIM

#endif
