// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/resources.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/bounds/bound_analysis.h>
#include <geocone/folder/run_status.h>
#include <geocone/scene/magnitudes.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_bound_analysis[] = {
      {"Analysis/Load factor of", "Analysis/Kind", {"limit load"}},
      {"Analysis/Gap tolerance",
       "Analysis/Kind",
       {"limit load", "strength reduction", "shakedown"}},
      {"Analysis/Growth of meshes",
       "Analysis/Kind",
       {"limit load", "strength reduction", "reliability", "shakedown"}},
      {"Analysis/Maximum cells",
       "Analysis/Kind",
       {"limit load", "strength reduction", "reliability", "shakedown"}},
      {"Analysis/Maximum levels",
       "Analysis/Kind",
       {"limit load", "strength reduction", "reliability", "shakedown"}},
      {"Analysis/Solver tolerance",
       "Analysis/Kind",
       {"limit load", "strength reduction", "reliability", "shakedown"}}};

    constexpr bool    is_plane      = dim == 2;
    const std::string name_of_cells = is_plane ? "triangles" : "tetrahedra";
  } // namespace

  BoundAnalysis::BoundAnalysis(const MPI_Comm       comm,
                               const ParameterFile &file,
                               Log                 &log)
    : Simulation(comm, log)
    , dealii::ParameterAcceptor("/Analysis")
    , scene(file)
    , limit_output(comm, log)
  {}

  void
  BoundAnalysis::declare_parameters(LoadChoice &load)
  {
    load.declare(*this);
    add_parameter("Gap tolerance",
                  gap_tolerance,
                  "Relative gap upper/lower - 1 of the bounds [-] below which "
                  "refinement ends; with shakedown also of the error of the "
                  "elastic stresses.");
    add_parameter("Growth of meshes",
                  growth,
                  "Ratio of the number of " + name_of_cells +
                    " of a mesh to that of the previous mesh [-].");
    add_parameter("Maximum cells",
                  most_cells,
                  "Maximum number of " + name_of_cells +
                    " of a mesh; refinement ends before it is exceeded.");
    add_parameter(
      "Maximum levels",
      most_levels,
      "Maximum number of meshes; 1: only the mesh of the section 'Mesh'.");
    add_parameter(
      "Solver tolerance",
      tolerance,
      std::string(
        "Tolerance of the interior-point method [-]: distance to the optimum "
        "of the mesh, relative to the load; also at most a tenth of the gap "
        "tolerance.") +
        (is_plane ? " Smaller values localise the mechanism in fewer cells, "
                    "which impairs adaptive refinement."
                  : ""));
  }

  void
  BoundAnalysis::check_parameters() const
  {
    if (!runs_on_ranks() && dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError(
        "Analysis/Kind",
        kind_word(),
        "steps on several ranks",
        "call it without mpirun: both bounds are computed by one "
        "process");
    const std::string  section        = "Analysis/";
    const double       largest_growth = is_plane ? 8. : 30.;
    const unsigned int least_cells    = is_plane ? 10 : 5;
    if (!(gap_tolerance > 0. && gap_tolerance < 10.))
      throw InputError(section + "Gap tolerance",
                       gap_tolerance,
                       "> 0, < 10",
                       is_plane ? "0.01 is usual" : "0.1 is usual");
    if (!(growth >= 1.1 && growth <= largest_growth))
      throw InputError(section + "Growth of meshes",
                       growth,
                       format("1.1 to %g", largest_growth),
                       "2 is usual");
    if (most_levels == 0)
      throw InputError(section + "Maximum levels",
                       most_levels,
                       ">= 1",
                       is_plane ? "12 is usual" : "3 is usual");
    if (most_cells < least_cells || most_cells > 1000000)
      throw InputError(section + "Maximum cells",
                       most_cells,
                       format("%u to 1000000", least_cells),
                       is_plane ? "20000 take about 20 s"
                                : "6000 take some minutes");
    if (!(tolerance >= 1e-8 && tolerance <= 1e-2))
      throw InputError(section + "Solver tolerance",
                       tolerance,
                       "1e-8 to 1e-2",
                       "1e-3 is usual");
    if (method.is_mpm())
      throw InputError(
        "Discretisation/Method",
        "MPM",
        "FEM with " + where(),
        std::string("sums over particles are no exact integrals, which a "
                    "strict bound needs: set Discretisation/Method = FEM") +
          (is_plane ? ", or reduce the strength by stages with 'Strength "
                      "factor' and 'Until failure'"
                    : ""));
  }

  void
  BoundAnalysis::prepare_scene(const RunOptions &options)
  {
    if (const std::string tied =
          ParameterFile::value("Discretisation/Tied sides");
        !tied.empty())
      throw InputError("Discretisation/Tied sides",
                       tied,
                       "empty with " + where(),
                       "its sides would be free in bounds: hold them, or take "
                       "steps");
    scene.geometry.may_run_script = options.may_run_scripts;
    scene.geometry.prepare();
    if (!is_possible_around_axis())
      scene.geometry.refuse_axis(where(),
                                 "bound the load of one body instead, or take "
                                 "an incremental run");
    scene.materials.prepare();
    const bool is_round = scene.geometry.is_axisymmetric();
    if (is_round)
      scene.materials.set_axisymmetric();
    scene.materials.refuse_undrained(
      where(),
      "bounds know no stress before the load, on which undrained strength "
      "depends: take Tresca with that strength, or steps");
    scene.regions.prepare(scene.geometry);
    scene.prepare_weight();
    prepare_water(options);
    scene.prepare_conditions();
    scene.dirichlet.refuse_stages(where(),
                                  "bounds have no stages: list the conditions "
                                  "of one of them in 'Boundary "
                                  "conditions/Names'");
    scene.absorbing.refuse(where(), "nothing moves fast here: leave it out");
    scene.obstacles.prepare();
    if (is_round)
      scene.obstacles.refuse(where() + " around an axis",
                             "hold a part of the boundary instead");
    scene.contacts.refuse(where(),
                          is_plane ? "let one of the bodies be an obstacle"
                                   : "mesh the bodies as one");
    scene.structures.prepare_rigid(scene.geometry, where());
    if (!is_possible_with_structures())
      scene.structures.refuse(where(),
                              "bound the load or the factor of safety instead, "
                              "with 'Analysis/Kind' = limit load or strength "
                              "reduction");
    scene.observation.prepare(
      scene.supports(), scene.materials, scene.gravity, false);
    for (const auto &condition : scene.dirichlet.list)
      if (condition->moves_with_body())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposition.word(),
                         "nodes with 'Analysis/Kind' = limit load",
                         "impose it on nodes: the mesh fits the body");
  }

  void
  BoundAnalysis::prepare_flow()
  {
    const Seepage &seepage = scene.water.seepage;
    if (!seepage.acts())
      return;
    scene.loading.prepare(scene.materials.names(), scene.tractions.names());
    scene.water.prepare_stages(scene.loading);
    if (!(seepage.time >= 0. && seepage.time <= scene.loading.duration()))
      throw InputError("Seepage/Time",
                       seepage.time,
                       format("0 to %g s, the duration of 'Loading'",
                              scene.loading.duration()),
                       "0: the initial pressures");
  }

  void
  BoundAnalysis::print_start(const RunOptions               &options,
                             const std::size_t               n_cells,
                             const std::string              &more,
                             const dealii::BoundingBox<dim> &body) const
  {
    if (options.dry_run)
      log.print(headline(options.name) +
                format(": the first mesh has %zu %s, the last one %u at most",
                       n_cells,
                       name_of_cells.c_str(),
                       most_cells) +
                more);
    log.print(options.name + ": " + text_of_magnitudes(scene, body));
  }

  void
  BoundAnalysis::print_reasons(const Side &upper, const Side &lower) const
  {
    for (const auto &[name, side] :
         {std::pair<const char *, const Side &>("upper", upper),
          {"lower", lower}})
      {
        if (!side.converged)
          log.print(format("  the %s bound may be sharper: ", name) +
                    side.reason);
        if (!side.certified)
          log.print(format("  the %s bound is not certified: ", name) +
                    side.rejection);
      }
  }

  BoundLevel
  BoundAnalysis::level_of(const Side        &upper,
                          const Side        &lower,
                          const unsigned int n_cells,
                          const double       unit)
  {
    BoundLevel level;
    level.cells            = n_cells;
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
    return level;
  }

  void
  BoundAnalysis::set_factor(BoundLevel &level, const SafetySearch::Level &found)
  {
    level.lower           = found.lower.value_or(0.);
    level.upper           = found.upper.value_or(0.);
    level.lower_certified = found.lower.has_value();
    level.upper_certified = found.upper.has_value();
    level.gap = level.certified() ? level.upper / level.lower - 1. : 0.;
    level.iterations_lower = found.iterations[SafetySearch::lower];
    level.iterations_upper = found.iterations[SafetySearch::upper];
  }

  void
  BoundAnalysis::for_each_claim(
    const BoundLevel                                    &level,
    const LoadBracket                                   &best,
    const std::function<void(const CertificateClaim &)> &write) const
  {
    if (!limit_output.writes_certificates())
      return;
    const double multiple =
      load_choice().is_reaction() ? std::abs(scene.observation.factor) : 1.;
    const auto claim = [&](const bool is_lower, const double value) {
      write({kind_word(),
             is_lower,
             value,
             reduces_strength() ? value : 1.,
             multiple});
    };
    if (level.lower_certified && best.lower == level.lower)
      claim(true, level.lower);
    if (level.upper_certified && best.upper == level.upper)
      claim(false, level.upper);
  }

  LoadBracket
  BoundAnalysis::described(LoadBracket bracket) const
  {
    bracket.name = bounded();
    bracket.unit = load_choice().is_reaction() ? load_choice().unit() : "";
    bracket.is_associated = !load_choice().non_associated();
    return bracket;
  }

  void
  BoundAnalysis::check_finite(const double bounds)
  {
    if (!std::isfinite(bounds))
      throw StepFailure(
        "the bounds of the limit load are not finite\n  remedy:  check the "
        "supports, the strengths and the loads, or take other cells");
  }

  void
  BoundAnalysis::add_level(BoundLevel level, TimePoint &now)
  {
    constexpr double rounding = 1e-6;
    if (level.certified() &&
        level.upper - level.lower <
          -rounding * std::max(std::abs(level.upper), std::abs(level.lower)))
      throw RunError(
        format("the certified upper bound, %.8g, is below the certified lower "
               "one, %.8g: one of their proofs is wrong\n  remedy:  please "
               "report this parameter file",
               level.upper,
               level.lower));
    level.memory = peak_memory_of_rank();
    level.number = limit_output.all_records().size() + 1;
    limit_output.add_record(level);
    now.time = level.number;
  }

  LoadBracket
  BoundAnalysis::certified_by(const std::vector<BoundLevel> &levels) const
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

  bool
  BoundAnalysis::is_complete(const std::optional<double> &gap) const
  {
    const auto &levels = limit_output.all_records();
    return (gap && *gap < gap_tolerance) ||
           is_last_mesh(levels.back().cells, levels.size());
  }

  void
  BoundAnalysis::prepare_triangles()
  {
    mesh_parameters.prepare(scene.geometry, method);
    if (mesh_parameters.cells == MeshParameters::Cells::quadrilaterals &&
        scene.geometry.shape != Geometry::Shape::file)
      throw InputError("Mesh/Cells",
                       "quadrilaterals",
                       "triangles with " + where(),
                       "set Mesh/Cells = triangles");
  }

  std::string
  BoundAnalysis::shown_bound(const double value, const bool certified)
  {
    return certified ? format("%.6g", value) : std::string("?");
  }

  std::vector<unsigned int>
  BoundAnalysis::programme() const
  {
    return {refines() ? most_levels : 1};
  }

  void
  BoundAnalysis::prepare_output(const RunOptions &options)
  {
    limit_output.prepare(
      options,
      load_choice().unit(),
      load_choice().is_reaction() ? scene.observation.reference : std::nullopt);
  }

  std::string
  BoundAnalysis::headline(const std::string &name) const
  {
    if (reduces_strength())
      return name + ": bounds of the factor of safety, by which c and tan(phi) "
                    "are divided";
    return name + ": bounds of the limit load, " +
           (load_choice().is_reaction()
              ? "the reaction to the prescribed velocity"
              : "a factor of the " + load_choice().word());
  }

  void
  BoundAnalysis::record(const TimePoint &)
  {
    if (limit_output.verbosity < 1)
      return;
    const BoundLevel &level = limit_output.all_records().back();
    const LoadChoice &load  = load_choice();
    log.print(
      format(
        "level %u: %u %s: ", level.number, level.cells, name_of_cells.c_str()) +
      shown_bound(level.lower, level.lower_certified) + " <= " + bounded() +
      " <= " + shown_bound(level.upper, level.upper_certified) +
      (load.is_reaction() ? " " + load.unit() : "") +
      (level.certified() ? format(", gap %.3g %%", 100. * level.gap) : "") +
      format(", %u + %u factorisations, %.2g s",
             level.iterations_lower,
             level.iterations_upper,
             level.cpu_seconds));
  }

  Json
  BoundAnalysis::topics()
  {
    const auto &levels = limit_output.all_records();
    Json        json;
    json["size"] = {{"method", kind_word()},
                    {"cells", levels.empty() ? 0 : levels.back().cells}};
    json.update(results());
    json["cost"] = times();
    if (!levels.empty())
      json["bounds"] = limit_output.bounds(bracket());
    return json;
  }

  Json
  BoundAnalysis::results() const
  {
    if (reduces_strength())
      {
        const Json bounds = bracket().bounds();
        return {{"safety",
                 {{"factor", bounds["middle"]},
                  {"lower", bounds["lower"]},
                  {"upper", bounds["upper"]},
                  {"criterion", "certified bounds"}}}};
      }
    return {
      {"load",
       {{"factor_of", load_choice().word()}, {"unit", load_choice().unit()}}}};
  }

  void
  BoundAnalysis::conclude(const LoadBracket &best,
                          const std::string &rejection_upper,
                          const std::string &rejection_lower) const
  {
    const auto gap = best.gap();
    if (!gap)
      log.warn(std::string("not certified: ") +
               (best.lower ? "the upper bound: " + rejection_upper
                           : "the lower bound: " + rejection_lower));
    else if (!(*gap < gap_tolerance))
      log.warn(format("the gap is %.3g %%, more than 'Analysis/Gap tolerance'; "
                      "raise 'Analysis/Maximum cells' or 'Maximum levels'",
                      100. * *gap));
    if (best.lower || best.upper)
      log.print(best.text());
    // In the plane the gap is about one per cent.
    const auto &levels = limit_output.all_records();
    if (const auto order = order_of_gap(levels); order && !is_plane)
      {
        const auto middle = middle_without_gap(levels);
        log.print(
          format("order of the gap in the number of %s: %.2f",
                 name_of_cells.c_str(),
                 *order) +
          (middle ? format("; without a gap the middle is %.6g, an estimate, "
                           "which is no bound",
                           *middle)
                  : std::string()));
      }
  }
} // namespace geocone::GEOCONE_DIM
