// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/limit_analysis/limit_analysis.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
{
  using dealii::Point;
  using dealii::Tensor;

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
      ". Steps: the scene moves, by the method of 'Discretisation'. Limit "
      "load: "
      "strict upper and lower bounds of the load that a rigid-plastic body "
      "with "
      "associated flow bears, on meshes of triangles that are refined where "
      "they "
      "differ; steps, elasticity and inertia have no part in it.");
    asked_factor.declare(
      *this,
      "Load factor of",
      ". What the bounded factor multiplies; other loads are dead. Velocity: "
      "the "
      "bounded load is the reaction to the prescribed velocities, which are "
      "those "
      "at t = 0. Automatic: velocity if some is not zero, else weight, else "
      "tractions.");
    add_parameter(
      "Gap tolerance",
      gap_tolerance,
      "Meshes are refined until upper/lower - 1 is less than this.");
    add_parameter("Growth of meshes",
                  growth,
                  "Each mesh has about so many times the triangles of the last "
                  "one.");
    add_parameter("Maximum cells",
                  most_cells,
                  "No mesh is made that would have more triangles.");
    add_parameter("Maximum levels",
                  most_levels,
                  "The number of meshes; 1: only that of the section 'Mesh'.");
    add_parameter("Solver tolerance",
                  tolerance,
                  "The interior-point method ends where the distance to the "
                  "optimum of the mesh is less than this part of the load.");
  }

  std::vector<std::string>
  LimitAnalysis::prepare(const RunOptions &options)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      throw InputError(
        "Analysis/Kind",
        "limit load",
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
                       "1e-4 is usual");
    if (method.is_mpm())
      throw InputError("Discretisation/Method",
                       "MPM",
                       "FEM with 'Analysis/Kind' = limit load",
                       "sums over particles are no exact integrals, which a "
                       "strict bound needs: set Discretisation/Method = FEM");
    scene.geometry.prepare();
    scene.materials.prepare();
    scene.regions.prepare(scene.geometry);
    scene.gravity.prepare();
    scene.dirichlet.prepare();
    scene.tractions.prepare();
    scene.observation.prepare(scene.dirichlet, scene.materials, scene.gravity);
    for (const auto &condition : scene.dirichlet.list)
      if (condition->moves())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposition.word(),
                         "nodes with 'Analysis/Kind' = limit load",
                         "impose it on nodes: the mesh fits the body");
    mesh_parameters.prepare(scene.geometry, method);
    if (mesh_parameters.cells == MeshParameters::Cells::quadrilaterals &&
        scene.geometry.shape != Geometry::Shape::file)
      throw InputError("Mesh/Cells",
                       "quadrilaterals",
                       "triangles with 'Analysis/Kind' = limit load",
                       "set Mesh/Cells = triangles");
    take_cones();
    triangles.emplace(fitted_mesh(mesh_parameters, scene, method, comm));
    choose_factor();
    choose_units();
    const BoundScene bound = bound_scene(*triangles);
    check_supports(upper_problem(bound));
    const BoundProblem problem = lower_problem(bound);
    if (factor != LoadFactor::velocity && !problem.has_factor())
      throw InputError("Analysis/Load factor of",
                       asked_factor.word(),
                       "a load that is not zero",
                       factor == LoadFactor::weight
                         ? "give 'Gravity/Acceleration' and densities"
                         : "give 'Tractions' that are not zero at t = 0");
    if (options.dry_run)
      log.print(headline(options.name) +
                format(": the first mesh has %zu triangles, the last one %u at "
                       "most; about %.0f MB",
                       triangles->cells.size(),
                       most_cells,
                       100. + 0.02 * most_cells));
    std::vector<std::string> warnings;
    if (scene.geometry.shape == Geometry::Shape::file && most_levels > 1)
      warnings.push_back("a mesh from a file is not made anew: the bounds are "
                         "those of this mesh; give a box or a polygon, or set "
                         "Analysis/Maximum levels = 1");
    return warnings;
  }

  void
  LimitAnalysis::check_supports(const BoundProblem &problem) const
  {
    // Rigid motions in the dofs that are prescribed: translations and a rotation.
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    const auto      add = [&](const unsigned int node, const Point<dim> &x) {
      for (unsigned int d = 0; d < dim; ++d)
        if (problem.is_prescribed[dim * node + d])
          {
            Eigen::Vector3d row = Eigen::Vector3d::Zero();
            row[d]              = 1.;
            row[2]              = (d == 0 ? -x[1] : x[0]) / units.length;
            squares += row * row.transpose();
          }
    };
    std::vector<bool> is_used(triangles->vertices.size(), false);
    for (const auto &cell : triangles->cells)
      for (const unsigned int v : cell)
        is_used[v] = true;
    for (unsigned int v = 0; v < triangles->vertices.size(); ++v)
      if (is_used[v])
        add(v, triangles->vertices[v]);
    for (unsigned int e = 0; e < triangles->edges.size(); ++e)
      {
        const auto       &ends = triangles->edges[e].vertices;
        const Point<dim> &a    = triangles->vertices[ends[0]],
                         &b    = triangles->vertices[ends[1]];
        add(triangles->vertices.size() + e, Point<dim>(a + (b - a) / 2.));
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
    if (solver.eigenvalues()[0] > 1e-10 * solver.eigenvalues()[2])
      return;
    const Eigen::Vector3d free = solver.eigenvectors().col(0);
    throw InputError(
      "Boundary conditions/Names",
      "conditions that leave a rigid motion free",
      "supports that hold the body against translation and rotation",
      std::string("nothing resists a ") +
        (std::abs(free[2]) > 0.1   ? "rotation"
         : std::abs(free[0]) > 0.7 ? "translation along x"
         : std::abs(free[1]) > 0.7 ? "translation along y"
                                   : "translation") +
        " of the body, so no load has a limit: hold another side");
  }

  void
  LimitAnalysis::take_cones()
  {
    scene.materials.check_closed_form("limit load");
    flow_cones.clear();
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const auto        cone = scene.materials[m].initial_cone();
        const std::string parameter =
          "Materials/" + scene.materials.name(m) + "/Type";
        if (!cone)
          throw InputError(parameter,
                           "a law without strength",
                           "Mohr-Coulomb | Tresca with 'Analysis/Kind' = limit "
                           "load",
                           "what cannot yield bears any load: give it a "
                           "strength, or leave it out of the domain");
        if (cone->hardening != 0.)
          throw InputError(parameter,
                           "a law that hardens",
                           "Mohr-Coulomb | Tresca with 'Analysis/Kind' = limit "
                           "load",
                           "take the strength that counts, initial or final");
        flow_cones.push_back(*cone);
        non_associated = non_associated || cone->b < cone->a * (1. - 1e-12);
      }
  }

  void
  LimitAnalysis::choose_factor()
  {
    // The velocity that is prescribed, where it is not zero.
    std::optional<Tensor<1, dim>> velocity;
    double                        speed = 0.;
    for (const auto &condition : scene.dirichlet.list)
      for (const auto &held : triangles->held_edges(*condition))
        for (const unsigned int v : triangles->edges[held.edge].vertices)
          {
            const Point<dim> &x = triangles->vertices[v];
            Tensor<1, dim>    here;
            for (unsigned int d = 0; d < dim; ++d)
              if (condition->components[d])
                here[d] = condition->components[d]->value(x, 0.);
            if (condition->normal && condition->normal->value(x, 0.) != 0.)
              throw InputError(condition->parameter("Velocity normal"),
                               condition->formula(dim),
                               "0 with 'Analysis/Kind' = limit load",
                               "push by Velocity x or y");
            if (here.norm() == 0.)
              continue;
            speed = std::max(speed, here.norm());
            if (velocity && (*velocity - here).norm() > 1e-9 * here.norm())
              throw InputError(
                condition->parameter(here[1] != 0. ? "Velocity y"
                                                   : "Velocity x"),
                condition->formula(here[1] != 0. ? 1 : 0),
                "one velocity for all that is pushed, with 'Analysis/Kind' = "
                "limit load",
                "the bounded load is the reaction to one translation");
            velocity = here;
          }
    factor = asked_factor;
    if (factor == LoadFactor::automatic)
      factor = velocity               ? LoadFactor::velocity
               : scene.gravity.acts() ? LoadFactor::weight
                                      : LoadFactor::tractions;
    if (factor == LoadFactor::velocity && !velocity)
      throw InputError(
        "Analysis/Load factor of",
        "velocity",
        "a prescribed velocity that is not zero at t = 0",
        "push a part of the boundary, or bound the weight or the "
        "tractions");
    if (factor != LoadFactor::velocity && velocity)
      throw InputError("Analysis/Load factor of",
                       asked_factor.word(),
                       "velocity where a velocity is prescribed that is not "
                       "zero",
                       "set it to 0, or bound its reaction");
    units.velocity = velocity ? speed : 1.;
  }

  void
  LimitAnalysis::choose_units()
  {
    double area = 0., height = 0.;
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    for (unsigned int c = 0; c < triangles->cells.size(); ++c)
      {
        area += triangles->area(c);
        for (const unsigned int v : triangles->cells[c])
          {
            lowest  = std::min(lowest, triangles->vertices[v][1]);
            highest = std::max(highest, triangles->vertices[v][1]);
          }
      }
    height       = highest - lowest;
    units.length = std::sqrt(area) / 8.;
    units.stress = 0.;
    for (const FlowCone &cone : flow_cones)
      units.stress = std::max(units.stress, cone.k);
    double dead = 0.; // what there is to bear
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      dead =
        std::max(dead,
                 height * scene.materials.law(m).density() *
                   scene.gravity.at(std::numeric_limits<double>::max()).norm());
    for (const auto &load : scene.tractions.list)
      for (const auto &held : triangles->held_edges(*load))
        for (const unsigned int v : triangles->edges[held.edge].vertices)
          {
            const Point<dim> &x = triangles->vertices[v];
            for (unsigned int d = 0; d < dim; ++d)
              if (load->components[d])
                dead =
                  std::max(dead, std::abs(load->components[d]->value(x, 0.)));
            for (const auto *along : {&load->normal, &load->tangential})
              if (*along)
                dead = std::max(dead, std::abs((*along)->value(x, 0.)));
          }
    if (units.stress == 0.)
      {
        if (dead == 0.)
          throw InputError("Materials/" + scene.materials.name(0) + "/Cohesion",
                           0,
                           "> 0 Pa where there is no weight or load",
                           "nothing resists in this scene");
        units.stress = dead / 8.;
      }
    if (factor == LoadFactor::velocity)
      {
        load_unit =
          units.stress * units.length * std::abs(scene.observation.factor);
        unit = "N/m";
      }
  }

  BoundScene
  LimitAnalysis::bound_scene(const Triangles &of) const
  {
    BoundScene bound = {scene, of, factor, units, {}};
    for (const FlowCone &cone : flow_cones)
      bound.cones.push_back({cone.a, cone.k / units.stress});
    return bound;
  }

  std::vector<unsigned int>
  LimitAnalysis::programme() const
  {
    return {scene.geometry.shape == Geometry::Shape::file ? 1 : most_levels};
  }

  void
  LimitAnalysis::prepare_output(const RunOptions &options)
  {
    limit_output.prepare(options,
                         unit,
                         factor == LoadFactor::velocity
                           ? scene.observation.reference
                           : std::nullopt);
  }

  std::string
  LimitAnalysis::headline(const std::string &name) const
  {
    return name + ": bounds of the limit load, " +
           (factor == LoadFactor::velocity
              ? "the reaction to the prescribed velocity"
            : factor == LoadFactor::weight ? "a factor of the weight"
                                           : "a factor of the tractions");
  }

  BoundSolution
  LimitAnalysis::solve_upper(const BoundProblem &problem) const
  {
    InteriorPoint::Options options;
    options.tolerance             = tolerance;
    options.equilibrium_tolerance = tolerance;
    // What is missed is repaired, which is dear; a projection takes care of phi = 0.
    const bool cylinder =
      std::any_of(problem.cone.begin(),
                  problem.cone.end(),
                  [](const PointCone &cone) { return cone.is_cylinder(); });
    options.flow_tolerance = cylinder ? 1e-6 : 1e-8;
    return InteriorPoint::solve(problem, options);
  }

  BoundSolution
  LimitAnalysis::solve_lower(const BoundProblem &problem) const
  {
    InteriorPoint::Options options;
    options.tolerance             = tolerance;
    options.flow_tolerance        = tolerance;
    options.equilibrium_tolerance = 1e-7; // the repair may leave the cone
    return InteriorPoint::solve(problem, options);
  }

  BoundLevel
  LimitAnalysis::solve(const Triangles &of)
  {
    const BoundScene bound = bound_scene(of);
    BoundLevel       level;
    level.cells                   = of.cells.size();
    const BoundProblem  above     = upper_problem(bound);
    const BoundSolution kinematic = solve_upper(above);
    const BoundProblem  below     = lower_problem(bound);
    const BoundSolution statical  = solve_lower(below);
    upper                         = certify_upper(bound, above, kinematic);
    lower                         = certify_lower(bound, below, statical);
    for (const auto &[of_bound, solution, name] :
         {std::tuple<Bound &, const BoundSolution &, const char *>(
            upper, kinematic, "upper"),
          {lower, statical, "lower"}})
      {
        if (!solution.converged)
          log.print(format("  the %s bound may be sharper: ", name) +
                    solution.reason);
        if (!of_bound.certified)
          log.print(format("  the %s bound is not certified: ", name) +
                    of_bound.objection);
      }
    level.upper            = load_unit * upper.load;
    level.lower            = load_unit * lower.load;
    level.gap              = (upper.load - lower.load) / std::abs(lower.load);
    no_limit               = statical.grows || kinematic.grows;
    level.upper_certified  = upper.certified;
    level.lower_certified  = lower.certified;
    level.iterations_upper = kinematic.factorisations;
    level.iterations_lower = statical.factorisations;
    level.unknowns_upper   = above.n_unknowns();
    level.unknowns_lower   = below.n_unknowns();
    level.violation_upper  = upper.violation;
    level.violation_lower  = lower.violation;
    level.error_upper      = upper.error;
    level.error_lower      = lower.error;
    gap                    = gap_of_cells(above, upper, lower);
    double sum             = 0.;
    for (const double part : gap)
      sum += part;
    const double work = above.has_factor() ? above.live.dot(upper.q) : 1.;
    level.gap_share   = sum / ((upper.load - lower.load) * work);
    return level;
  }

  CellSizes
  LimitAnalysis::next_sizes() const
  {
    const unsigned int  n = triangles->cells.size();
    std::vector<double> size(n), wish(n);
    double              least = 0.;
    for (unsigned int c = 0; c < n; ++c)
      {
        // Of an equilateral triangle of this area.
        size[c] = std::sqrt(4. / std::sqrt(3.) * triangles->area(c));
        least   = std::max(least, gap[c]);
      }
    // The mean with the cells around: a coarse one beside others that are refined
    // would have to wait for the next mesh.
    std::vector<double>       at_vertex(triangles->vertices.size(), 0.);
    std::vector<unsigned int> n_cells(at_vertex.size(), 0);
    for (unsigned int c = 0; c < n; ++c)
      for (const unsigned int v : triangles->cells[c])
        {
          at_vertex[v] += std::max(gap[c], 0.);
          ++n_cells[v];
        }
    std::vector<double> smooth(n, 0.);
    for (unsigned int c = 0; c < n; ++c)
      for (const unsigned int v : triangles->cells[c])
        smooth[c] += at_vertex[v] / n_cells[v] / 3.;
    least *= 1e-12;
    for (unsigned int c = 0; c < n; ++c)
      wish[c] = std::pow(std::max(smooth[c], least), -1. / 3.);
    // The gap falls like one over the number of cells: the last mesh need not be
    // larger than it has to.
    const BoundLevel &last = levels.back();
    const double      wanted =
      n * (last.certified()
             ? std::clamp(last.gap / (0.85 * gap_tolerance), 1.2, growth)
             : growth);
    // The factor that gives the mesh as many cells as it is to have.
    const auto ratio = [&](const double factor, const unsigned int c) {
      return std::clamp(factor * wish[c], 0.3, 1.6);
    };
    double lower_factor = 1e-30, upper_factor = 1e30;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle = std::sqrt(lower_factor * upper_factor);
        double       cells  = 0.;
        for (unsigned int c = 0; c < n; ++c)
          cells += 1. / (ratio(middle, c) * ratio(middle, c));
        (cells > wanted ? lower_factor : upper_factor) = middle;
      }
    // At the vertices the mean of their cells.
    std::vector<double>       sum(triangles->vertices.size(), 0.);
    std::vector<unsigned int> count(sum.size(), 0);
    for (unsigned int c = 0; c < n; ++c)
      for (const unsigned int v : triangles->cells[c])
        {
          sum[v] += ratio(upper_factor, c) * size[c];
          ++count[v];
        }
    CellSizes sizes;
    for (const auto &cell : triangles->cells)
      {
        sizes.triangles.emplace_back();
        sizes.sizes.emplace_back();
        for (unsigned int i = 0; i < 3; ++i)
          {
            sizes.triangles.back()[i] = triangles->vertices[cell[i]];
            sizes.sizes.back()[i]     = sum[cell[i]] / count[cell[i]];
          }
      }
    return sizes;
  }

  Simulation::Ended
  LimitAnalysis::advance(Place &place)
  {
    dealii::Timer mesh_time;
    if (sizes)
      triangles.emplace(
        fitted_mesh(mesh_parameters, scene, method, comm, &*sizes));
    const double  in_mesh = mesh_time.cpu_time();
    dealii::Timer time;
    BoundLevel    level = solve(*triangles);
    level.cpu_seconds   = time.cpu_time();
    level.mesh_seconds  = in_mesh;
    levels.push_back(level);
    place.time = levels.size();

    if (factor != LoadFactor::velocity && level.upper_certified &&
        level.upper <= 0.)
      throw StepFailure(
        "no factor of the load is carried: its certified upper bound is not "
        "above "
        "zero, so the dead loads alone make the body fail\n  remedy:  check "
        "the "
        "dead loads (what 'Analysis/Load factor of' does not name), the "
        "strengths and the supports");
    if (no_limit)
      throw StepFailure(
        "the load seems unbounded: stresses in equilibrium with it grow beyond "
        "all bounds within the strength\n  remedy:  check that the body can "
        "fail: supports around it, or a side of the mesh too near, may confine "
        "it");
    if (!std::isfinite(level.upper + level.lower))
      throw StepFailure(
        "the bounds of the limit load are not finite\n  remedy:  check the "
        "supports, the strengths and the loads, or take other cells");
    const auto best      = Bracket(levels).gap();
    const bool is_narrow = best && *best < gap_tolerance;
    const bool is_last   = is_narrow ||
                         growth * level.cells > 1.15 * most_cells ||
                         scene.geometry.shape == Geometry::Shape::file ||
                         levels.size() == most_levels;
    if (!is_last)
      sizes = next_sizes();
    return is_last ? Ended::stage : Ended::well;
  }

  void
  LimitAnalysis::record(const Place &)
  {
    limit_output.add_level(levels.size(), levels.back());
    if (limit_output.verbosity >= 1)
      {
        const BoundLevel &level = levels.back();
        const auto        shown = [](const double value, const bool certified) {
          return certified ? format("%.6g", value) : std::string("?");
        };
        log.print(
          format("level %zu: %u triangles: ", levels.size(), level.cells) +
          shown(level.lower, level.lower_certified) +
          " <= load <= " + shown(level.upper, level.upper_certified) +
          (factor == LoadFactor::velocity ? " " + unit : "") +
          (level.certified() ? format(", gap %.3g %%", 100. * level.gap) : "") +
          format(", %u + %u factorisations, %.2g s",
                 level.iterations_lower,
                 level.iterations_upper,
                 level.cpu_seconds));
      }
  }

  std::string
  LimitAnalysis::progress(const Place &) const
  {
    return "";
  }

  void
  LimitAnalysis::write_fields(const double t)
  {
    // Not between two meshes, where a run was stopped.
    if (lower.s.size() == 3 * triangles->cells.size() && !lower.s.empty())
      limit_output.write_fields(t, *triangles, units, upper, lower, gap);
  }

  Json
  LimitAnalysis::davis_estimate() const
  {
    BoundScene bound = bound_scene(*triangles);
    for (unsigned int m = 0; m < flow_cones.size(); ++m)
      {
        // tan(phi*) = cos(theta) sin(phi)/(1 - sin(theta) sin(phi)), and
        // c* alike with c cos(phi).
        const FlowCone &cone      = flow_cones[m];
        const double    cos_theta = std::sqrt(1. - cone.b * cone.b),
                     reduction    = cos_theta / (1. - cone.a * cone.b),
                     tan_phi      = reduction * cone.a,
                     cos_phi      = 1. / std::sqrt(1. + tan_phi * tan_phi);
        bound.cones[m]            = {tan_phi * cos_phi,
                                     cone.k / units.stress * reduction * cos_phi};
      }
    const BoundProblem above = upper_problem(bound),
                       below = lower_problem(bound);
    const Bound high         = certify_upper(bound, above, solve_upper(above));
    const Bound low          = certify_lower(bound, below, solve_lower(below));
    return {{"lower", load_unit * low.load}, {"upper", load_unit * high.load}};
  }

  void
  LimitAnalysis::write_summary(const std::string &status)
  {
    Json topics;
    topics["size"] = {{"method", "limit load"},
                      {"cells", levels.empty() ? 0 : levels.back().cells}};
    topics["load"] = {{"factor_of",
                       factor == LoadFactor::velocity ? "velocity"
                       : factor == LoadFactor::weight ? "weight"
                                                      : "tractions"},
                      {"unit", unit}};
    if (non_associated)
      topics["non_associated"] = {{"upper_is_certified", true},
                                  {"lower_is_certified", false},
                                  {"davis", davis}};
    topics["cost"] = {{"total_s", total.wall_time()},
                      {"cpu_s", total.cpu_time()}};
    limit_output.write_summary(status, levels, topics);
  }

  void
  LimitAnalysis::finish(const double)
  {
    const Bracket best(levels);
    const auto    gap = best.gap();
    if (!gap)
      log.warn(std::string("not certified: ") +
               (best.lower ? "the upper bound: " + upper.objection
                           : "the lower bound: " + lower.objection));
    else if (!(*gap < gap_tolerance))
      log.warn(format("the gap is %.3g %%, more than 'Analysis/Gap tolerance'; "
                      "raise 'Analysis/Maximum cells' or 'Maximum levels'",
                      100. * *gap));
    if (non_associated)
      {
        davis = davis_estimate();
        log.print(format(
          "flow is not associated: the upper bound holds for any dilatancy "
          "(Radenkovic 1961), the lower one for theta = phi only; Davis's "
          "estimate (1968), which is no bound: %.6g to %.6g %s",
          davis["lower"].get<double>(),
          davis["upper"].get<double>(),
          unit.c_str()));
      }
    write_summary("finished");
    if (gap)
      log.print(format("%.6g <= load <= %.6g", *best.lower, *best.upper) +
                (factor == LoadFactor::velocity ? " " + unit : "") +
                format(", certified; middle %.6g, gap %.3g %%",
                       (*best.lower + *best.upper) / 2.,
                       100. * *gap));
    limit_output.report();
  }

  void
  LimitAnalysis::save(Archive &archive)
  {
    StateRow     row;
    unsigned int n_levels = levels.size();
    row(n_levels);
    for (BoundLevel &level : levels)
      level.state(row);
    archive.write_row("levels", row);
    std::vector<double> numbers;
    if (sizes)
      for (std::size_t i = 0; i < sizes->triangles.size(); ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            for (unsigned int d = 0; d < dim; ++d)
              numbers.push_back(sizes->triangles[i][j][d]);
            numbers.push_back(sizes->sizes[i][j]);
          }
    archive.write("sizes", numbers);
  }

  void
  LimitAnalysis::load(const Archive &archive)
  {
    StateRow     row      = archive.read_row("levels");
    unsigned int n_levels = 0;
    row(n_levels);
    levels.resize(n_levels);
    for (BoundLevel &level : levels)
      level.state(row);
    const std::vector<double> numbers = archive.read("sizes");
    sizes.reset();
    if (!numbers.empty())
      sizes.emplace();
    for (std::size_t i = 0; i + 9 <= numbers.size(); i += 9)
      {
        sizes->triangles.emplace_back();
        sizes->sizes.emplace_back();
        for (unsigned int j = 0; j < 3; ++j)
          {
            for (unsigned int d = 0; d < dim; ++d)
              sizes->triangles.back()[j][d] = numbers[i + 3 * j + d];
            sizes->sizes.back()[j] = numbers[i + 3 * j + dim];
          }
      }
  }
} // namespace geocone
