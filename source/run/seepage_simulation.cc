// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/output/model_of_tetrahedra.h>
#include <geocone/output/model_of_triangles.h>
#include <geocone/output/simplex_table.h>
#include <geocone/run/seepage_simulation.h>

#include <deal.II/base/mpi.h>

#include <utility>

namespace geocone::GEOCONE_DIM
{
  void
  SeepageOutput::prepare(const RunOptions               &options,
                         const std::vector<std::string> &names,
                         const Geometry                 &geometry,
                         const bool                      is_transient,
                         const bool                      is_unsaturated)
  {
    const std::string unit = geometry.unit("m^3/s/m");
    begin(options, "seepage");
    table.add("time (s)", &FlowLevel::time);
    table.add(dim == 2 ? "triangles (-)" : "tetrahedra (-)", &FlowLevel::cells);
    table.add("discharge (" + unit + ")", &FlowLevel::discharge);
    for (unsigned int b = 0; b < names.size(); ++b)
      table.add("inflow of " + names[b] + " (" + unit + ")",
                [b](const FlowLevel &l) { return l.inflows[b]; });
    if (is_transient)
      table.add("stored (" + geometry.unit("m^3/m") + ")", &FlowLevel::stored);
    table.add("iterations (-)", &FlowLevel::iterations);
    table.add("natural-map error (-)", &FlowLevel::error);
    if (is_transient && is_unsaturated)
      {
        table.add("time steps (-)", &FlowLevel::steps);
        table.add("imbalance (-)", &FlowLevel::imbalance);
      }
    open_table("seepage.csv");
  }

  void
  SeepageOutput::write_fields(const FlowOnMesh &flow,
                              const double      unit_weight,
                              const double      time)
  {
    if (!with_fields)
      return;
    // All ranks have the whole flow.
    SimplexTable table(flow.current_mesh(),
                       dealii::Utilities::MPI::this_mpi_process(comm) == 0);
    const auto  &vertices  = flow.current_mesh().vertices;
    const auto   q         = flow.velocities_at_corners();
    using Index            = unsigned int;
    table.add("pore_pressure", 1, [&](const Index, const Index v, const Index) {
      return unit_weight * flow.flow().head[v];
    });
    table.add("head", 1, [&](const Index, const Index v, const Index) {
      return flow.flow().head[v] + vertices[v][1];
    });
    const auto state = [&](const Index p, const Index v) {
      return flow.curve(p / FlowMesh::n_corners).at(flow.flow().head[v]);
    };
    table.add("relative_permeability",
              1,
              [&](const Index p, const Index v, const Index) {
                return flow.is_unsaturated() ? state(p, v).permeability
                                             : flow.flow().saturation[v];
              });
    if (flow.is_unsaturated())
      {
        table.add(
          "water_content", 1, [&](const Index p, const Index v, const Index) {
            return state(p, v).content;
          });
        table.add("effective_saturation",
                  1,
                  [&](const Index p, const Index v, const Index) {
                    return state(p, v).effective_saturation;
                  });
      }
    table.add(
      "seepage_velocity", dim, [&](const Index p, const Index, const Index d) {
        return q[p][d];
      });
    table.add_materials();
    MeshOutput::write_fields(time, table);
  }

  void
  SeepageOutput::report_results(std::ostream &out) const
  {
    out << format("%.4g\n", summary["seepage"]["discharge"].get<double>());
  }

  SeepageSimulation::SeepageSimulation(const MPI_Comm       comm,
                                       const ParameterFile &file,
                                       Log                 &log)
    : Simulation(comm, log)
    , scene(file)
    , seepage_output(comm, log)
  {}

