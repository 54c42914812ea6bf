// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/limit_analysis/solid_limit_analysis.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/scene/magnitudes.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_solid_bounds[] = {
      {"Analysis/Load factor of", "Analysis/Kind", {"limit load"}},
      {"Analysis/Gap tolerance", "Analysis/Kind", {"limit load"}},
      {"Analysis/Growth of meshes", "Analysis/Kind", {"limit load"}},
      {"Analysis/Maximum cells", "Analysis/Kind", {"limit load"}},
      {"Analysis/Maximum levels", "Analysis/Kind", {"limit load"}},
      {"Analysis/Solver tolerance", "Analysis/Kind", {"limit load"}},
      {"Analysis/Velocities", "Analysis/Kind", {"limit load"}},
      {"Analysis/Stresses", "Analysis/Kind", {"limit load"}}};
  } // namespace

  SolidLimitAnalysis::SolidLimitAnalysis(const MPI_Comm       comm,
                                         const ParameterFile &file,
                                         Log                 &log)
    : Simulation(comm, log)
    , dealii::ParameterAcceptor("/Analysis")
    , scene(file)
    , limit_output(comm, log)
  {
    kind.declare(*this,
                 "Kind",
                 ". Steps: time steps with the method of 'Discretisation'. "
                 "Limit load: strict upper and lower bounds of the limit load "
                 "of a rigid-plastic body with associated flow, on tetrahedra, "
                 "independent of steps, elasticity and inertia.");
    load.declare(*this);
    add_parameter("Gap tolerance",
                  gap_tolerance,
                  "Relative gap upper/lower - 1 of the bounds [-] below which "
                  "refinement ends.");
    add_parameter(
      "Growth of meshes",
      growth,
      "Ratio of the number of tetrahedra of a mesh to that of the "
      "previous mesh [-], approximately: all cells become smaller.");
    add_parameter("Maximum cells",
                  most_cells,
                  "Maximum number of tetrahedra of a mesh; refinement ends "
                  "before it is exceeded.");
    add_parameter(
      "Maximum levels",
      most_levels,
      "Maximum number of meshes; 1: only the mesh of the section 'Mesh'.");
    add_parameter(
      "Solver tolerance",
      tolerance,
      "Tolerance of the interior-point method [-]: distance to the optimum of "
      "the mesh, relative to the load; also at most a tenth of the gap "
      "tolerance.");
    velocities.declare(
      *this,
      "Velocities",
      ": polynomials of the upper bound in a tetrahedron; they jump at all "
      "faces. Quadratic ones give the better bound for a given time.");
    stresses.declare(
      *this,
      "Stresses",
      ": polynomials of the lower bound in a tetrahedron, discontinuous at all "
      "faces. Quadratic ones are better where there is friction.");
  }

  void
  SolidLimitAnalysis::check_parameters() const
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError("Analysis/Kind",
                       kind.word(),
                       "steps on several ranks",
                       "call it without mpirun: both bounds are computed by "
                       "one process");
    if (!(gap_tolerance > 0. && gap_tolerance < 10.))
      throw InputError(
        "Analysis/Gap tolerance", gap_tolerance, "> 0, < 10", "0.1 is usual");
    if (!(growth >= 1.1 && growth <= 30.))
      throw InputError(
        "Analysis/Growth of meshes", growth, "1.1 to 30", "4 is usual");
    if (most_levels == 0)
      throw InputError(
        "Analysis/Maximum levels", most_levels, ">= 1", "3 is usual");
    if (most_cells < 5 || most_cells > 1000000)
      throw InputError("Analysis/Maximum cells",
                       most_cells,
                       "5 to 1000000",
                       "6000 take some minutes");
    if (!(tolerance >= 1e-8 && tolerance <= 1e-2))
      throw InputError("Analysis/Solver tolerance",
                       tolerance,
                       "1e-8 to 1e-2",
                       "1e-3 is usual");
    if (method.is_mpm())
      throw InputError("Discretisation/Method",
                       "MPM",
                       "FEM with 'Analysis/Kind' = limit load",
                       "sums over particles are no exact integrals, which a "
                       "strict bound needs: set Discretisation/Method = FEM");
  }

  void
  SolidLimitAnalysis::prepare_scene(const RunOptions &options)
  {
    const std::string where       = "'Analysis/Kind' = limit load";
    scene.geometry.may_run_script = options.may_run_scripts;
    scene.geometry.prepare();
    scene.materials.prepare();
    scene.materials.refuse_undrained(
      where,
      "bounds know no stress before the load, on which undrained strength "
      "depends: take Tresca with that strength, or steps");
    scene.regions.prepare(scene.geometry);
    scene.prepare_weight();
    if (scene.water.acts())
      throw InputError("Water/Table",
                       "water",
                       "none with " + where + " in three dimensions",
                       "bounds with water are those of plane scenes");
    scene.dirichlet.prepare();
    scene.tractions.prepare();
    scene.absorbing.refuse(where, "nothing moves fast here: leave it out");
    scene.obstacles.prepare();
    scene.obstacles.refuse(where + " in three dimensions",
                           "hold a part of the boundary instead");
    scene.contacts.refuse(where, "mesh the bodies as one");
    scene.structures.refuse(where,
                            "load the body in time steps instead, with "
                            "'Analysis/Kind' = steps");
    scene.observation.prepare(
      scene.supports(), scene.materials, scene.gravity, false);
    for (const auto &condition : scene.dirichlet.list)
      if (condition->moves())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposition.word(),
                         "nodes with " + where,
                         "impose it on nodes: the mesh fits the body");
  }

  std::vector<std::string>
  SolidLimitAnalysis::prepare(const RunOptions &options)
  {
    check_parameters();
    prepare_scene(options);
    mesh_parameters.prepare(scene.geometry, method);
    tetrahedra.emplace(fitted_mesh(mesh_parameters, scene, comm));
    if (tetrahedra->cells.size() > most_cells)
      throw InputError("Analysis/Maximum cells",
                       most_cells,
                       format(">= %zu, the tetrahedra of the first mesh",
                              tetrahedra->cells.size()),
                       "raise it, or take larger cells in 'Mesh'");
    load.prepare(scene, *tetrahedra);
    if (options.dry_run)
      log.print(headline(options.name) +
                format(": the first mesh has %zu tetrahedra, the last one %u "
                       "at most",
                       tetrahedra->cells.size(),
                       most_cells));
    const dealii::BoundingBox<dim> body(tetrahedra->vertices);
    log.print(options.name + ": " + text_of_magnitudes(scene, body));
    std::vector<std::string> warnings = warn_of_magnitudes(scene, body);
    if (scene.geometry.shape == Geometry::Shape::file && most_levels > 1)
      warnings.push_back("a mesh from a file is not made anew: the bounds are "
                         "those of this mesh; give a box, or set "
                         "Analysis/Maximum levels = 1");
    return warnings;
  }

  std::vector<unsigned int>
  SolidLimitAnalysis::programme() const
  {
    return {scene.geometry.shape == Geometry::Shape::file ? 1 : most_levels};
  }

  void
  SolidLimitAnalysis::prepare_output(const RunOptions &options)
  {
    limit_output.prepare(options,
                         load.is_reaction() ? "N" : "-",
                         load.is_reaction() ? scene.observation.reference
                                            : std::nullopt);
  }

  std::string
  SolidLimitAnalysis::headline(const std::string &name) const
  {
    return name + ": bounds of the limit load, " +
           (load.is_reaction() ? "the reaction to the prescribed velocity"
                               : "a factor of the " + load.word());
  }

  Simulation::StepOutcome
  SolidLimitAnalysis::advance(TimePoint &now)
  {
    dealii::Timer mesh_time;
    if (const double factor = refinement / refined; factor != 1.)
      {
        for (double *const size : {&mesh_parameters.cell_size,
                                   &mesh_parameters.smallest,
                                   &mesh_parameters.largest,
                                   &mesh_parameters.size_ratio})
          *size *= factor;
        refined = refinement;
        tetrahedra.emplace(fitted_mesh(mesh_parameters, scene, comm));
      }
    BoundLevel level;
    level.mesh_seconds = mesh_time.cpu_time();
    dealii::Timer    time;
    const SolidScene bound = load.on(scene, *tetrahedra);
    const double     inner = std::min(tolerance, gap_tolerance / 10.),
                 unit      = load.value_of_unit();
    const auto order       = [](const Order one) {
      return one == Order::linear ? 1U : 2U;
    };
    upper = certified_upper(bound, order(velocities), inner);
    lower = certified_lower(bound, order(stresses), inner);
    for (const auto *side : {&upper, &lower})
      {
        const std::string name = side == &upper ? "upper" : "lower";
        if (side->grows && !side->certified)
          throw StepFailure(
            "the load is not bounded on this mesh: " + side->reason +
            "\n  remedy:  no mechanism fits the domain; enlarge it, refine "
            "the mesh, or check the supports");
        if (!side->converged)
          log.print("  the " + name + " bound may be sharper: " + side->reason);
        if (!side->certified)
          log.print("  the " + name +
                    " bound is not certified: " + side->rejection);
      }
    level.cells            = tetrahedra->cells.size();
    level.upper            = unit * upper.load;
    level.lower            = unit * lower.load;
    level.gap              = (upper.load - lower.load) / std::abs(lower.load);
    level.upper_certified  = upper.certified;
    level.lower_certified  = lower.certified;
    level.iterations_upper = upper.factorisations;
    level.iterations_lower = lower.factorisations;
    level.unknowns_upper   = upper.n_unknowns;
    level.unknowns_lower   = lower.n_unknowns;
    level.violation_upper  = upper.violation;
    level.violation_lower  = lower.violation;
    level.error_upper      = upper.error;
    level.error_lower      = lower.error;
    level.cpu_seconds      = time.cpu_time();
    if (!std::isfinite(level.upper + level.lower + level.gap))
      throw StepFailure("the bounds of the limit load are not finite\n  "
                        "remedy:  check the supports, the strengths and the "
                        "loads, or take other cells");
    const auto &levels = limit_output.all_records();
    level.number       = levels.size() + 1;
    limit_output.add_record(level);
    now.time = levels.size();
    refinement /= std::cbrt(growth);

    const auto best = best_of(levels).gap();
    return (best && *best < gap_tolerance) ||
               growth * level.cells > 1.15 * most_cells ||
               levels.size() == programme()[0]
             ? StepOutcome::stage
             : StepOutcome::well;
  }

  void
  SolidLimitAnalysis::record(const TimePoint &)
  {
    if (limit_output.verbosity < 1)
      return;
    const BoundLevel &level = limit_output.all_records().back();
    const auto        shown = [](const double value, const bool certified) {
      return certified ? format("%.6g", value) : std::string("?");
    };
    log.print(
      format("level %u: %u tetrahedra: ", level.number, level.cells) +
      shown(level.lower, level.lower_certified) +
      " <= load <= " + shown(level.upper, level.upper_certified) +
      (load.is_reaction() ? " N" : "") +
      (level.certified() ? format(", gap %.3g %%", 100. * level.gap) : "") +
      format(", %u + %u factorisations, %.2g s",
             level.iterations_lower,
             level.iterations_upper,
             level.cpu_seconds));
  }

  LoadBracket
  SolidLimitAnalysis::bracket() const
  {
    LoadBracket best   = best_of(limit_output.all_records());
    best.unit          = load.is_reaction() ? "N" : "";
    best.is_associated = !load.non_associated();
    return best;
  }

  Json
  SolidLimitAnalysis::topics()
  {
    const auto &levels = limit_output.all_records();
    Json        json;
    json["size"] = {{"method", kind.word()},
                    {"cells", levels.empty() ? 0 : levels.back().cells}};
    json["load"] = {{"factor_of", load.word()},
                    {"unit", load.is_reaction() ? "N" : "-"}};
    json["cost"] = {{"total_s", total.wall_time()},
                    {"cpu_s", total.cpu_time()}};
    if (!levels.empty())
      {
        json["bounds"] = limit_output.bounds(bracket());
        json["bounds"].erase("sum_of_cells_to_gap");
      }
    return json;
  }

  void
  SolidLimitAnalysis::finish(const double)
  {
    const LoadBracket best = bracket();
    const auto        gap  = best.gap();
    if (!gap)
      log.warn(std::string("not certified: ") +
               (best.lower ? "the upper bound: " + upper.rejection
                           : "the lower bound: " + lower.rejection));
    else if (!(*gap < gap_tolerance))
      log.warn(format("the gap is %.3g %%, more than 'Analysis/Gap tolerance'; "
                      "raise 'Analysis/Maximum cells' or 'Maximum levels'",
                      100. * *gap));
    if (best.lower || best.upper)
      log.print(best.text());
  }

  void
  SolidLimitAnalysis::state(StateRow &row)
  {
    row(refinement);
  }
} // namespace geocone::GEOCONE_DIM
