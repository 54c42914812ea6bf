// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/number_in.h>
#include <geocone/base/parameter_file.h>
#include <geocone/bounds/time_in_bounds.h>
#include <geocone/limit_analysis/bound_fields.h>
#include <geocone/limit_analysis/certificate_files.h>
#include <geocone/limit_analysis/fans_of_jumps.h>
#include <geocone/limit_analysis/limit_analysis.h>
#include <geocone/mesh/adapted_sizes.h>
#include <geocone/output/model_of_triangles.h>
#include <geocone/plane_bounds/bar_cells.h>
#include <geocone/plane_bounds/bound_loads.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/seepage/flow_on_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Writes the table of forces and plastic rates along all structures. Velocities and
     *  rates are those for the largest speed of a structure of 1 m/s. */
    void
    write_structures(const std::string           &file,
                     const Structures            &structures,
                     const std::vector<BarPoint> &points)
    {
      CsvFile table;
      table.open(file,
                 {"structure",
                  "distance along it (m)",
                  "x (m)",
                  "y (m)",
                  "axial force (N/m)",
                  "shear force (N/m)",
                  "bending moment (N m/m)",
                  "velocity x (-)",
                  "velocity y (-)",
                  "plastic rotation rate (1/m)",
                  "plastic axial strain rate (1/m)",
                  "plastic axial jump (-)"});
      double largest = std::numeric_limits<double>::min();
      for (const BarPoint &point : points)
        largest = std::max(largest, point.velocity.norm());
      for (const BarPoint &point : points)
        for (unsigned int i = 0; i < structures.list.size(); ++i)
          if (structures.list[i].get() == point.structure)
            table.add_line({i + 1.,
                            point.arc,
                            point.x[0],
                            point.x[1],
                            point.normal,
                            point.shear,
                            point.moment,
                            point.velocity[0] / largest,
                            point.velocity[1] / largest,
                            point.hinge / largest,
                            point.rate / largest,
                            point.jump / largest});
    }

    /** Largest forces of each structure in the lower bound, and their parts of the
     *  strengths. */
    Json
    topic_of_structures(const Structures            &structures,
                        const std::vector<BarPoint> &points)
    {
      Json json;
      for (const auto &structure : structures.list)
        {
          double most = std::numeric_limits<double>::lowest(), least = -most,
                 moment = 0., used = 0.;
          const auto [low, high] = structure->axial_strength();
          for (const BarPoint &point : points)
            if (point.structure == structure.get())
              {
                most   = std::max(most, point.normal);
                least  = std::min(least, point.normal);
                moment = std::max(moment, std::abs(point.moment));
              }
          if (high > 0.)
            used = std::max(used, most / high);
          if (low < 0.)
            used = std::max(used, least / low);
          const std::string key = Structures::key_of(structure->name) + "_";
          json[key + "axial_force_most_N_per_m"]  = most;
          json[key + "axial_force_least_N_per_m"] = least;
          json[key + "axial_strength_used"]       = used;
          if (structure->is_plate())
            {
              json[key + "moment_N"] = moment;
              json[key + "moment_strength_used"] =
                moment / structure->moment_capacity();
            }
        }
      return json;
    }
  } // namespace

  namespace
  {
    /** Parameters that laws around an axis ignore, without which bounds hold: name,
     *  value without effect, and remedy. */
    const std::array<std::array<std::string, 3>, 3> known_to_plane_laws = {
      {{{"Tensile strength",
         "none",
         "tension is limited by the cone alone there: set it to none, or take "
         "a "
         "plane or three-dimensional scene"}},
       {{"Passive strength ratio",
         "1",
         "strengths by direction are those of plane strain: take a mean"}},
       {{"Simple shear strength ratio",
         "1",
         "strengths by direction are those of plane strain: take a mean"}}}};
  } // namespace

  LimitAnalysis::LimitAnalysis(const MPI_Comm       comm,
                               const ParameterFile &file,
                               Log                 &log)
    : BoundAnalysis(comm, file, log)
  {
    analysis.declare(
      *this,
      "Kind",
      ". Steps: time steps with the method of 'Discretisation'. Limit load: "
      "strict upper and lower bounds of the limit load of a rigid-plastic body "
      "with associated flow, on adaptively refined triangular meshes, "
      "independent of steps, elasticity and inertia. Strength reduction: "
      "strict bounds of the factor of safety, by which c and tan(phi) are "
      "divided at collapse. Reliability: probability that the body fails, with "
      "strengths and weights from 'Random fields'; whether a sample fails is "
      "certified by the bounds. Shakedown: factors of loads that vary within "
      "the limits of 'Shakedown', below which plastic strains cease, by "
      "Melan's and Koiter's theorems.");
    declare_parameters(bounded_load);
    intervals.declare(*this);
    limit_output.declare_certificates();
    for (const std::string &name : scene.materials.names())
      for (const auto &[parameter, without, remedy] : known_to_plane_laws)
        {
          const std::string path = "Materials/" + name + "/" + parameter;
          if (const std::string value = file.peek(path, without);
              value != without &&
              (!number_in(value) || number_in(value) != number_in(without)))
            of_plane_laws.push_back({{path, value, without, remedy}});
        }
  }

  void
  LimitAnalysis::prepare_water(const RunOptions &options)
  {
    const Seepage &seepage = scene.water.seepage;
    if (!seepage.acts())
      return;
    if (scene.geometry.is_axisymmetric())
      throw InputError(
        "Seepage/Names",
        ParameterFile::value("Seepage/Names"),
        "none with " + where() + " around an axis",
        "the flow is that of plane scenes: give its pressures by "
        "'Water/Table' or 'Water/File'");
    prepare_flow();
    let_water_flow(scene, comm, log, options.dry_run, seepage.time);
  }

  void
  LimitAnalysis::check_axis() const
  {
    if (!scene.geometry.is_axisymmetric())
      return;
    for (const auto &[path, value, allowed, remedy] : of_plane_laws)
      throw InputError(
        path, value, allowed + " with " + where() + " around an axis", remedy);
  }

  std::vector<std::string>
  LimitAnalysis::warnings_of(const dealii::BoundingBox<dim> &body) const
  {
    std::vector<std::string> warnings = warn_of_magnitudes(scene, body);
    for (const std::string &warning : warn_of_time_in_bounds(scene))
      warnings.push_back(warning);
    if (!refines() && most_levels > 1)
      warnings.push_back(
        "the mesh from the file is not refined: " + file_domain->obstacle() +
        "; the bounds are those of this mesh. Give a mesh of one body, or set "
        "Analysis/Maximum levels = 1");
    if (const std::string remark = bounded_load.other_than_observed(scene);
        !remark.empty())
      warnings.push_back(remark);
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
    prepare_triangles();
    check_axis();
    if (limit_output.writes_certificates())
      {
        const std::string what = "'Output/Certificates' = true";
        scene.structures.refuse(
          what, "set it to false: the bounds are checked all the same");
        scene.materials.refuse_strength_formulas("with " + what);
      }
    triangles.emplace(fitted_mesh(mesh_parameters, scene, comm));
    const dealii::BoundingBox<dim> body(triangles->vertices);
    scene.geometry.check_radii(triangles->vertices,
                               1e-12 * body.side_length(0));
    if (scene.geometry.shape == Geometry::Shape::file)
      file_domain.emplace(domain_of_file(*triangles, scene));
    if (scene.water.acts() && !scene.water.varies_in_cells())
      check_water();
    if (reduces_strength())
      bounded_load.prepare_reduction(scene, *triangles, kind_word());
    else
      bounded_load.prepare(scene, *triangles);
    bounded_load.check_observed(scene);
    intervals.prepare(bounded_load.on(scene, *triangles));
    print_start(options,
                triangles->cells.size(),
                format("; about %.0f MB", 100. + 0.02 * most_cells),
                body);
    return warnings_of(body);
  }

  CoarseMesh
  LimitAnalysis::next_mesh() const
  {
    if (!file_domain)
      return fitted_mesh(mesh_parameters, scene, comm, &*sizes);
    const dealii::BoundingBox<dim> body(triangles->vertices);
    const auto [low, high] = body.get_boundary_points();
    MeshLines lines        = scene.water.lines(low, high);
    for (const auto &line : scene.structures.lines())
      lines.push_back(line);
    return file_domain->mesh(
      *sizes, std::move(lines), mesh_parameters.algorithm, comm);
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
                               format("%s the cell at (%g, %g); "
                                      "strict bounds need cells on one side of "
                                      "it",
                                      scene.water.scales_with_weight()
                                        ? "a kink of the pore pressures cuts"
                                        : "the table cuts",
                                      centre[0],
                                      centre[1]));
          }
      }
  }

  Json
  LimitAnalysis::model()
  {
    return model_of(scene, model_mesh_of(*triangles));
  }

  BoundAnalysis::Side
  LimitAnalysis::figures_of(const CertifiedSide &side)
  {
    return {side.bound.load,
            side.bound.certified,
            side.bound.rejection,
            side.solution.converged,
            side.solution.reason,
            side.solution.factorisations,
            side.n_unknowns,
            side.bound.violation,
            side.bound.error};
  }

  BoundLevel
  LimitAnalysis::level_of(const double unit) const
  {
    BoundLevel level = BoundAnalysis::level_of(figures_of(bounds.upper),
                                               figures_of(bounds.lower),
                                               triangles->cells.size(),
                                               unit);
    level.gap_share  = bounds.gap_share;
    return level;
  }

  BoundLevel
  LimitAnalysis::bound_load()
  {
    bounds =
      certified_bounds(bounded_load.on(scene, *triangles), inner_tolerance());
    print_reasons(figures_of(bounds.upper), figures_of(bounds.lower));
    const BoundLevel level = level_of(bounded_load.load_of_unit_factor());
    if (!bounded_load.is_reaction() && level.upper_certified &&
        level.upper <= 0.)
      throw StepFailure(
        "no factor of the load is carried: its certified upper bound is not "
        "above "
        "zero, so the dead loads alone make the body fail\n  remedy:  check "
        "the "
        "dead loads (what 'Analysis/Load factor of' does not name), the "
        "strengths and the supports");
    // The lower bound may be loose beside an upper one that is sharp.
    if (bounds.upper.solution.grows ||
        (bounds.lower.solution.grows && !level.upper_certified))
      throw StepFailure(
        "the load seems unbounded: stresses in equilibrium with it grow beyond "
        "all bounds within the strength\n  remedy:  check that the body can "
        "fail: supports around it, or a side of the mesh too near, may confine "
        "it");
    check_finite(level.upper + level.lower);
    return level;
  }

  BoundLevel
  LimitAnalysis::bound_factor()
  {
    // A stopped level is repeated.
    StrengthReduction next  = reduction;
    const BoundScene  given = bounded_load.on(scene, *triangles);
    reduced                 = next.on_mesh(
      [&](const double F) { return bounded_load.reduced(given, F); },
      inner_tolerance());
    reduction        = next;
    bounds           = std::move(reduced.bounds);
    BoundLevel level = level_of(1.);
    set_factor(level, reduced);
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

  void
  LimitAnalysis::refine(const BoundLevel &level)
  {
    double           wanted = next_cells(level);
    std::vector<Fan> fans;
    if (sizes)
      fans = std::move(sizes->fans);
    else if (file_domain || mesh_parameters.is_unstructured())
      {
        const BoundScene given = bounded_load.on(scene, *triangles);
        const BoundScene bound =
          reduces_strength()
            ? bounded_load.reduced(given, level.certified() ? level.upper : 1.)
            : given;
        // The load is known roughly. An eighth of the gap is left to the rays, or more of it
        // where fans would have more than half of the triangles.
        const double load = reduces_strength() ? 1. : bounds.upper.bound.load;
        for (double part = gap_tolerance / 8.; part < 0.5; part *= 2.)
          {
            fans            = fans_of_jumps(bound, load, part);
            std::size_t all = 0;
            for (const Fan &fan : fans)
              all += fan.n_triangles();
            if (all <= most_cells / 2)
              {
                wanted = std::min(wanted, double(most_cells - all));
                break;
              }
            fans.clear();
          }
      }
    sizes = adapted_sizes(
      *triangles, bounds.refinement_indicator, wanted, std::move(fans));
  }

  Simulation::StepOutcome
  LimitAnalysis::advance(TimePoint &now)
  {
    dealii::Timer mesh_time;
    if (sizes)
      try
        {
          triangles.emplace(next_mesh());
        }
      catch (const InputError &problem)
        {
          if (sizes->fans.empty())
            throw;
          log.print(std::string("  meshes without fans follow: ") +
                    problem.what());
          sizes->fans.clear();
          triangles.emplace(next_mesh());
        }
    const double  in_mesh = mesh_time.cpu_time();
    dealii::Timer time;
    BoundLevel    level = reduces_strength() ? bound_factor() : bound_load();
    level.cpu_seconds  = time.cpu_time();
    level.mesh_seconds = in_mesh;
    add_level(level, now);
    for_each_claim(level,
                   certified_by(limit_output.all_records()),
                   [&](const CertificateClaim &claim) {
                     const auto &side =
                       !reduces_strength()
                         ? (claim.is_lower ? bounds.lower : bounds.upper)
                         : (claim.is_lower ? reduced.lower_proof
                                           : reduced.upper_proof);
                     write_certificate(limit_output.folder(),
                                       bounded_load.on(scene, *triangles),
                                       side.bound,
                                       claim);
                   });
    const bool is_last =
      is_complete(certified_by(limit_output.all_records()).gap());
    if (!is_last)
      refine(level);
    return is_last ? StepOutcome::stage : StepOutcome::well;
  }

  void
  LimitAnalysis::write_fields(const double t)
  {
    // A run that was stopped between two meshes has no fields.
    if (bounds.gap.size() == triangles->cells.size())
      limit_output.write_fields(
        t,
        table_of_bounds(bounded_load.on(scene, *triangles),
                        bounds.upper.bound,
                        bounds.lower.bound,
                        bounds.gap));
  }

  Json
  LimitAnalysis::results() const
  {
    Json json = BoundAnalysis::results();
    if (bounded_load.non_associated())
      json["non_associated"] = bracket().non_associated();
    return json;
  }

  Json
  LimitAnalysis::topics()
  {
    Json json = BoundAnalysis::topics();
    if (!gradients.empty())
      json["bounds"]["gradients"] = topic_of(gradients);
    if (of_intervals.is_asked())
      json["bounds"]["interval"] = intervals.topic_of(of_intervals);
    if (const auto points = points_of_structures(); !points.empty())
      json["structures"] = topic_of_structures(scene.structures, points);
    return json;
  }

  std::vector<Gradient>
  LimitAnalysis::gradients_of_last() const
  {
    if (!scene.structures.list.empty())
      return {};
    const BoundScene given = bounded_load.on(scene, *triangles);
    if (!reduces_strength())
      return gradients_of_load(given,
                               {given, bounds.lower},
                               {given, bounds.upper},
                               bounded_load.load_of_unit_factor());
    const double F_lower   = reduced.lower.value_or(1.),
                 F_upper   = reduced.upper.value_or(1.);
    const BoundScene below = bounded_load.reduced(given, F_lower),
                     above = bounded_load.reduced(given, F_upper);
    return gradients_of_safety(given,
                               {below, reduced.lower_proof, F_lower},
                               {above, reduced.upper_proof, F_upper});
  }

  IntervalBounds::Answer
  LimitAnalysis::bounds_of_intervals() const
  {
    const BoundScene given = bounded_load.on(scene, *triangles);
    const double     gap   = gap_tolerance / 2.;
    return reduces_strength()
             ? intervals.of_safety(
                 given,
                 inner_tolerance(),
                 gap,
                 {{reduced.lower.value_or(1.), reduced.upper.value_or(1.)}},
                 reduction.last_search())
             : intervals.of_load(given,
                                 inner_tolerance(),
                                 gap,
                                 bounded_load.load_of_unit_factor());
  }

  std::vector<BarPoint>
  LimitAnalysis::points_of_structures() const
  {
    // A run resumed after its last mesh has no fields.
    if (scene.structures.list.empty() || !triangles ||
        bounds.gap.size() != triangles->cells.size())
      return {};
    const bool has_proofs =
      reduces_strength() && reduced.lower && reduced.upper;
    const Bound &upper =
                  has_proofs ? reduced.upper_proof.bound : bounds.upper.bound,
                &lower =
                  has_proofs ? reduced.lower_proof.bound : bounds.lower.bound;
    if (!upper.certified || !lower.certified)
      return {};
    return points_of_bars(bounded_load.on(scene, *triangles), upper, lower);
  }

  LoadBracket
  LimitAnalysis::bracket() const
  {
    LoadBracket best = described(certified_by(limit_output.all_records()));
    best.davis       = davis;
    return best;
  }

  void
  LimitAnalysis::finish(const double)
  {
    const bool is_plane = !scene.geometry.is_axisymmetric();
    if (bounded_load.non_associated() && is_plane)
      davis = estimates_by_davis();
    const LoadBracket best = bracket();
    conclude(best, bounds.upper.bound.rejection, bounds.lower.bound.rejection);
    warn_of_tractions();
    // A run resumed after its last mesh has no fields.
    if (bounds.gap.size() == triangles->cells.size())
      gradients = gradients_of_last();
    if (intervals.is_asked())
      {
        of_intervals = bounds_of_intervals();
        log.print(intervals.text_of(
          of_intervals,
          bounded(),
          bounded_load.is_reaction() ? " " + bounded_load.unit() : "",
          !bounded_load.non_associated()));
        for (const std::string &warning :
             intervals.warnings_of(of_intervals, bounded()))
          log.warn(warning);
      }
    if (const auto points = points_of_structures(); !points.empty())
      write_structures(
        limit_output.folder() + "/structures.csv", scene.structures, points);
    if (const std::string text = text_of(gradients, bounded());
        !text.empty() && limit_output.verbosity >= 1)
      log.print(text);
    if (!best.is_associated && is_plane && scene.structures.list.empty())
      log.print("for the incremental load beside both: 'Analysis/Kind' = steps "
                "with 'Mesh/Type' = from the bounds");
  }

  void
  LimitAnalysis::warn_of_tractions() const
  {
    const BoundScene bound = bounded_load.on(scene, *triangles);
    for (const auto &load : scene.tractions.list)
      if (const double departure = departure_of_traction(bound, *load);
          departure > 1e-3)
        log.warn(format(
          "the traction '%s' is not linear between the vertices of the mesh, "
          "by "
          "up to %.2g %% of its largest value: the bounds are those of "
          "slightly "
          "different loads; let it jump or bend at corners or 'Mesh/Grading "
          "points' only, or take smaller cells there",
          load->name.c_str(),
          100. * departure));
  }

  std::vector<std::array<double, 2>>
  LimitAnalysis::estimates_by_davis() const
  {
    if (!reduces_strength())
      return {
        davis_estimate(bounded_load, scene, *triangles, inner_tolerance())};
    const BoundScene given = bounded_load.on(scene, *triangles);
    std::vector<std::array<double, 2>> estimates;
    for (const DavisVariant variant :
         {DavisVariant::A, DavisVariant::B, DavisVariant::C})
      {
        const StrengthReduction::Level estimate =
          StrengthReduction(reduction).on_mesh(
            [&](const double F) {
              return bounded_load.by_davis(given, F, variant);
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
    row(asked_cells, reduction);
    state_of_sizes(row, sizes);
  }
} // namespace geocone::GEOCONE_DIM
