// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/limit_analysis/solid_gap.h>
#include <geocone/limit_analysis/solid_limit_analysis.h>
#include <geocone/mesh/bisection.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/scene/magnitudes.h>

#include <deal.II/base/bounding_box.h>

#include <numeric>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_solid_bounds[] = {
      {"Analysis/Velocities", "Analysis/Kind", {"limit load"}},
      {"Analysis/Stresses", "Analysis/Kind", {"limit load"}}};
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
                 "independent of steps, elasticity and inertia.");
    declare_parameters(load);
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
    if (scene.water.acts())
      throw InputError("Water/Table",
                       "water",
                       "none with " + where() + " in three dimensions",
                       "bounds with water are those of plane scenes");
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
    const dealii::BoundingBox<dim> body(tetrahedra->vertices);
    print_start(options, tetrahedra->cells.size(), "", body);
    return warn_of_magnitudes(scene, body);
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

  Simulation::StepOutcome
  SolidLimitAnalysis::advance(TimePoint &now)
  {
    dealii::Timer mesh_time;
    if (!error.empty())
      tetrahedra.emplace(bisected(
        *tetrahedra, error, std::size_t(growth * tetrahedra->cells.size())));
    const double     mesh_seconds = mesh_time.cpu_time();
    dealii::Timer    time;
    const SolidScene bound = load.on(scene, *tetrahedra);
    const auto       order = [](const Order one) {
      return one == Order::linear ? 1U : 2U;
    };
    upper = certified_upper(bound, order(velocities), inner_tolerance());
    lower = certified_lower(bound, order(stresses), inner_tolerance());
    gap = gap_of_cells(bound, order(velocities), order(stresses), upper, lower);
    for (const SolidBound *side : {&upper, &lower})
      if (side->grows && !side->certified)
        throw StepFailure(
          "the load is not bounded on this mesh: " + side->reason +
          "\n  remedy:  no mechanism fits the domain; enlarge it, refine "
          "the mesh, or check the supports");
    print_reasons(figures_of(upper), figures_of(lower));
    BoundLevel level = level_of(figures_of(upper),
                                figures_of(lower),
                                tetrahedra->cells.size(),
                                load.value_of_unit());
    level.gap_share  = std::accumulate(gap.begin(), gap.end(), 0.) /
                      ((upper.load - lower.lambda) * upper.work);
    level.mesh_seconds = mesh_seconds;
    level.cpu_seconds  = time.cpu_time();
    check_finite(level.upper + level.lower + level.gap);
    add_level(level, now);
    error = gap;
    return is_complete(bracket().gap()) ? StepOutcome::stage
                                        : StepOutcome::well;
  }

  LoadBracket
  SolidLimitAnalysis::bracket() const
  {
    LoadBracket best   = best_of(limit_output.all_records());
    best.unit          = load.is_reaction() ? load.unit() : "";
    best.is_associated = !load.non_associated();
    return best;
  }

  void
  SolidLimitAnalysis::finish(const double)
  {
    conclude(bracket(), upper.rejection, lower.rejection);
  }

  void
  SolidLimitAnalysis::state(StateRow &row)
  {
    row(*tetrahedra, error);
  }
} // namespace geocone::GEOCONE_DIM