  std::vector<std::string>
  SeepageSimulation::prepare(const RunOptions &options)
  {
    scene.geometry.may_run_script = options.may_run_scripts;
    scene.geometry.prepare();
    scene.materials.prepare();
    scene.regions.prepare(scene.geometry);
    if (!scene.water.seepage.acts())
      throw InputError("Seepage/Names",
                       "",
                       "at least one name with 'Analysis/Kind' = seepage",
                       "e.g. upstream, downstream, each with its subsection");
    scene.structures.refuse("'Analysis/Kind' = seepage",
                            "leave it out: they do not change the flow");
    scene.water.prepare_pressures(scene.geometry);
    scene.loading.prepare(scene.materials.names(), scene.tractions.names());
    scene.water.prepare_stages(scene.loading);
    if (dim == 3)
      {
        if (method.is_mpm())
          throw InputError("Discretisation/Method",
                           method.name(),
                           "FEM where water flows in three dimensions",
                           "the mesh of the flow fits the body");
        mesh_parameters.prepare(scene.geometry, method);
      }
    flow.emplace(scene, comm, &mesh_parameters);
    steps = scene.water.flow_steps();
    // A free surface is refused before the run begins.
    if (scene.water.seepage.degree > 1)
      {
        FlowOnMesh coarse(scene, comm, &mesh_parameters);
        for (const Seepage::Step &step : steps)
          coarse.solve_on_first_mesh(step);
      }
    return {};
  }

  void
  SeepageSimulation::prepare_output(const RunOptions &options)
  {
    seepage_output.prepare(options,
                           scene.water.seepage.names(),
                           scene.geometry,
                           scene.water.flows_in_time(),
                           flow->is_unsaturated());
  }

  Json
  SeepageSimulation::model()
  {
    return model_of(scene, model_mesh_of(flow->current_mesh()));
  }

  FlowLevel
  SeepageSimulation::record_of(const double time) const
  {
    FlowLevel record;
    record.time       = time;
    record.cells      = flow->current_mesh().cells.size();
    record.iterations = flow->flow().iterations;
    record.discharge  = flow->discharge();
    record.error      = flow->flow().error;
    record.inflows    = flow->inflows();
    if (scene.water.flows_in_time())
      record.stored = flow->stored();
    record.steps     = flow->n_steps();
    record.imbalance = flow->imbalance();
    return record;
  }

  std::vector<FlowLevel>
  SeepageSimulation::solve_next()
  {
    const Seepage::Step   &step = steps[results.size()];
    std::vector<FlowLevel> records;
    flow->solve(step, [&]() { records.push_back(record_of(step.time)); });
    results.push_back(flow->result());
    return records;
  }

  Simulation::StepOutcome
  SeepageSimulation::advance(TimePoint &now)
  {
    // A resumed run solves the earlier flows again: they take less time than steps of
    // other methods, and are not stored.
    while (results.size() < now.in_stage)
      solve_next();
    for (const FlowLevel &record : solve_next())
      seepage_output.add_record(record);
    now.time = steps[now.in_stage].time;
    return results.size() == steps.size() ? StepOutcome::stage
                                          : StepOutcome::well;
  }

  void
  SeepageSimulation::write_fields(const double t)
  {
    if (flow->is_solved())
      seepage_output.write_fields(*flow, scene.water.weight(), t);
  }

  Json
  SeepageSimulation::topics()
  {
    Json json;
    json["size"] = {{"method", "seepage"},
                    {"cells", flow->current_mesh().cells.size()}};
    // null before there is a flow, and where none was found
    const auto known = [&](const Json &value) {
      return flow->is_solved() ? value : Json();
    };
    Json       inflows;
    const auto values = flow->inflows();
    for (unsigned int b = 0; b < values.size(); ++b)
      inflows[scene.water.seepage.names()[b]] = known(values[b]);
    const auto change = flow->change();
    json["seepage"]   = {{"discharge", known(flow->discharge())},
                         {"unit", scene.geometry.unit("m^3/s/m")},
                         {"inflows", inflows},
                         {"change", change ? known(*change) : Json()},
                         {"imbalance", known(flow->imbalance())},
                         {"iterations", known(flow->flow().iterations)},
                         {"natural_map_error", known(flow->flow().error)}};
    if (scene.water.flows_in_time())
      {
        json["seepage"]["stored"]      = known(flow->stored());
        json["seepage"]["stored_unit"] = scene.geometry.unit("m^3/m");
      }
    json["cost"] = times();
    return json;
  }

  void
  SeepageSimulation::finish(const double)
  {
    scene.water.set_flows(results);
    seepage_output.write_model(model());
    if (scene.water.flows_in_time())
      log.print(format("%.5g ", flow->stored()) + scene.geometry.unit("m^3/m") +
                (flow->is_unsaturated() ? " of water in the pores"
                                        : " of drainable water left"));
    else
      log.print("discharge " + flow->text());
    for (const std::string &warning : flow->warnings())
      log.warn(warning);
  }
} // namespace geocone::GEOCONE_DIM
