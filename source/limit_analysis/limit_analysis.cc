// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/limit_analysis/bound_fields.h>
#include <geocone/limit_analysis/limit_analysis.h>
#include <geocone/mesh/adapted_sizes.h>
#include <geocone/output/model_of_triangles.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/seepage/flow_on_mesh.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_limit_analysis[] = {
      {"Analysis/Load factor of", "Analysis/Kind", {"limit load"}},
      {"Analysis/Gap tolerance",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Growth of meshes",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Maximum cells",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Maximum levels",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Solver tolerance",
       "Analysis/Kind",
       {"limit load", "strength reduction"}}};
  } // namespace

  namespace
  {
    /** @param unit the load that a problem's 1 corresponds to */
    BoundLevel
    level_of(const CertifiedBounds &bounds,
             const unsigned int     n_cells,
             const double           unit)
    {
      const auto &[upper, lower, gap, uneven, gap_share] = bounds;
      (void)uneven;
      BoundLevel level;
      level.cells = n_cells;
      level.upper = unit * upper.bound.load;
      level.lower = unit * lower.bound.load;
      level.gap =
        (upper.bound.load - lower.bound.load) / std::abs(lower.bound.load);
      level.upper_certified  = upper.bound.certified;
      level.lower_certified  = lower.bound.certified;
      level.iterations_upper = upper.solution.factorisations;
      level.iterations_lower = lower.solution.factorisations;
      level.unknowns_upper   = upper.n_unknowns;
      level.unknowns_lower   = lower.n_unknowns;
      level.violation_upper  = upper.bound.violation;
      level.violation_lower  = lower.bound.violation;
      level.error_upper      = upper.bound.error;
      level.error_lower      = lower.bound.error;
      level.gap_share        = gap_share;
      return level;
    }
  } // namespace

  LimitAnalysis::LimitAnalysis(const MPI_Comm       comm,
                               const ParameterFile &file,
                               Log                 &log)
    : Simulation(comm, log)
    , dealii::ParameterAcceptor("/Analysis")
    , scene(file)
    , limit_output(comm, log)
  {
    analysis.declare(
      *this,
      "Kind",
      ". Steps: time steps with the method of 'Discretisation'. Limit load: "
      "strict upper and lower bounds of the limit load of a rigid-plastic body "
      "with associated flow, on adaptively refined triangular meshes, "
      "independent of steps, elasticity and inertia. Strength reduction: "
      "strict bounds of the factor of safety, by which c and tan(phi) are "
      "divided at collapse.");
    bounded_load.declare(*this);
    add_parameter("Gap tolerance",
                  gap_tolerance,
                  "Relative gap upper/lower - 1 of the bounds [-] below which "
                  "refinement ends.");
    add_parameter("Growth of meshes",
                  growth,
                  "Ratio of the number of triangles of a mesh to that of the "
                  "previous mesh [-].");
    add_parameter("Maximum cells",
                  most_cells,
                  "Maximum number of triangles of a mesh; refinement ends "
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
      "tolerance. Smaller values localise the mechanism in fewer cells, which "
      "impairs adaptive refinement.");
  }

  void
  LimitAnalysis::check_parameters() const
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError(
        "Analysis/Kind",
        analysis.word(),
        "steps on several ranks",
        "call it without mpirun: both bounds are computed by one "
        "process");
    const std::string section = "Analysis/";
    if (!(gap_tolerance > 0. && gap_tolerance < 10.))
      throw InputError(
        section + "Gap tolerance", gap_tolerance, "> 0, < 10", "0.01 is usual");
    if (!(growth >= 1.1 && growth <= 8.))
      throw InputError(
        section + "Growth of meshes", growth, "1.1 to 8", "2 is usual");
    if (most_levels == 0)
      throw InputError(
        section + "Maximum levels", most_levels, ">= 1", "12 is usual");
    if (most_cells < 10 || most_cells > 1000000)
      throw InputError(section + "Maximum cells",
                       most_cells,
                       "10 to 1000000",
                       "20000 take about 20 s");
    if (!(tolerance >= 1e-8 && tolerance <= 1e-2))
      throw InputError(section + "Solver tolerance",
                       tolerance,
                       "1e-8 to 1e-2",
                       "1e-3 is usual");
    if (method.is_mpm())
      throw InputError(
        "Discretisation/Method",
        "MPM",
        "FEM with 'Analysis/Kind' = " + analysis.word(),
        "sums over particles are no exact integrals, which a "
        "strict bound needs: set Discretisation/Method = FEM, or "
        "reduce the strength by stages with 'Strength factor' "
        "and 'Until failure'");
  }

  void
  LimitAnalysis::prepare_scene(const RunOptions &options)
  {
    scene.geometry.may_run_script = options.may_run_scripts;
    scene.geometry.prepare();
    scene.geometry.refuse_axis("'Analysis/Kind' = " + analysis.word(),
                               "strict bounds are those of plane strain; take "
                               "an incremental run");
    scene.materials.prepare();
    scene.materials.refuse_undrained(
      "'Analysis/Kind' = " + analysis.word(),
      "bounds know no stress before the load, on which undrained strength "
      "depends: take Tresca with that strength, or steps");
    scene.regions.prepare(scene.geometry);
    scene.prepare_weight();
    if (const Seepage &seepage = scene.water.seepage; seepage.acts())
      {
        scene.loading.prepare(scene.materials.names(), scene.tractions.names());
        scene.water.prepare_stages(scene.loading);
        if (!(seepage.time >= 0. && seepage.time <= scene.loading.duration()))
          throw InputError("Seepage/Time",
                           seepage.time,
                           format("0 to %g s, the duration of 'Loading'",
                                  scene.loading.duration()),
                           "0: the initial pressures");
        let_water_flow(scene, comm, log, options.dry_run, seepage.time);
      }
    scene.prepare_conditions();
    scene.dirichlet.refuse_stages("'Analysis/Kind' = " + analysis.word(),
                                  "bounds have no stages: list the conditions "
                                  "of one of them in 'Boundary "
                                  "conditions/Names'");
    scene.absorbing.refuse("'Analysis/Kind' = " + analysis.word(),
                           "nothing moves fast here: leave it out");
    scene.obstacles.prepare();
    scene.contacts.refuse("'Analysis/Kind' = " + analysis.word(),
                          "let one of the bodies be an obstacle");
    scene.structures.refuse("'Analysis/Kind' = " + analysis.word(),
                            "load the body in time steps instead, with "
                            "'Analysis/Kind' = steps");
    scene.observation.prepare(
      scene.supports(), scene.materials, scene.gravity, false);
    for (const auto &condition : scene.dirichlet.list)
      if (condition->moves())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposition.word(),
                         "nodes with 'Analysis/Kind' = limit load",
                         "impose it on nodes: the mesh fits the body");
  }

  std::vector<std::string>
  LimitAnalysis::warnings_of(const dealii::BoundingBox<dim> &body) const
  {
    std::vector<std::string> warnings = warn_of_magnitudes(scene, body);
    if (!refines() && most_levels > 1)
      warnings.push_back(
        "the mesh from the file is not refined: " + file_domain->obstacle() +
        "; the bounds are those of this mesh. Give a mesh of one body, or set "
        "Analysis/Maximum levels = 1");
    constexpr double later     = 1e6; // after any ramp
    const auto       is_loaded = [](const RigidMotion &load) {
      return load.centre.norm() + load.rotation.norm() > 0.;
    };
    for (const auto &obstacle : scene.obstacles.list)
      if (!is_loaded(obstacle->load(0.)) && is_loaded(obstacle->load(later)))
        warnings.push_back("the load of the obstacle '" + obstacle->name +
                           "' is zero at t = 0, which is when bounds take it: "
                           "give its full value there");
    return warnings;
  }

  std::vector<std::string>
  LimitAnalysis::prepare(const RunOptions &options)
  {
    check_parameters();
    prepare_scene(options);
    mesh_parameters.prepare(scene.geometry, method);
    if (mesh_parameters.cells == MeshParameters::Cells::quadrilaterals &&
        scene.geometry.shape != Geometry::Shape::file)
      throw InputError("Mesh/Cells",
                       "quadrilaterals",
                       "triangles with 'Analysis/Kind' = limit load",
                       "set Mesh/Cells = triangles");
    triangles.emplace(fitted_mesh(mesh_parameters, scene, comm));
    if (scene.geometry.shape == Geometry::Shape::file)
      file_domain.emplace(domain_of_file(*triangles, scene));
    if (scene.water.acts() && !scene.water.varies_in_cells())
      check_water();
    if (reduces_strength())
      bounded_load.prepare_reduction(scene, *triangles);
    else
      bounded_load.prepare(scene, *triangles);
    if (options.dry_run)
      log.print(headline(options.name) +
                format(": the first mesh has %zu triangles, the last one %u at "
                       "most; about %.0f MB",
                       triangles->cells.size(),
                       most_cells,
                       100. + 0.02 * most_cells));
    const dealii::BoundingBox<dim> body(triangles->vertices);
    log.print(options.name + ": " + text_of_magnitudes(scene, body));
    return warnings_of(body);
  }

  CoarseMesh
  LimitAnalysis::next_mesh() const
  {
    if (!file_domain)
      return fitted_mesh(mesh_parameters, scene, comm, &*sizes);
    const dealii::BoundingBox<dim> body(triangles->vertices);
    const auto [low, high] = body.get_boundary_points();
    return file_domain->mesh(
      *sizes, scene.water.lines(low, high), mesh_parameters.algorithm, comm);
  }

  void
  LimitAnalysis::check_water() const
  {
    // Body forces must be constant in each cell.
    for (const auto &cell : triangles->cells)
      {
        dealii::Point<dim> centre;
        for (const unsigned int v : cell)
          centre += triangles->vertices[v] / 3.;
        const dealii::Tensor<1, dim> f = scene.water.force(centre);
        for (const unsigned int v : cell)
          {
            const dealii::Point<dim> near =
              centre + (1. - 1e-6) * (triangles->vertices[v] - centre);
            if ((scene.water.force(near) - f).norm() > 1e-9 * f.norm() ||
                (f.norm() == 0. && scene.water.pressure(near) > 0.))
              throw InputError("Mesh/Type",
                               mesh_parameters.type.word(),
                               "unstructured where there is water and "
                               "'Analysis/Kind' is not steps",
                               format("the table cuts the cell at (%g, %g); "
                                      "strict bounds need cells on one side of "
                                      "it",
                                      centre[0],
                                      centre[1]));
          }
      }
  }

  std::vector<unsigned int>
  LimitAnalysis::programme() const
  {
    return {refines() ? most_levels : 1};
  }

  void
  LimitAnalysis::prepare_output(const RunOptions &options)
  {
    limit_output.prepare(options,
                         reduces_strength() ? "-" : bounded_load.unit(),
                         bounded_load.factor() == LoadFactor::velocity
                           ? scene.observation.reference
                           : std::nullopt);
  }

  std::string
  LimitAnalysis::headline(const std::string &name) const
  {
    if (reduces_strength())
      return name + ": bounds of the factor of safety, by which c and tan(phi) "
                    "are divided";
    return name + ": bounds of the limit load, " +
           (bounded_load.factor() == LoadFactor::velocity
              ? "the reaction to the prescribed velocity"
              : "a factor of the " + bounded_load.word());
  }

  Json
  LimitAnalysis::model()
  {
    return model_of(scene, model_mesh_of(*triangles));
  }

  BoundLevel
  LimitAnalysis::bound_load()
  {
    bounds =
      certified_bounds(bounded_load.on(scene, *triangles), inner_tolerance());
    for (const auto &[name, side] :
         {std::pair<const char *, const CertifiedBounds::Side &>("upper",
                                                                 bounds.upper),
          {"lower", bounds.lower}})
      {
        if (!side.solution.converged)
          log.print(format("  the %s bound may be sharper: ", name) +
                    side.solution.reason);
        if (!side.bound.certified)
          log.print(format("  the %s bound is not certified: ", name) +
                    side.bound.rejection);
      }
    const BoundLevel level =
      level_of(bounds, triangles->cells.size(), bounded_load.value_of_unit());
    if (bounded_load.factor() != LoadFactor::velocity &&
        level.upper_certified && level.upper <= 0.)
      throw StepFailure(
        "no factor of the load is carried: its certified upper bound is not "
        "above "
        "zero, so the dead loads alone make the body fail\n  remedy:  check "
        "the "
        "dead loads (what 'Analysis/Load factor of' does not name), the "
        "strengths and the supports");
    if (bounds.upper.solution.grows || bounds.lower.solution.grows)
      throw StepFailure(
        "the load seems unbounded: stresses in equilibrium with it grow beyond "
        "all bounds within the strength\n  remedy:  check that the body can "
        "fail: supports around it, or a side of the mesh too near, may confine "
        "it");
    if (!std::isfinite(level.upper + level.lower))
      throw StepFailure(
        "the bounds of the limit load are not finite\n  remedy:  check the "
        "supports, the strengths and the loads, or take other cells");
    return level;
  }

  BoundLevel
  LimitAnalysis::bound_factor()
  {
    reduced = reduction.on_mesh(
      [&](const double F) {
        return bounded_load.reduced(scene, *triangles, F);
      },
      inner_tolerance());
    const StrengthReduction::Level &found = reduced;
    bounds                                = std::move(reduced.bounds);
    BoundLevel level      = level_of(bounds, triangles->cells.size(), 1.);
    level.lower           = found.lower.value_or(0.);
    level.upper           = found.upper.value_or(0.);
    level.lower_certified = found.lower.has_value();
    level.upper_certified = found.upper.has_value();
    level.gap = level.certified() ? level.upper / level.lower - 1. : 0.;
    level.iterations_lower = found.iterations_lower;
    level.iterations_upper = found.iterations_upper;
    return level;
  }

  double
  LimitAnalysis::next_cells(const BoundLevel &level)
  {
    // The gap is about inversely proportional to the number of cells, of which gmsh
    // makes some more than requested. The last mesh is no larger than necessary.
    const double made =
      asked_cells > 0. ? std::clamp(level.cells / asked_cells, 1., 1.3) : 1.;
    const double left   = level.gap / (0.9 * gap_tolerance);
    double       factor = growth;
    if (level.certified() && left / made < growth)
      factor = std::max(left, 1.2) / made;
    asked_cells = std::min(factor * level.cells, 1.15 * most_cells);
    return asked_cells;
  }

  Simulation::StepOutcome
  LimitAnalysis::advance(TimePoint &now)
  {
    dealii::Timer mesh_time;
    if (sizes)
      triangles.emplace(next_mesh());
    const double  in_mesh = mesh_time.cpu_time();
    dealii::Timer time;
    BoundLevel    level;
    // A stopped level is repeated.
    const StrengthReduction before = reduction;
    try
      {
        level = reduces_strength() ? bound_factor() : bound_load();
      }
    catch (const Stopped &)
      {
        reduction = before;
        throw;
      }
    level.cpu_seconds  = time.cpu_time();
    level.mesh_seconds = in_mesh;
    const auto &levels = limit_output.all_records();
    level.number       = levels.size() + 1;
    limit_output.add_record(level);
    now.time = levels.size();

    const auto best      = certified_by(levels).gap();
    const bool is_narrow = best && *best < gap_tolerance;
    const bool is_last   = is_narrow ||
                         growth * level.cells > 1.15 * most_cells ||
                         !refines() || levels.size() == most_levels;
    if (!is_last)
      sizes = adapted_sizes(*triangles, bounds.uneven, next_cells(level));
    return is_last ? StepOutcome::stage : StepOutcome::well;
  }

  void
  LimitAnalysis::record(const TimePoint &)
  {
    if (limit_output.verbosity >= 1)
      {
        const BoundLevel &level = limit_output.all_records().back();
        const auto        shown = [](const double value, const bool certified) {
          return certified ? format("%.6g", value) : std::string("?");
        };
        log.print(
          format("level %u: %u triangles: ", level.number, level.cells) +
          shown(level.lower, level.lower_certified) + " <= " + bounded() +
          " <= " + shown(level.upper, level.upper_certified) +
          (reduces_strength() ? "" : bounded_load.after_number()) +
          (level.certified() ? format(", gap %.3g %%", 100. * level.gap) : "") +
          format(", %u + %u factorisations, %.2g s",
                 level.iterations_lower,
                 level.iterations_upper,
                 level.cpu_seconds));
      }
  }

  std::string
  LimitAnalysis::progress(const TimePoint &) const
  {
    return "";
  }

  void
  LimitAnalysis::write_fields(const double t)
  {
    // A run that was stopped between two meshes has no fields.
    if (bounds.gap.size() == triangles->cells.size())
      limit_output.write_fields(t,
                                table_of_bounds(*triangles,
                                                bounded_load.units,
                                                bounds.upper.bound,
                                                bounds.lower.bound,
                                                bounds.gap));
  }

  Json
  LimitAnalysis::topics()
  {
    const auto &levels = limit_output.all_records();
    Json        json;
    json["size"] = {{"method", analysis.word()},
                    {"cells", levels.empty() ? 0 : levels.back().cells}};
    if (!reduces_strength())
      json["load"] = {{"factor_of", bounded_load.word()},
                      {"unit", bounded_load.unit()}};
    else
      {
        const Json bounds = bracket().bounds();
        json["safety"]    = {{"factor", bounds["middle"]},
                             {"lower", bounds["lower"]},
                             {"upper", bounds["upper"]},
                             {"criterion", "certified bounds"}};
      }
    if (bounded_load.non_associated())
      json["non_associated"] = bracket().non_associated();
    json["cost"] = {{"total_s", total.wall_time()},
                    {"cpu_s", total.cpu_time()}};
    if (!levels.empty())
      json["bounds"] = limit_output.bounds(bracket());
    if (!gradients.empty())
      json["bounds"]["gradients"] = topic_of(gradients);
    return json;
  }

  std::vector<Gradient>
  LimitAnalysis::gradients_of_last() const
  {
    const BoundScene given = bounded_load.on(scene, *triangles);
    if (!reduces_strength())
      return gradients_of_load(given,
                               {given, bounds.lower},
                               {given, bounds.upper},
                               bounded_load.value_of_unit());
    const double F_lower   = reduced.lower.value_or(1.),
                 F_upper   = reduced.upper.value_or(1.);
    const BoundScene below = bounded_load.reduced(scene, *triangles, F_lower),
                     above = bounded_load.reduced(scene, *triangles, F_upper);
    return gradients_of_safety(given,
                               {below, reduced.lower_proof, F_lower},
                               {above, reduced.upper_proof, F_upper});
  }

  LoadBracket
  LimitAnalysis::certified_by(const std::vector<BoundLevel> &levels) const
  {
    if (!scene.water.varies_in_cells())
      return best_of(levels);
    // The pressures between the vertices of a mesh are its own.
    const auto last = std::find_if(levels.rbegin(),
                                   levels.rend(),
                                   [](const auto &l) { return l.certified(); });
    if (last == levels.rend())
      return best_of(levels);
    LoadBracket of_last = best_of({*last});
    of_last.seconds     = best_of(levels).seconds;
    return of_last;
  }

  LoadBracket
  LimitAnalysis::bracket() const
  {
    LoadBracket best   = certified_by(limit_output.all_records());
    best.name          = bounded();
    best.unit          = reduces_strength() || bounded_load.unit() == "-"
                           ? ""
                           : bounded_load.unit();
    best.is_associated = !bounded_load.non_associated();
    best.davis         = davis;
    return best;
  }

  void
  LimitAnalysis::finish(const double)
  {
    if (bounded_load.non_associated())
      davis = estimates_by_davis();
    const LoadBracket best = bracket();
    const auto        gap  = best.gap();
    if (!gap)
      log.warn(std::string("not certified: ") +
               (best.lower
                  ? "the upper bound: " + bounds.upper.bound.rejection
                  : "the lower bound: " + bounds.lower.bound.rejection));
    else if (!(*gap < gap_tolerance))
      log.warn(format("the gap is %.3g %%, more than 'Analysis/Gap tolerance'; "
                      "raise 'Analysis/Maximum cells' or 'Maximum levels'",
                      100. * *gap));
    if (best.lower || best.upper)
      log.print(best.text());
    // A run resumed after its last mesh has no fields.
    if (bounds.gap.size() == triangles->cells.size())
      gradients = gradients_of_last();
    if (const std::string text = text_of(gradients, bounded());
        !text.empty() && limit_output.verbosity >= 1)
      log.print(text);
    if (!best.is_associated)
      log.print("for the incremental load beside both: 'Analysis/Kind' = steps "
                "with 'Mesh/Type' = from the bounds");
  }

  std::vector<std::array<double, 2>>
  LimitAnalysis::estimates_by_davis() const
  {
    if (!reduces_strength())
      return {
        davis_estimate(bounded_load, scene, *triangles, inner_tolerance())};
    std::vector<std::array<double, 2>> estimates;
    for (const DavisVariant variant :
         {DavisVariant::A, DavisVariant::B, DavisVariant::C})
      {
        const StrengthReduction::Level estimate =
          StrengthReduction(reduction).on_mesh(
            [&](const double F) {
              return bounded_load.by_davis(scene, *triangles, F, variant);
            },
            inner_tolerance());
        estimates.push_back(
          {{estimate.lower.value_or(0.), estimate.upper.value_or(0.)}});
      }
    return estimates;
  }

  void
  LimitAnalysis::state(StateRow &row)
  {
    bool has_sizes = sizes.has_value();
    row(asked_cells, reduction, has_sizes);
    if (!has_sizes)
      return sizes.reset();
    if (!sizes)
      sizes.emplace();
    row(sizes->triangles, sizes->sizes);
  }
} // namespace geocone::GEOCONE_DIM
