// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/implicit/implicit_fem.h>
#include <geocone/materials/retention.h>
#include <geocone/points/point_record.h>
#include <geocone/points/quadrature_points.h>
#include <geocone/space/vertex_interpolation.h>
#include <geocone/time_stepping/check_removal.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::TimerOutput;

  namespace
  {
    const UsedWhere used_implicit_fem[] = {
      {"Time stepping/Inertia", "Discretisation/Method", {"FEM"}}};
  } // namespace

  namespace
  {
    /** @throws InputError if a stage removes none or all of the cells present,
     *  which are fixed */
    void
    check_removals(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const MPI_Comm        comm)
    {
      std::vector<BackgroundMesh::Cell> cells;
      std::vector<bool>                 is_there;
      for (const BackgroundMesh::Cell &cell : mesh.own_cells())
        {
          cells.push_back(cell);
          is_there.push_back(
            !scene.loading.adds(scene.materials.name(cell->material_id())));
        }
      for (const auto &stage : scene.loading.list)
        {
          unsigned int n_removed = 0, n_all = 0;
          for (unsigned int c = 0; c < cells.size(); ++c)
            if (is_there[c])
              {
                ++n_all;
                if (stage->removes(cells[c]->center()))
                  {
                    ++n_removed;
                    is_there[c] = false;
                  }
              }
          if (stage->removes())
            check_removal(*stage,
                          dealii::Utilities::MPI::sum(n_removed, comm),
                          dealii::Utilities::MPI::sum(n_all, comm),
                          "cells");
          for (const std::string &material : stage->added_materials)
            for (unsigned int c = 0; c < cells.size(); ++c)
              if (scene.materials.name(cells[c]->material_id()) == material)
                is_there[c] = true;
        }
    }
  } // namespace

  ImplicitFEM::ImplicitFEM()
    : ImplicitStepper("commit")
    , dealii::ParameterAcceptor("/Time stepping")
  {
    add_parameter("Inertia",
                  inertia,
                  "Whether inertia is included. false: quasi-static; the "
                  "density enters only the weight. true: lumped mass (row "
                  "sums; for P2 the scaled diagonal).");
    integration.declare(
      *this,
      ". Time integration of FEM with inertia. The midpoint rule and Newmark's "
      "average acceleration are second-order accurate and conserve the energy "
      "of elastic motion, without damping waves.");
  }

  std::string
  ImplicitFEM::prepare(const Scene           &scene_,
                       BackgroundMesh        &mesh_,
                       Space                 &space_,
                       const NonsmoothNewton &newton,
                       TimerOutput           &timer,
                       Kinematics            &kinematics,
                       MaterialPoints        &points)
  {
    scene = &scene_;
    mesh  = &mesh_;
    space = &space_;
    check_scene(newton.linear_solver());
    if (!scene->structures.list.empty())
      bars = std::make_unique<Bars>(scene->structures, mesh_, space_);
    points = make_quadrature_points(*scene, mesh_, space_);
    if (scene->loading.changes_body())
      {
        scene->contacts.refuse("stages that remove or add material, with FEM",
                               "let one of the bodies be an obstacle, or set "
                               "Discretisation/Method = MPM");
        points = quadrature_points_of(
          *scene, mesh_, space_, {}, [&](const BackgroundMesh::Cell &cell) {
            return !scene->loading.adds(
              scene->materials.name(cell->material_id()));
          });
      }
    check_removals(*scene, mesh_, mesh_.triangulation().get_communicator());
    const std::string &first_stage = scene->loading.list.front()->name;
    constraints =
      std::make_unique<Constraints>(*scene, mesh_, space_, first_stage);
    obstacles = std::make_unique<ObstacleContact>(
      *scene, mesh_, space_, constraints.get());
    kinematics.velocity.reinit(space_.partitioner());
    kinematics.displacement.reinit(space_.partitioner());
    kinematics.supports.resize(scene->supports().size());
    for (unsigned int node = 0; node < space_.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        kinematics.velocity.local_element(dim * node + c) =
          scene->initial_velocity.at(space_.node_positions()[node])[c];

    std::shared_ptr<VertexInterpolation> vertices;
    if (has_vertex_interpolation(space_) &&
        newton.linear_solver().selects_p_multigrid(
          dim == 3 && !obstacles->exists() ? dim * space_.n_nodes() : 0))
      vertices = std::make_shared<VertexInterpolation>(
        interpolation_from_vertices(mesh_, space_));
    system =
      std::make_unique<LinearSystem>(newton.linear_solver(),
                                     mesh_.triangulation().get_communicator(),
                                     scene->materials.traits().symmetric &&
                                       !obstacles->exists() && !drainage.acts,
                                     vertices);
    begin(points, timer);
    unknowns = constraints->n_rows;
    constraints->check_axis(mesh_, space_);
    check_resistance(points, mesh_.triangulation().get_communicator());
    newton.check(*problem);
    check_stages(points);
    const std::string warning = constraints->warn_of_nonlinear_values();
    begin_stage(*scene->loading.list.front());
    if (!begun)
      begin(points, timer);
    return warning;
  }

  void
  ImplicitFEM::check_scene(const LinearSolverParameters &linear_solver) const
  {
    for (const auto &condition : scene->dirichlet.list)
      if (condition->moves_with_body())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposition.word(),
                         "nodes with FEM",
                         "impose it on nodes, or set Discretisation/Method = "
                         "MPM");
    if (!integration.is_backward_euler() && !inertia)
      throw InputError("Time stepping/Integration",
                       integration.word(),
                       "backward Euler without inertia",
                       "set Time stepping/Inertia = true: without it there is "
                       "nothing to be kept");
    if (!inertia)
      scene->absorbing.refuse(
        "Time stepping/Inertia = false",
        "set it to true: without inertia there are no waves");
    if (scene->initial_velocity.is_given() && !inertia)
      throw InputError("Initial velocity/Velocity x",
                       "a formula",
                       "0 without inertia",
                       "set Time stepping/Inertia = true");
    if (!scene->structures.list.empty())
      {
        const std::string what = "structures";
        scene->refuse_contact(what, "leave out 'Structures/Names'");
        if (!integration.is_backward_euler())
          throw InputError("Time stepping/Integration",
                           integration.word(),
                           "backward Euler with structures",
                           "take it, or leave out 'Structures/Names'");
      }
    ScaledLoads::check(*scene);
    if (drainage.acts)
      check_consolidation(linear_solver);
    check_axisymmetric_body(*scene);
    integration.check(*scene, "Time stepping/");
  }

  void
  ImplicitFEM::check_stages(const MaterialPoints &points)
  {
    Vector v     = problem->make_vector();
    double start = 0.;
    for (const auto &stage : scene->loading.list)
      {
        if (constraints->begin_stage(*mesh, stage->name) && !inertia &&
            !obstacles->exists() && !scene->loading.changes_body())
          try
            {
              constraints->check_support(*mesh, *space, points);
            }
          catch (const InputError &error)
            {
              throw InputError(error.what() +
                               std::string("\n  in:      the stage '") +
                               stage->name + "'");
            }
        constraints->set_values(v, start + 1e-6 * stage->duration);
        start += stage->duration;
      }
  }

  void
  ImplicitFEM::begin(MaterialPoints &points, TimerOutput &timer)
  {
    if (scene->loading.changes_body() || space->has_ties())
      {
        Vector n_cells(space->partitioner()); // number of cells per node
        for (const unsigned int node : points.nodes)
          for (unsigned int d = 0; d < dim; ++d)
            n_cells.local_element(dim * node + d) += 1.;
        n_cells.compress(dealii::VectorOperation::add);
        n_cells.update_ghost_values();
        constraints->number_unknowns(&n_cells);
      }
    else
      constraints->number_unknowns(nullptr);
    // Whether obstacles support the body is unknown before contact.
    if (!inertia && !obstacles->exists())
      constraints->check_support(*mesh, *space, points);
    obstacles->set_body_cells(points.cells);
    loads = std::make_unique<Loads>(*scene, *mesh, *space, points);
    absorbing =
      std::make_unique<AbsorbingBoundary>(*scene, *mesh, *space, &points);
    absorbing->check(*constraints);
    if (inertia || scene->gravity.acts())
      integrate_density(
        *scene, *mesh, *space, points, weight_per_g, lumped_mass);
    if (has_force())
      force.reinit(space->partitioner());
    problem = std::make_unique<IncrementalProblem>(
      points,
      scene->materials,
      *constraints,
      space->partitioner(),
      inertia ? &integration.mass_of_problem(lumped_mass) : nullptr,
      0.,
      std::vector<GhostStencil>(),
      obstacles->exists());
    if (absorbing->exists())
      problem->add(*absorbing);
    if (bars)
      problem->add(*bars);
    if constexpr (dim == 2)
      if (drainage.acts)
        add_flow(points,
                 pressures_of_elements(
                   *scene, *mesh, *space, points, drained_nodes()));
    system->set_pattern(*problem, timer);
    has_pattern = begun = true;
  }

  void
  ImplicitFEM::evaluate_force(Vector &dst,
                              const MaterialPoints & /* points */,
                              const double t,
                              const Stage *stage,
                              const bool   scaled)
  {
    loads->evaluate(dst, weight_per_g, t, stage, scaled);
  }

  void
  ImplicitFEM::take_cells(const std::vector<bool> &is_there,
                          MaterialPoints          &points) const
  {
    points = quadrature_points_of(*scene,
                                  *mesh,
                                  *space,
                                  std::move(points),
                                  [&](const BackgroundMesh::Cell &cell) {
                                    return is_there[cell->active_cell_index()];
                                  });
  }

  void
  ImplicitFEM::remove(const Stage              &stage,
                      MaterialPoints           &points,
                      std::vector<std::string> &remarks)
  {
    const MPI_Comm    comm     = mesh->triangulation().get_communicator();
    std::vector<bool> is_there = mesh->marked_cells(points.cells);
    unsigned int      n        = 0;
    for (const BackgroundMesh::Cell &cell : points.cells)
      if (stage.removes(cell->center()))
        {
          is_there[cell->active_cell_index()] = false;
          ++n;
        }
    remarks.push_back(
      stage.removal_text(dealii::Utilities::MPI::sum(n, comm),
                         dealii::Utilities::MPI::sum(points.n_cells(), comm),
                         "cells"));
    take_cells(is_there, points);
  }

  void
  ImplicitFEM::add(const Stage    &stage,
                   MaterialPoints &points,
                   BodyChange     &change)
  {
    std::vector<bool> is_there = mesh->marked_cells(points.cells);
    for (const std::string &material : stage.added_materials)
      {
        unsigned int n = 0;
        for (const BackgroundMesh::Cell &cell : mesh->own_cells())
          if (scene->materials.name(cell->material_id()) == material)
            {
              is_there[cell->active_cell_index()] = true;
              ++n;
            }
        change.remarks.push_back(
          format("added %u cells of the material '",
                 dealii::Utilities::MPI::sum(
                   n, mesh->triangulation().get_communicator())) +
          material + "'");
      }
    take_cells(is_there, points);
  }

  void
  ImplicitFEM::change_nodes(const std::vector<bool> &had_mass,
                            Kinematics              &kinematics,
                            Vector                  &difference) const
  {
    // Nodes without cells are at rest; displacements of new nodes start at zero.
    for (unsigned int i = 0; i < difference.locally_owned_size(); ++i)
      if (!constraints->has_mass(i) || !had_mass[i])
        {
          kinematics.velocity.local_element(i) = 0.;
          if (constraints->has_mass(i))
            kinematics.displacement.local_element(i) = 0.;
          else
            difference.local_element(i) = 0.;
        }
  }

  void
  ImplicitFEM::check_resistance(const MaterialPoints &points,
                                const MPI_Comm        comm) const
  {
    bool resists = inertia || loads->exist();
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      {
        const auto cone = scene->materials[m].initial_cone();
        resists         = resists || !cone || cone->k > 0.;
      }
    for (const Mandel &stress : points.stress)
      resists = resists || stress.norm() > 0.;
    if (dealii::Utilities::MPI::max(int(resists), comm) == 0)
      throw InputError(
        "Materials/" + scene->materials.name(0) + "/Cohesion",
        0,
        "> 0 Pa where there is no weight, load, initial stress or inertia",
        "nothing resists in this scene: give the soil cohesion, or a load, or "
        "set Time stepping/Inertia = true for a free flow");
  }

  Energies
  ImplicitFEM::state_energies(const Kinematics     &kinematics,
                              const MaterialPoints &points,
                              const double) const
  {
    const MPI_Comm comm = kinematics.velocity.get_mpi_communicator();
    Energies       e;
    if (inertia)
      for (unsigned int i = 0; i < lumped_mass.locally_owned_size(); ++i)
        {
          const double v = kinematics.velocity.local_element(i);
          e.kinetic += lumped_mass.local_element(i) * v * v / 2.;
        }
    e.kinetic = dealii::Utilities::MPI::sum(e.kinetic, comm);
    e.elastic = elastic_energy(points, scene->materials, comm);
    return e;
  }

  void
  ImplicitFEM::begin_motion(const TimeStep & /* step */,
                            const Kinematics &kinematics,
                            const MaterialPoints & /* points */,
                            const Vector & /* prescribed */)
  {
    if (scene->loading.scales_loads())
      constraints->multipliers.clear();
    velocity_L = kinematics.velocity;
    constraints->turn(velocity_L);
  }

  ContactStep
  ImplicitFEM::find_contact(const TimeStep   &step,
                            const Kinematics &kinematics,
                            const MaterialPoints & /* points */)
  {
    kinematics.velocity.update_ghost_values();
    ContactStep touching =
      obstacles->begin(kinematics.velocity, step.t, step.h, step.solved_h);
    kinematics.velocity.zero_out_ghost_values();
    return touching;
  }

  SolverReport
  ImplicitFEM::solve(const TimeStep & /* step */,
                     const Kinematics & /* kinematics */,
                     const Solving &with,
                     Vector        &v,
                     Vector        &residual)
  {
    v = start_velocity();
    const SolverReport report =
      with.newton.solve(*problem,
                        *system,
                        with.timer,
                        v,
                        residual,
                        {false, with.accepted_excess});
    with.freezer.take(*problem, start_velocity(), false, report.converged);
    return report;
  }

  double
  ImplicitFEM::update_points(const TimeStep &step, MaterialPoints &points)
  {
    const std::vector<EndOfStep> ends =
      end_step(step, problem->internal_forces(), scene->materials, points);
    double dissipation = 0.;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const EndOfStep &end = ends[p];
        dissipation += points.weight[p] * end.dissipation;
        points.stress[p] = end.stress;
        points.plastic_strain[p] += end.plastic;
        points.cumulative_plastic_strain[p] += end.slip;
        points.plastic_strain_rate[p] = end.slip / step.h;
      }
    return dealii::Utilities::MPI::sum(dissipation,
                                       velocity_L.get_mpi_communicator());
  }

  double
  ImplicitFEM::update_nodes(const TimeStep &step,
                            const Vector   &v_end,
                            const Vector   &v,
                            Kinematics     &kinematics)
  {
    kinematics.velocity = v_end;
    double settled      = 0.;
    if (step.extrapolation != 1. && obstacles->exists())
      settled = obstacles->settle(
        problem->contact(), *constraints, v, lumped_mass, kinematics.velocity);
    kinematics.displacement.add(step.h, v);
    return settled;
  }

  void
  ImplicitFEM::save(Archive &archive, const MaterialPoints &points)
  {
    save_points(archive, points);
    if (scene->loading.changes_body())
      ramped.save(archive, *mesh, *space);
    if (bars)
      {
        StateRow forces;
        bars->state(forces);
        archive.write_row("bars", forces);
      }
    if (obstacles->exists())
      {
        StateRow moved;
        obstacles->state(moved);
        archive.write_row("obstacles", moved);
        save_nodes(
          archive, "path", *mesh, *space, obstacles->displacement_of_nodes());
        if (obstacles->has_bonds())
          save_nodes(
            archive, "bonds", *mesh, *space, obstacles->bonds_of_nodes());
      }
  }

  void
  ImplicitFEM::load(const Archive &archive, MaterialPoints &points)
  {
    take_points(archive, points);
    if (scene->loading.changes_body())
      ramped.load(archive, *mesh, *space);
    if (bars)
      {
        StateRow forces = archive.read_row("bars");
        bars->state(forces);
      }
    if (obstacles->exists())
      {
        StateRow moved = archive.read_row("obstacles");
        obstacles->state(moved);
        load_nodes(
          archive, "path", *mesh, *space, obstacles->displacement_of_nodes());
        obstacles->displacement_of_nodes().update_ghost_values();
        if (obstacles->has_bonds())
          {
            load_nodes(
              archive, "bonds", *mesh, *space, obstacles->bonds_of_nodes());
            obstacles->bonds_of_nodes().update_ghost_values();
          }
      }
  }

  void
  ImplicitFEM::take_points(const Archive &archive, MaterialPoints &points)
  {
    const PointRecord record(archive, points);
    const bool        has_all =
      std::all_of(points.cells.begin(),
                  points.cells.end(),
                  [&](const auto &cell) { return record.has(cell); });
    const bool is_other_body = dealii::Utilities::MPI::logical_or(
      scene->loading.changes_body() || !has_all,
      velocity_L.get_mpi_communicator());
    if (is_other_body)
      {
        points = quadrature_points_of(
          *scene, *mesh, *space, {}, [&](const BackgroundMesh::Cell &cell) {
            return record.has(cell);
          });
        begun = false;
      }
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const auto   rows  = record.of(points.cells[c]);
        unsigned int first = points.first_point[c];
        if (rows.size() != points.first_point[c + 1] - first)
          throw RunError("the checkpoint has other points");
        for (const double *row : rows)
          points.set(first++, row);
      }
  }
} // namespace geocone::GEOCONE_DIM
