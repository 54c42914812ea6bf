// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/number_in.h>
#include <geocone/conditions/mesh_coverage.h>
#include <geocone/points/initial_overstress.h>
#include <geocone/run/implicit_simulation.h>
#include <geocone/run/run_estimate.h>
#include <geocone/scene/magnitudes.h>
#include <geocone/scene/small_motion.h>
#include <geocone/seepage/flow_on_mesh.h>
#include <geocone/terms/bars.h>

#include <algorithm>
#include <fstream>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Refuses the state of a run in other units, and one that keeps other
     *  parameters in its points than those of this run.
     *  @param moves with particles, which keep their mass and what depends on
     *  their first place */
    void
    check_start(const std::string &folder,
                const Materials   &materials,
                const bool         moves)
    {
      const std::string file = folder + "/parameters.prm";
      if (!std::ifstream(file)) // what reads the state says what is missing
        return;
      const ParameterFile theirs(file, {});
      const std::string   units   = ParameterFile::value("Analysis/Units"),
                        its_units = theirs.peek("Analysis/Units", "SI");
      if (its_units != units)
        throw InputError("Initial stress/Run",
                         folder,
                         "a run with 'Analysis/Units' = " + units,
                         "its stresses have those of " + its_units +
                           ": write both parameter files in the same units");
      const auto names_in = [](const std::string &list) {
        return dealii::Utilities::split_string_list(list);
      };
      const std::vector<std::string> installed =
        names_in(theirs.peek("Structures/Names", ""));
      for (const std::string &name :
           names_in(ParameterFile::value("Structures/Names")))
        if (std::count(installed.begin(), installed.end(), name) > 0)
          throw InputError("Initial stress/Run",
                           folder,
                           "a run without the structure '" + name + "'",
                           "its forces there are not known here: compute the "
                           "earlier stages in the same run");
      std::vector<std::string> kept = {"Cohesion ratio"};
      if (moves)
        kept.insert(kept.end(),
                    {"Density",
                     "Unit weight",
                     "Saturated unit weight",
                     "Cohesion formula",
                     "Cohesion gradient",
                     "Cohesion level",
                     "Young modulus formula"});
      for (const std::string &name : materials.names())
        for (const std::string &entry : kept)
          {
            const std::string path = "Materials/" + name + "/" + entry,
                              ours = ParameterFile::value(path),
                              its  = theirs.peek(path, ours);
            if (ours != its && (!number_in(ours) || !number_in(its) ||
                                *number_in(ours) != *number_in(its)))
              throw InputError(path,
                               ours,
                               its + ", as in 'Initial stress/Run' = " + folder,
                               "points keep it from there: change it in that "
                               "run, too, and run it again");
          }
    }

    void
    remove_empty(std::vector<std::string> &texts)
    {
      texts.erase(std::remove(texts.begin(), texts.end(), ""), texts.end());
    }

    BoundingBox<dim>
    box_of_body(const Scene &scene, const BackgroundMesh &mesh)
    {
      return scene.geometry.shape == Geometry::Shape::file
               ? mesh.bounding_box()
               : scene.geometry.bounding_box();
    }

    /** Whether a material of low dilatancy has nu > 0.49. */
    bool
    is_nearly_incompressible(const Materials &materials)
    {
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (const Elasticity &elastic = materials[m].elasticity();
            materials[m].non_associativity() >
              Material::strong_non_associativity &&
            elastic.normal_stiffness() >
              50. * elastic.stiffness()(2, 2)) // 1/(1 - 2 nu)
          return true;
      return false;
    }

    /** @throws InputError for states that do not hold excess pore pressures */
    void
    refuse_beside_consolidation(const StartOfRun &start, const Freezer &freezer)
    {
      if (!start.folder.empty())
        throw InputError("Initial stress/Run",
                         start.folder,
                         "empty with 'Time stepping/Consolidation'",
                         "compute the earlier stages in the same run");
      if (freezer.is_used())
        throw InputError(
          "Output/Freeze steps",
          "steps or failures",
          "none with 'Time stepping/Consolidation'",
          "leave 'Output/Freeze steps' and 'Freeze failures' out");
    }

    /** Effect of friction with memory on the steps, for the estimate.
     *  @throws InputError if there are too many substeps */
    std::string
    text_of_memory(const Scene &scene)
    {
      const double tau = scene.materials.traits().friction_memory;
      if (!std::isfinite(tau))
        return "";
      double longest = 0.;
      for (const auto &stage : scene.loading.list)
        for (const double size : stage->step_sizes())
          longest = std::max(longest, size);
      constexpr double most = 1e4;
      for (unsigned int i = 0; i < scene.materials.size(); ++i)
        if (const double own = scene.materials[i].friction_memory();
            own > 0. && 2. * longest / own > most)
          throw InputError(
            "Materials/" + scene.materials.name(i) + "/Friction memory",
            own,
            format("0 | automatic | at least %.3g s, so that steps of %.3g s "
                   "have at most %.0f substeps",
                   2. * longest / most,
                   longest,
                   most),
            "0 is the exact law; or take a longer memory, or shorter steps");
      return format(
        "friction has a memory of %.3g s, substeps at most half of it", tau);
    }
  } // namespace

  StartOfRun::StartOfRun()
    : ParameterAcceptor("/Initial stress")
  {
    add_parameter(
      "Run",
      folder,
      "FEM and MPM: folder of another run with a checkpoint ('Checkpoint/Every "
      "steps'), the same mesh and the same materials in the same order (their "
      "parameters may differ). Positions, stresses and histories of the points "
      "are those of its last checkpoint, at rest, instead of 'Type'. Boundary "
      "conditions and loads are those of this file.");
  }

  std::string
  ImplicitSimulation::prepare_mesh(const RunOptions &options)
  {
    std::string remark;
    Seeding    *seeding = method.is_mpm() ? &implicit_mpm.seeding() : nullptr;
    const auto  check_size = [&]() {
      const RunEstimate estimate = estimate_run(scene,
                                                method,
                                                mesh,
                                                seeding,
                                                run_output.fields_asked(),
                                                &newton.linear_solver());
      log.print(options.name + ": " + estimate.text());
      estimate.check(options.force);
    };
    if (!scene.geometry.is_script())
      check_size();
    mesh.take_sizes(
      [&](const MeshParameters &parameters) {
        scene.materials.refuse_undrained(
          "Mesh/Type = from the bounds",
          "bounds are those of drained strength: take another mesh");
        scene.structures.refuse(
          "'Mesh/Type' = from the bounds",
          "bounds do not support them: take another mesh");
        scene.dirichlet.refuse_stages(
          "'Mesh/Type' = from the bounds",
          "bounds have no stages: take another mesh");
        auto [sizes, bracket] = sizes_of_scene(parameters, scene, comm, log);
        if (scene.loading.reduces_strength())
          bracket.name = "the factor of all loads at full strength";
        if (bracket.other_than_observed.empty())
          run_output.set_bracket(bracket);
        else
          remark = "the bounds of the mesh are not reported: " +
                   bracket.other_than_observed;
        return sizes;
      },
      scene,
      method);
    mesh.prepare(scene, method, !method.is_mpm() && !space.is_spline());
    if (scene.geometry.is_script())
      check_size();
    return remark;
  }

  void
  ImplicitSimulation::remember_friction()
  {
    // The exact law is easy with particles unless the soil is nearly incompressible.
    if ((!method.is_mpm() || is_nearly_incompressible(scene.materials)) &&
        !newton.wants_exact_friction() &&
        scene.materials.traits().strongly_non_associated)
      scene.materials.set_friction_memory(time_of_small_motion(
        scene, mesh.bounding_box(), [&](const BoundaryCondition &condition) {
          return mesh.faces_of(condition);
        }));
  }

  std::vector<std::string>
  ImplicitSimulation::warn_of_scene() const
  {
    std::vector<std::string> warnings;
    const auto               add = [&](const std::vector<std::string> &more) {
      warnings.insert(warnings.end(), more.begin(), more.end());
    };
    add(warn_of_partial_coverage(scene, mesh, space));
    if (!method.is_mpm())
      {
        add(warn_of_cut_cells(scene, mesh));
        add(warn_of_held_tractions(scene, mesh, space));
      }
    add(warn_of_fixed_ends(scene.structures, mesh));
    warnings.push_back(warn_of_steep_water(scene, mesh));
    warnings.push_back(warn_of_overstress(points, scene.materials, comm));
    LawTraits traits = scene.materials.traits();
    // The remedies of undrained soil are refused.
    traits.undrained = traits.undrained && !stepper->consolidates();
    if (stepper->consolidates() && !mesh.is_simplicial() &&
        !space.has_b_bar() && traits.can_yield && !traits.frictionless)
      warnings.push_back(
        "volume changes within cells of " + space.element() +
        " where soil hardly drains: loads of soil with friction came out 19 % "
        "too high and more; set Discretisation/B-bar = true, or take "
        "triangles");
    add(space.warnings(traits, method));
    warnings.push_back(scene.warn_of_effective_loads());
    if (!stepper->consolidates()) // soil that does not drain
      add(scene.materials.warnings());
    return warnings;
  }

  std::vector<std::string>
  ImplicitSimulation::prepare_method(const RunOptions &options)
  {
    scene.materials.check_closed_form(method.name());
    if (scene.loading.reduces_strength())
      scene.materials.reduce_strength(1.);
    for (const auto &stage : scene.loading.list)
      stage->check_implicit();
    newton.prepare();
    step_control.prepare();
    exact_solution.prepare();
    if (dim == 3 && method.is_mpm())
      scene.water.seepage.refuse("particles in three dimensions",
                                 "set Discretisation/Method = FEM, or give "
                                 "the pressures by 'Water/Table'");
    if (dim == 2)
      let_water_flow(scene, comm, log, options.dry_run);
    const std::string remark_on_bounds = prepare_mesh(options);
    if (dim == 3)
      let_water_flow(
        scene, comm, log, options.dry_run, 0., &mesh.mesh_parameters());
    remember_friction();
    step_control.limit(scene.materials.traits().friction_memory);
    if (const std::string text = text_of_memory(scene); !text.empty())
      log.print(options.name + ": " + text);
    space.prepare(
      mesh, method, scene.materials.traits().strongly_non_associated);
    if (method.is_mpm())
      stepper = &implicit_mpm;
    else
      stepper = &implicit_fem;
    std::vector<std::string> warnings = {
      stepper->prepare(scene, mesh, space, newton, timer, kinematics, points)};
    if (stepper->consolidates())
      refuse_beside_consolidation(start_of_run, freezer);
    if (!start_of_run.folder.empty() && !options.resumes)
      {
        check_start(start_of_run.folder, scene.materials, method.is_mpm());
        checkpoint.read(
          start_of_run.folder,
          log,
          [&](const Archive &archive) {
            stepper->begin_from(archive, kinematics, points);
            return std::string();
          },
          "Initial stress/Run");
        if (!method.is_mpm()) // the strength and stiffness of each place
          for (unsigned int p = 0; p < points.n_points(); ++p)
            scene.materials.law(points.material[p])
              .initialise_at(points.position[p], points.history_of(p));
      }
    warnings.push_back(remark_on_bounds);
    warnings.push_back(scene.warn_of_time_histories());
    const BoundingBox<dim> body = box_of_body(scene, mesh);
    log.print(options.name + ": " + text_of_magnitudes(scene, body));
    for (const auto &more : {warn_of_magnitudes(scene, body), warn_of_scene()})
      warnings.insert(warnings.end(), more.begin(), more.end());
    remove_empty(warnings);
    if (method.is_mpm())
      observed_points.prepare_points(scene, points, comm);
    else
      observed_points.prepare_field(scene, mesh, space);
    freezer.check(scene);
    return warnings;
  }
} // namespace geocone::GEOCONE_DIM
