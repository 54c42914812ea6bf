// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/resources.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/bounds/time_in_bounds.h>
#include <geocone/linear/blas_kernels.h>
#include <geocone/materials/retention.h>
#include <geocone/mesh/bisection.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/output/model_of_tetrahedra.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/seepage/flow_on_mesh.h>
#include <geocone/solid_bounds/solid_certificate_files.h>
#include <geocone/solid_bounds/solid_fields.h>
#include <geocone/solid_bounds/solid_gap.h>
#include <geocone/solid_bounds/solid_limit_analysis.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_solid_bounds[] = {
      {"Analysis/Velocities",
       "Analysis/Kind",
       {"limit load", "strength reduction"}},
      {"Analysis/Stresses",
       "Analysis/Kind",
       {"limit load", "strength reduction"}}};

    constexpr double of_program = 150.; ///< memory without a mesh (MB)

    /** Cost of both bounds on a mesh. */
    struct CostOfMesh
    {
      double megabytes, seconds; ///< of one core
    };

    /** Returns the cost for clay as measured where meshes are refined
     *  (doc/cookbook/bounds_3d.md). */
    CostOfMesh
    cost_of_mesh(const double       n_cells,
                 const unsigned int degree_of_velocities,
                 const unsigned int degree_of_stresses)
    {
      const bool   v = degree_of_velocities == 1, s = degree_of_stresses == 1;
      const double N = n_cells / 1000.;
      return {of_program + ((v ? 40. : 175.) + (s ? 80. : 230.)) * N,
              ((v ? 0.35 : 1.85) + (s ? 0.6 : 2.4)) * std::pow(N, 1.5)};
    }
  } // namespace

  SolidLimitAnalysis::SolidLimitAnalysis(const MPI_Comm       comm,
                                         const ParameterFile &file,
                                         Log                 &log)
    : BoundAnalysis(comm, file, log)
  {
    kind.declare(*this,
                 "Kind",
                 ". Steps: time steps with the method of 'Discretisation'. "
                 "Limit load: strict upper and lower bounds of the limit load "
                 "of a rigid-plastic body with associated flow, on tetrahedra, "
                 "independent of steps, elasticity and inertia. Strength "
                 "reduction: strict bounds of the factor of safety, by which c "
                 "and tan(phi) are divided at collapse. Seepage: flow of water "
                 "through the pores at rest.");
    declare_parameters(load);
    limit_output.declare_certificates();
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
  SolidLimitAnalysis::prepare_water(const RunOptions &)
  {
    prepare_flow();
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      if (scene.water.seepage.acts() &&
          scene.materials.law(m).retention().adds_strength())
        throw InputError("Materials/" + scene.materials.name(m) +
                           "/Bishop parameter",
                         "chi of a suction",
                         "none with " + where() + " in three dimensions",
                         "leave it out, which is conservative");
  }

  std::vector<std::string>
  SolidLimitAnalysis::prepare(const RunOptions &options)
  {
    check_parameters();
    select_widest_blas_kernels();
    prepare_scene(options);
    mesh_parameters.prepare(scene.geometry, method);
    tetrahedra.emplace(fitted_mesh(mesh_parameters, scene, comm));
    let_water_flow(scene,
                   comm,
                   log,
                   options.dry_run,
                   scene.water.seepage.time,
                   &mesh_parameters);
    if (scene.water.acts())
      {
        const dealii::BoundingBox<dim> body(tetrahedra->vertices);
        const auto [low, high] = body.get_boundary_points();
        tetrahedra.emplace(
          divided_at(*tetrahedra, scene.water.lines(low, high)));
      }
    tetrahedra.emplace(load.divided_at_edges(scene, *tetrahedra));
    if (tetrahedra->cells.size() > most_cells)
      throw InputError("Analysis/Maximum cells",
                       most_cells,
                       format(">= %zu, the tetrahedra of the first mesh",
                              tetrahedra->cells.size()),
                       "raise it, or take larger cells in 'Mesh'");
    if (reduces_strength())
      load.prepare_reduction(scene, *tetrahedra);
    else
      load.prepare(scene, *tetrahedra);
    load.check_observed(scene);
    const dealii::BoundingBox<dim> body(tetrahedra->vertices);
    const double                   n_first = tetrahedra->cells.size();
    const double                   n_last =
      std::min(most_cells * 1., n_first * std::pow(growth, most_levels - 1.));
    const CostOfMesh cost =
      cost_of_mesh(n_last, degree(velocities), degree(stresses));
    print_start(options,
                tetrahedra->cells.size(),
                format("; it takes about %.0f MB and %.3g s of one core",
                       cost.megabytes,
                       cost.seconds) +
                  (reduces_strength() ? " for each of about 4 factors" : ""),
                body);
    std::vector<std::string> warnings = warn_of_magnitudes(scene, body);
    for (const std::string &warning : warn_of_time_in_bounds(scene))
      warnings.push_back(warning);
    if (const double available = available_memory(); cost.megabytes > available)
      warnings.push_back(format(
        "the last mesh of 'Analysis/Maximum cells' = %u needs about %.0f MB of "
        "memory, but %.0f MB are free: let %.0f cells be the most",
        most_cells,
        cost.megabytes,
        available,
        n_last * std::max(available - of_program, 0.) /
          (cost.megabytes - of_program)));
    if (const std::string remark = load.other_than_observed(scene);
        !remark.empty())
      warnings.push_back(remark);
    return warnings;
  }

  Json
  SolidLimitAnalysis::model()
  {
    return model_of(scene, model_mesh_of(*tetrahedra));
  }

  BoundAnalysis::Side
  SolidLimitAnalysis::figures_of(const SolidBound &side)
  {
    return {side.load,
            side.certified,
            side.rejection,
            side.converged,
            side.reason,
            side.factorisations,
            side.n_unknowns,
            side.violation,
            side.error};
  }

  BoundLevel
  SolidLimitAnalysis::bound_load()
  {
    const SolidScene bound = load.on(scene, *tetrahedra);
    run_both(
      [&]() {
        upper = certified_upper(bound, degree(velocities), inner_tolerance());
      },
      [&]() {
        lower = certified_lower(bound, degree(stresses), inner_tolerance());
      });
    for (const SolidBound *side : {&upper, &lower})
      if (side->grows && !side->certified)
        throw StepFailure(
          "the load is not bounded on this mesh: " + side->reason +
          "\n  remedy:  no mechanism fits the domain; enlarge it, refine "
          "the mesh, or check the supports");
    print_reasons(figures_of(upper), figures_of(lower));
    gap =
      gap_of_cells(bound, degree(velocities), degree(stresses), upper, lower);
    share = share_of_gap();
    return level_of(figures_of(upper),
                    figures_of(lower),
                    tetrahedra->cells.size(),
                    load.load_of_unit_factor());
  }

  /** Limit analyses with reduced strength on the current mesh, for SafetySearch. */
  class SolidLimitAnalysis::Reduced : public SafetySearch::Solver
  {
  public:
    explicit Reduced(SolidLimitAnalysis &of)
      : of(of)
    {}

    std::array<SafetySearch::Attempt, 2>
    both(const double F) override
    {
      SafetySearch::Attempt below, above;
      run_both([&]() { above = one(F, SafetySearch::upper); },
               [&]() { below = one(F, SafetySearch::lower); });
      of.gap   = gap_of_cells(of.load.reduced(of.scene, *of.tetrahedra, F),
                            degree(of.velocities),
                            degree(of.stresses),
                            of.upper,
                            of.lower);
      of.share = of.share_of_gap();
      return {{below, above}};
    }

    SafetySearch::Attempt
    one(const double F, const SafetySearch::Side side) override
    {
      const SolidScene bound    = of.load.reduced(of.scene, *of.tetrahedra, F);
      const bool       is_lower = side == SafetySearch::lower;
      SolidBound      &found    = is_lower ? of.lower : of.upper;
      found =
        is_lower
          ? certified_lower(bound, degree(of.stresses), of.inner_tolerance())
          : certified_upper(bound, degree(of.velocities), of.inner_tolerance());
      return {found.load,
              found.certified,
              found.grows,
              found.factorisations,
              found.rejection};
    }

    void
    keep(const SafetySearch::Side side) override
    {
      (side == SafetySearch::lower ? proof_lower : proof_upper) =
        side == SafetySearch::lower ? of.lower : of.upper;
    }

    std::optional<SolidBound> proof_lower, proof_upper;

  private:
    SolidLimitAnalysis &of;
  };

  BoundLevel
  SolidLimitAnalysis::bound_factor()
  {
    // A stopped level is repeated.
    SafetySearch              next = search;
    Reduced                   reduced(*this);
    const SafetySearch::Level found = next.on_mesh(reduced);
    search                          = next;
    if (reduced.proof_lower)
      lower = *reduced.proof_lower;
    if (reduced.proof_upper)
      upper = *reduced.proof_upper;
    BoundLevel level = level_of(
      figures_of(upper), figures_of(lower), tetrahedra->cells.size(), 1.);
    set_factor(level, found);
    return level;
  }

  double
  SolidLimitAnalysis::share_of_gap() const
  {
    return std::accumulate(gap.begin(), gap.end(), 0.) /
           ((upper.load - lower.lambda) * upper.work);
  }

  Simulation::StepOutcome
  SolidLimitAnalysis::advance(TimePoint &now)
  {
    dealii::Timer mesh_time;
    if (!error.empty())
      {
        tetrahedra.emplace(bisected(
          *tetrahedra, error, std::size_t(growth * tetrahedra->cells.size())));
        error.clear(); // a level that is stopped is repeated on this mesh
      }
    const double  mesh_seconds = mesh_time.cpu_time();
    dealii::Timer time;
    BoundLevel    level = reduces_strength() ? bound_factor() : bound_load();
    level.gap_share     = share;
    level.mesh_seconds  = mesh_seconds;
    level.cpu_seconds   = time.cpu_time();
    check_finite(level.upper + level.lower + level.gap);
    add_level(level, now);
    for_each_claim(level,
                   certified_by(limit_output.all_records()),
                   [&](const CertificateClaim &claim) {
                     write_certificate(limit_output.folder(),
                                       load.on(scene, *tetrahedra),
                                       claim.is_lower ? lower : upper,
                                       claim);
                   });
    error = error_of_cells(*tetrahedra, gap, upper, lower);
    return is_complete(bracket().gap()) ? StepOutcome::stage
                                        : StepOutcome::well;
  }

  void
  SolidLimitAnalysis::write_fields(const double t)
  {
    // A run that was stopped between two meshes has no fields.
    if (gap.size() == tetrahedra->cells.size())
      limit_output.write_fields(
        t, table_of_bounds(*tetrahedra, load.units, upper, lower, gap));
  }

  LoadBracket
  SolidLimitAnalysis::bracket() const
  {
    return described(certified_by(limit_output.all_records()));
  }

  void
  SolidLimitAnalysis::finish(const double)
  {
    conclude(bracket(), upper.rejection, lower.rejection);
  }

  void
  SolidLimitAnalysis::state(StateRow &row)
  {
    row(*tetrahedra, error, search);
  }
} // namespace geocone::GEOCONE_DIM
