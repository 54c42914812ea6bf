// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/mesh/adapted_sizes.h>
#include <geocone/mesh/divided_at_chords.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/output/model_of_triangles.h>
#include <geocone/shakedown/shakedown.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  void
  ShakedownRecord::state(StateRow &row)
  {
    row(number, cells, factorisations, lower, upper, lower_in_plane, gap);
    row(lower_certified, upper_certified, alternating, proven, elastic_limit);
    row(elastic_error, net_share, state_share, most_active);
    row(cpu_seconds, mesh_seconds);
  }

  std::string
  ShakedownRecord::mode() const
  {
    // Plastic strains of a cycle that cancel out, or occur in one state.
    constexpr double half = 0.5, nearly_all = 0.95;
    return alternating <= upper || net_share < half ? "alternating plasticity"
           : state_share < nearly_all               ? "incremental collapse"
                                                    : "collapse in one state";
  }

  void
  ShakedownOutput::prepare(const RunOptions &options)
  {
    begin(options, "shakedown");
    using Record          = ShakedownRecord;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    table.add("level (-)", &Record::number);
    table.add("triangles (-)", &Record::cells);
    table.add(
      "lower factor (-)",
      [](const Record &r) { return r.lower_certified ? r.lower : none; },
      Finite::may_be);
    table.add(
      "upper factor (-)",
      [](const Record &r) { return r.upper_certified ? r.upper : none; },
      Finite::may_be);
    table.add(
      "gap (-)",
      [](const Record &r) { return r.certified() ? r.gap : none; },
      Finite::may_be);
    table.add(
      "proven upper bound (-)",
      [](const Record &r) {
        return r.upper_certified && std::isfinite(r.proven) ? r.proven : none;
      },
      Finite::may_be);
    table.add(
      "factor at first yield (-)", &Record::elastic_limit, Finite::may_be);
    table.add("error of elastic stresses (-)", &Record::elastic_error);
    table.add("net plastic strain / that of a cycle (-)", &Record::net_share);
    table.add("plastic strain in one state / that of a cycle (-)",
              &Record::state_share);
    table.add("factorisations (-)", &Record::factorisations);
    table.add("CPU time (s)", &Record::cpu_seconds);
    table.add("CPU time of the mesh (s)", &Record::mesh_seconds);
    open_table("shakedown.csv");
  }

  void
  ShakedownOutput::report_results(std::ostream &out) const
  {
    const Json &found = summary["shakedown"];
    const auto  shown = [&](const char *key) {
      return found[key].is_null() ? std::string("none")
                                   : format("%.4g", found[key].get<double>());
    };
    out << shown("lower") << ' ' << shown("upper") << ' '
        << found["mode"].get<std::string>() << '\n';
  }

  Shakedown::Shakedown(const MPI_Comm comm, const ParameterFile &file, Log &log)
    : BoundAnalysis(comm, file, log)
    , shakedown_output(comm, log)
  {
    declare_parameters(bounded_load);
  }

  void
  Shakedown::prepare_water(const RunOptions &)
  {
    scene.water.refuse(where(),
                       "give undrained strengths and total unit weights");
  }

  void
  Shakedown::check_scene() const
  {
    if (scene.geometry.shape == Geometry::Shape::file && most_levels > 1)
      throw InputError("Analysis/Maximum levels",
                       most_levels,
                       "1 with " + where() + " and a mesh from a file",
                       "meshes from files are not refined here");
    scene.materials.refuse_strength_formulas("with " + where());
    scene.obstacles.refuse(where(),
                           "hold a part of the boundary instead: the elastic "
                           "contact would not be linear");
    const BoundScene bound = bounded_load.on(scene, *triangles);
    if (!bound.interfaces.empty())
      throw InputError("Boundary conditions/Names",
                       "an oblique side with 'Velocity normal'",
                       "sides along x or y, or held in both components, with " +
                         where(),
                       "turn the body, or prescribe Velocity x and y");
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const std::string section = "Materials/" + scene.materials.name(m);
        if (bound.cones[m].is_cut())
          throw InputError(section + "/Tensile strength",
                           bound.cones[m].cut_off * bound.units.stress / sqrt2,
                           "none with " + where(),
                           "the cone alone limits tension here");
        if (!scene.materials[m].has_constant_stiffness())
          throw InputError(
            section + "/Young modulus formula",
            ParameterFile::value(section + "/Young modulus formula"),
            "empty with " + where(),
            "give layers with constants of their own");
      }
    for (unsigned int c = 0; c < triangles->cells.size(); ++c)
      for (unsigned int i = 0; i < 3; ++i)
        if (!(bound.cone_at(BoundSide::lower, c, i).k > 0.))
          throw InputError("Materials/" +
                             scene.materials.name(triangles->material[c]) +
                             "/Cohesion",
                           0,
                           "> 0 Pa with " + where(),
                           "free surfaces of soil without cohesion yield under "
                           "any load that varies: give a small one");
  }

  std::vector<std::string>
  Shakedown::prepare(const RunOptions &options)
  {
    check_parameters();
    prepare_scene(options);
    prepare_triangles();
    loads.prepare(scene);
    triangles.emplace(
      divided_at_chords(fitted_mesh(mesh_parameters, scene, comm)));
    bounded_load.prepare_tractions(scene, *triangles, kind_word());
    check_scene();
    print_start(options,
                triangles->cells.size(),
                format("; %zu states of %u loads",
                       loads.states().size(),
                       loads.n_loads()),
                dealii::BoundingBox<dim>(triangles->vertices));
    std::vector<std::string> warnings;
    if (bounded_load.non_associated())
      warnings.push_back("flow is taken as associated: with less dilatancy a "
                         "body may shake down under smaller loads only");
    return warnings;
  }

  std::string
  Shakedown::headline(const std::string &name) const
  {
    return name + format(": shakedown factor of loads that vary, %zu states",
                         loads.states().size());
  }

  Json
  Shakedown::model()
  {
    return model_of(scene, model_mesh_of(*triangles));
  }

  void
  Shakedown::refine(const ShakedownRecord &record)
  {
    sizes = adapted_sizes(*triangles,
                          found.refinement_indicator,
                          std::min(growth * record.cells, 1.15 * most_cells));
  }

  Simulation::StepOutcome
  Shakedown::advance(TimePoint &now)
  {
    dealii::Timer mesh_time;
    if (sizes)
      triangles.emplace(
        divided_at_chords(fitted_mesh(mesh_parameters, scene, comm, &*sizes)));
    ShakedownRecord record;
    record.mesh_seconds = mesh_time.cpu_time();
    dealii::Timer time;
    found = shakedown_bounds(
      bounded_load.on(scene, *triangles), loads, inner_tolerance());
    if (found.upper.solution.grows ||
        (found.lower.solution.grows && !found.upper.bound.certified))
      throw StepFailure(
        "the loads seem to have no shakedown limit: stresses grow beyond all "
        "bounds within the strength\n  remedy:  check that the body can "
        "fail: supports around it, or a side of the mesh too near, may "
        "confine it");
    const Bound &lower = found.lower.bound, &upper = found.upper.bound;
    check_finite(lower.load + upper.load);
    if (upper.certified && upper.load <= 0.)
      throw StepFailure(
        "no factor of the loads is carried: its upper bound is not above zero, "
        "so the constant loads alone make the body fail, or the loads that "
        "vary "
        "do no work\n  remedy:  check the "
        "weight and the tractions that 'Shakedown/Loads' does not name, the "
        "strengths and the supports");
    record.cells = triangles->cells.size();
    record.factorisations =
      found.lower.solution.factorisations + found.upper.solution.factorisations;
    record.lower_in_plane  = lower.load;
    record.lower           = found.out_of_plane * lower.load;
    record.alternating     = found.alternating;
    record.upper           = std::min(upper.load, found.alternating);
    record.gap             = record.upper / record.lower - 1.;
    record.lower_certified = lower.certified;
    record.upper_certified = upper.certified;
    record.proven          = found.proven;
    record.elastic_limit   = found.elastic_limit;
    record.elastic_error   = found.elastic_error;
    record.net_share       = found.net_share;
    record.state_share     = found.state_share;
    record.most_active     = found.state;
    record.cpu_seconds     = time.cpu_time();
    record.number          = shakedown_output.all_records().size() + 1;
    shakedown_output.add_record(record);
    now.time               = record.number;
    const bool is_accurate = record.certified() && record.gap < gap_tolerance &&
                             record.elastic_error < gap_tolerance;
    const bool is_last =
      is_accurate || is_last_mesh(record.cells, record.number);
    if (!is_last)
      refine(record);
    return is_last ? StepOutcome::stage : StepOutcome::well;
  }

  void
  Shakedown::record(const TimePoint &)
  {
    if (shakedown_output.verbosity < 1)
      return;
    const ShakedownRecord &last = shakedown_output.all_records().back();
    log.print(
      format("level %u: %u triangles: lower factor ", last.number, last.cells) +
      shown_bound(last.lower, last.lower_certified) + ", upper factor " +
      shown_bound(last.upper, last.upper_certified) + " (" +
      (std::isfinite(last.proven) ? format("proven: %.6g", last.proven)
                                  : std::string("none is proven")) +
      format("), elastic stresses to %.2g %%, ", 100. * last.elastic_error) +
      last.mode() + format(", %.2g s", last.cpu_seconds));
    for (const auto &[name, side] :
         {std::pair<const char *, const CertifiedSide &>("upper", found.upper),
          {"lower", found.lower}})
      {
        if (!side.solution.converged)
          log.print(format("  the %s factor may be sharper: ", name) +
                    side.solution.reason);
        if (!side.bound.certified)
          log.print(format("  the %s factor is not admissible: ", name) +
                    side.bound.rejection);
      }
  }

  void
  Shakedown::write_fields(const double t)
  {
    // A run that was stopped between two meshes has no fields.
    if (found.gap.size() == triangles->cells.size())
      shakedown_output.write_fields(
        t, table_of_shakedown(bounded_load.on(scene, *triangles), found));
  }

  Json
  Shakedown::topics()
  {
    const auto &records = shakedown_output.all_records();
    Json        json;
    json["size"] = {{"method", kind_word()},
                    {"cells", records.empty() ? 0 : records.back().cells},
                    {"states", loads.states().size()}};
    json["cost"] = times();
    if (records.empty())
      return json;
    const ShakedownRecord &last  = records.back();
    const auto             shown = [](const double value, const bool is_known) {
      return is_known && std::isfinite(value) ? Json(value) : Json();
    };
    double proven =
      std::numeric_limits<double>::infinity(); // holds for all meshes
    for (const ShakedownRecord &record : records)
      if (record.upper_certified)
        proven = std::min(proven, record.proven);
    json["shakedown"] = {
      {"lower", shown(last.lower, last.lower_certified)},
      {"upper", shown(last.upper, last.upper_certified)},
      {"gap", shown(last.gap, last.certified())},
      {"upper_proven", shown(proven, true)},
      {"lower_in_plane", shown(last.lower_in_plane, last.lower_certified)},
      {"alternating", shown(last.alternating, true)},
      {"elastic_limit", shown(last.elastic_limit, true)},
      {"elastic_error", last.elastic_error},
      {"mode", last.mode()},
      {"net_share", last.net_share},
      {"state_share", last.state_share},
      {"state", loads.name_of(last.most_active)},
      {"levels", records.size()}};
    return json;
  }

  void
  Shakedown::warn_of_falling_factor() const
  {
    const auto            &records = shakedown_output.all_records();
    const ShakedownRecord &last    = records.back();
    double                 highest = 0.;
    for (const ShakedownRecord &record : records)
      if (record.lower_certified)
        highest = std::max(highest, record.lower);
    if (last.lower_certified && last.lower < (1. - gap_tolerance) * highest)
      log.warn(
        format("the lower factor falls on finer meshes, from %.4g to %.4g, so "
               "that it may fall further: are elastic stresses unbounded, at a "
               "re-entrant corner, the end of a rough support or a jump of a "
               "load? A small fillet or a ramp of the load decides",
               highest,
               last.lower));
  }

  void
  Shakedown::finish(const double)
  {
    const ShakedownRecord &last = shakedown_output.all_records().back();
    if (!last.certified())
      log.warn(std::string("not admissible: ") +
               (last.lower_certified
                  ? "the upper factor: " + found.upper.bound.rejection
                  : "the lower factor: " + found.lower.bound.rejection));
    else if (!(last.gap < gap_tolerance && last.elastic_error < gap_tolerance))
      log.warn(
        format("the gap is %.3g %% and the elastic stresses are known to "
               "%.3g %%, more than 'Analysis/Gap tolerance'; raise "
               "'Analysis/Maximum cells' or 'Maximum levels'",
               100. * last.gap,
               100. * last.elastic_error));
    warn_of_falling_factor();
    if (found.load_difference > rounding_of_work)
      log.warn(format("no upper bound is proven: the tractions are not linear "
                      "between the vertices of the mesh, by %.1e of their "
                      "largest value or work; let them have kinks at "
                      "'Mesh/Grading points' only",
                      found.load_difference));
    if (last.lower < 0.99 * last.lower_in_plane)
      log.warn(format("stresses out of the plane reduce the lower factor from "
                      "%.4g to %.4g",
                      last.lower_in_plane,
                      last.lower));
    if (last.certified())
      log.print(format("shakedown factor: %.4g to %.4g with the elastic "
                       "stresses of the mesh, which are known to %.2g %% in "
                       "the energy norm: ",
                       last.lower,
                       last.upper,
                       100. * last.elastic_error) +
                last.mode() +
                (std::isfinite(last.elastic_limit)
                   ? format("; first yield at %.4g", last.elastic_limit)
                   : std::string()));
  }

  void
  Shakedown::state(StateRow &row)
  {
    state_of_sizes(row, sizes);
  }
} // namespace geocone::GEOCONE_DIM
