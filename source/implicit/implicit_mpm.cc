// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/implicit/implicit_mpm.h>
#include <geocone/implicit/particle_checks.h>
#include <geocone/materials/retention.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/time_stepping/check_removal.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  std::string
  ImplicitMPM::prepare(const Scene           &scene_,
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
      bars = std::make_unique<Bars>(scene->structures, *mesh, *space);
    std::string warning = particles.prepare(*scene, *mesh, *space, points);
    const auto  warn    = [&](const std::string &text) {
      if (!text.empty())
        warning += (warning.empty() ? "" : "; ") + text;
    };
    if (!integration.is_backward_euler() &&
        advection == Advection::particle_velocity)
      warn(
        "Integration = " + integration.word() +
        " with Advection = particle velocity lets the total energy grow where "
        "particles and nodes move differently: take the grid velocity");
    if (advection != Advection::none)
      {
        const unsigned int k = points_per_direction(
          points, mesh->triangulation().get_communicator());
        if (space->is_spline())
          warn(check_width_of_body(*mesh, *space, k, points));
        warn(check_tractions(k));
      }
    if (drainage.acts && scene->water.acts())
      check_water_at_rest(
        *scene, points, mesh->triangulation().get_communicator());
    present_stage = scene->loading.list.front()->name;
    datum         = mesh->lower_corner();
    if (is_unbalanced(points))
      redistribute(points);
    set_up(newton);
    check_contact(points);
    if (!grid_follows.empty())
      begin_to_follow();
    if (rule.is_affine())
      for (unsigned int p = 0; p < points.n_points(); ++p)
        points.affine[p] = scene->initial_velocity.gradient(
          points.position[p],
          scene->geometry.size_of_point(points.position[p], points.volume[p]));
    begin(points, timer);
    unknowns = constraints->n_rows;
    if (bodies)
      bodies->check_start(points, *constraints);
    constraints->check_axis(*mesh, *space);
    moving->check_held_particles(points);
    if (const Stage &first = *scene->loading.list.front(); first.removes())
      {
        const MPI_Comm comm = mesh->triangulation().get_communicator();
        check_removal(
          first,
          Utilities::MPI::sum(std::count_if(points.position.begin(),
                                            points.position.end(),
                                            [&](const Point<dim> &x) {
                                              return first.removes(x);
                                            }),
                              comm),
          Utilities::MPI::sum(points.n_points(), comm),
          "points");
      }
    Vector v = problem->make_vector();
    constraints->set_values(v, 0.);
    // Rejects inadmissible conditions before the run.
    moving->make_rows(
      points, v, 0., {velocity_L, rule.flip_part(), 1., 0.}, *constraints);
    newton.check(*problem);
    kinematics.velocity = velocity_L;
    kinematics.supports.resize(scene->supports().size());
    warn(constraints->warn_of_nonlinear_values());
    return warning;
  }

  void
  ImplicitMPM::set_up(const NonsmoothNewton &newton)
  {
    problem.reset(); // refers to data that are replaced
    moving = std::make_unique<MovingConditions>(*scene, *mesh, *space);
    moving->begin_stage(present_stage);
    constraints =
      std::make_unique<Constraints>(*scene, *mesh, *space, present_stage);
    absorbing =
      std::make_unique<AbsorbingBoundary>(*scene, *mesh, *space, nullptr);
    obstacles =
      std::make_unique<ObstacleContact>(*scene, *mesh, *space, nullptr);
    if (!scene->contacts.list.empty())
      bodies.emplace(*scene, *mesh, *space);
    system =
      std::make_unique<LinearSystem>(newton.linear_solver(),
                                     mesh->triangulation().get_communicator(),
                                     scene->materials.traits().symmetric &&
                                       !obstacles->exists() && !drainage.acts);
    force.reinit(space->partitioner());
    if (drainage.acts)
      pore_pressure.reinit(space->partitioner());
    if (space->is_spline() && advection != Advection::none)
      ghost_places.emplace(*mesh, *space);
  }

  void
  ImplicitMPM::begin_stage(const Stage &stage)
  {
    ImplicitStepper::begin_stage(stage);
    if (stage.name != present_stage)
      moving->begin_stage(stage.name);
    present_stage = stage.name;
  }

  bool
  ImplicitMPM::is_unbalanced(const MaterialPoints &points) const
  {
    return balance.is_due(points.n_points(),
                          mesh->triangulation().get_communicator());
  }

  void
  ImplicitMPM::redistribute(MaterialPoints &points)
  {
    std::vector<unsigned int> n_in_cell(mesh->triangulation().n_active_cells());
    for (const unsigned int cell : points.cell)
      ++n_in_cell[cell];
    balance.repartition(std::move(n_in_cell), *mesh, *space);
    particles.follow_ranks(points);
  }

  void
  ImplicitMPM::hand_over_state(const NonsmoothNewton &newton,
                               TimerOutput           &timer,
                               Kinematics            &kinematics,
                               MaterialPoints        &points)
  {
    Archive archive(mesh->triangulation().get_communicator());
    save_nodes(archive, "velocity", *mesh, *space, kinematics.velocity);
    save_grid(archive);
    redistribute(points);
    set_up(newton);
    kinematics.velocity.reinit(space->partitioner());
    velocity_L.reinit(space->partitioner());
    load_nodes(archive, "velocity", *mesh, *space, kinematics.velocity);
    load_grid(archive);
    begin(points, timer);
  }

  void
  ImplicitMPM::begin(MaterialPoints &points, TimerOutput &timer)
  {
    if (Utilities::MPI::sum(points.n_points(), force.get_mpi_communicator()) ==
        0)
      throw StepFailure("all particles have left the background mesh\n"
                        "  remedy:  end the loading earlier, or enlarge "
                        "'Mesh/Box'");
    {
      TimerOutput::Scope scope(timer, "transfer");
      particles.prepare_integration(consistent_integration &&
                                      advection != Advection::none,
                                    moving->soil_boundary(),
                                    points);
      if (nodes_moved)
        constraints =
          std::make_unique<Constraints>(*scene, *mesh, *space, present_stage);
      nodes_moved = false;
      lumped_mass.reinit(space->partitioner());
      velocity_L.reinit(space->partitioner());
      for_each_point(points,
                     [&](const unsigned int p,
                         const unsigned int /* cell */,
                         const PointFunctions &at) {
                       const double m = points.mass[p];
                       double       masses[dim], momentum[dim];
                       for (unsigned int d = 0; d < dim; ++d)
                         {
                           masses[d]   = m;
                           momentum[d] = m * points.velocity[p][d];
                         }
                       at.scatter<dim, false>(masses, lumped_mass.begin());
                       at.scatter<dim, false>(momentum, velocity_L.begin());
                       if (rule.is_affine())
                         at.scatter_affine<dim>(m,
                                                points.affine[p],
                                                points.position[p],
                                                space->node_positions(),
                                                velocity_L.begin());
                     });
      lumped_mass.compress(VectorOperation::add);
      velocity_L.compress(VectorOperation::add);
      lumped_mass.update_ghost_values();
      constraints->number_unknowns(&lumped_mass);
    }
    problem = std::make_unique<IncrementalProblem>(
      points,
      scene->materials,
      *constraints,
      space->partitioner(),
      &integration.mass_of_problem(lumped_mass),
      consistent_mass,
      ghost_stencils(points),
      obstacles->exists());
    {
      TimerOutput::Scope scope(timer, "transfer");
      if (consistent_mass > 0.)
        solve_mass(velocity_L);
      else
        for (unsigned int i = 0; i < velocity_L.locally_owned_size(); ++i)
          velocity_L.local_element(i) =
            constraints->has_mass(i)
              ? velocity_L.local_element(i) / lumped_mass.local_element(i)
              : 0.;
      velocity_L.update_ghost_values();
    }
    if (absorbing->exists())
      problem->add(*absorbing);
    if (bars)
      problem->add(*bars);
    if (drainage.acts)
      add_flow_between(points);
    if (!bodies) // else contacts are not known yet
      system->set_pattern(*problem, timer);
    has_pattern = !bodies;
    begun       = true;
  }

  void
  ImplicitMPM::begin_to_follow()
  {
    if (advection == Advection::none)
      throw InputError(FollowingGrid::parameter,
                       grid_follows,
                       "nothing where particles stay",
                       "leave it out, or let particles move by 'Material point "
                       "method/Advection'");
    if (obstacles->exists() || absorbing->exists())
      throw InputError(FollowingGrid::parameter,
                       grid_follows,
                       "nothing with obstacles, contacts or absorbing sides",
                       "leave it out");
    following.emplace(grid_follows, *scene, *moving, *mesh, *space);
  }

  void
  ImplicitMPM::follow_side()
  {
    following->follow(*moving);
    particles.follow_mesh();
    if (ghost_places)
      ghost_places.emplace(*mesh, *space);
    nodes_moved = true;
  }

  std::vector<GhostStencil>
  ImplicitMPM::ghost_stencils(const MaterialPoints &points)
  {
    if (!ghost_places)
      return {};
    Vector volume(space->partitioner());
    for_each_point(
      points,
      [&](const unsigned int p,
          const unsigned int /* cell */,
          const PointFunctions &at) {
        const double V         = points.volume[p];
        const double both[dim] = {
          V,
          V * elasticity_at_start(scene->materials, points, p).young_modulus()};
        at.scatter<dim, false>(both, volume.begin());
      });
    volume.compress(VectorOperation::add);
    volume.update_ghost_values();
    n_light = ghost_places->n_light(volume, *constraints);
    if (ghost_part == 0.)
      return {};
    std::vector<bool> is_wanted; // empty: all
    if (ghosts == Ghosts::loaded)
      {
        is_wanted = moving->loaded_nodes();
        if (is_wanted.empty())
          return {};
      }
    return ghost_places->stencils(volume, *constraints, is_wanted, ghost_part);
  }

  void
  ImplicitMPM::solve_mass(Vector &velocity) const
  {
    // Conjugate gradients on the nodes with mass; the others stay zero.
    struct Operator
    {
      const IncrementalProblem &problem;
      void
      vmult(Vector &dst, const Vector &src) const
      {
        src.update_ghost_values();
        problem.inertia_term().apply_mass(dst, src);
        src.zero_out_ghost_values();
      }
    };
    struct Diagonal
    {
      const Constraints &constraints;
      const Vector      &mass;
      void
      vmult(Vector &dst, const Vector &src) const
      {
        for (unsigned int i = 0; i < dst.locally_owned_size(); ++i)
          dst.local_element(i) =
            constraints.has_mass(i)
              ? src.local_element(i) / mass.local_element(i)
              : 0.;
      }
    };
    Vector momentum = velocity;
    for (unsigned int i = 0; i < momentum.locally_owned_size(); ++i)
      if (!constraints->has_mass(i))
        momentum.local_element(i) = 0.;
    velocity          = 0.;
    const double norm = momentum.l2_norm();
    if (norm == 0.)
      return;
    SolverControl    control(10000, 1e-13 * norm);
    SolverCG<Vector> cg(control);
    try
      {
        cg.solve(Operator{*problem},
                 velocity,
                 momentum,
                 Diagonal{*constraints, lumped_mass});
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw StepFailure("the consistent mass matrix is singular\n"
                          "  remedy:  set 'Material point method/Consistent "
                          "mass part' to 0.999 or less");
      }
  }

  void
  ImplicitMPM::add_suction(const MaterialPoints      &points,
                           const unsigned int         p,
                           const PointFunctions      &at,
                           const double               part,
                           const std::vector<double> &parts,
                           Vector                    &dst) const
  {
    const Retention &soil =
      scene->materials.law(points.material[p]).retention();
    if (!soil.adds_strength())
      return;
    const Point<dim> &x      = points.position[p];
    double            stress = 0.;
    for (std::size_t line = 0; line < parts.size(); ++line)
      if (parts[line] != 0.)
        stress += parts[line] * scene->water.suction_stress(x, soil, line);
    stress *= part * points.volume[p];
    // The power of chi u is chi u div v.
    std::array<double, (1 + dim) *dim> at_point = {};
    for (unsigned int d = 0; d < dim; ++d)
      at_point[(1 + d) * dim + d] = stress;
    if (mesh->is_axisymmetric())
      at_point[0] = stress / x[0];
    at.scatter<dim, true>(at_point.data(), dst.begin());
  }

  void
  ImplicitMPM::add_water(const MaterialPoints &points,
                         const double          t,
                         Vector               &dst) const
  {
    Vector       of_water(space->partitioner());
    const double part = scene->gravity.at(t)[1] / scene->gravity.at(1e300)[1];
    const std::vector<double> parts = scene->water.interpolation_weights(t);
    for_each_point(points,
                   [&](const unsigned int p,
                       const unsigned int /* cell */,
                       const PointFunctions &at) {
                     Tensor<1, dim> f;
                     for (std::size_t line = 0; line < parts.size(); ++line)
                       if (parts[line] != 0.)
                         f += parts[line] * part * points.volume[p] *
                              scene->water.force(points.position[p], line);
                     if (drainage.acts) // water that has left has no weight
                       f[1] += part * scene->water.weight() *
                               (points.mass[p] /
                                  scene->materials.law(points.material[p])
                                    .saturated_density() -
                                points.volume[p]);
                     at.scatter<dim, false>(f.begin_raw(), of_water.begin());
                     if (scene->water.has_suction())
                       add_suction(points, p, at, part, parts, of_water);
                   });
    of_water.compress(VectorOperation::add);
    dst += of_water;
  }

  void
  ImplicitMPM::evaluate_force(Vector               &dst,
                              const MaterialPoints &points,
                              const double          t,
                              const Stage          *stage,
                              const bool            scaled)
  {
    dst = 0.;
    const bool has_weight =
      stage == nullptr || stage->scales("weight") == scaled;
    const Tensor<1, dim> g =
      has_weight ? scene->gravity.at(t) : Tensor<1, dim>();
    moving->loads().add_forces(dst, nodes_with_mass(), t, stage, scaled);
    if (scene->water.acts() &&
        (scene->water.scales_with_weight() ? has_weight : !scaled))
      add_water(points, t, dst);
    for (unsigned int dof = 0; dof < dst.locally_owned_size(); ++dof)
      dst.local_element(dof) =
        constraints->has_mass(dof)
          ? dst.local_element(dof) +
              g[dof % dim] * lumped_mass.local_element(dof)
          : 0.;
  }

  SolverReport
  ImplicitMPM::solve(const TimeStep   &step,
                     const Kinematics &kinematics,
                     const Solving    &with,
                     Vector           &v,
                     Vector           &residual)
  {
    SolverReport report;
    for (const Start start : starts)
      {
        v = start_velocity();
        if (start == Start::nodes)
          for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
            if (had_mass.empty() || had_mass[i])
              v.local_element(i) = constraints->has_mass(i)
                                     ? kinematics.velocity.local_element(i)
                                     : 0.;
        constraints->set_values(v, step.prescribed_at);
        const Vector v_start = v;
        SolverReport tried =
          with.newton.solve(*problem,
                            *system,
                            with.timer,
                            v,
                            residual,
                            {start == Start::particles, with.accepted_excess});
        tried.add_earlier(report);
        report = std::move(tried);
        with.freezer.take(*problem, v_start, true, report.converged);
        if (report.converged || report.lag_error_too_large)
          break;
      }
    return report;
  }

  void
  ImplicitMPM::begin_motion(const TimeStep &step,
                            const Kinematics & /* kinematics */,
                            const MaterialPoints &points,
                            const Vector         &prescribed)
  {
    moving->make_rows(
      points,
      prescribed,
      step.solved_at,
      {velocity_L, rule.flip_part(), step.solved_h / step.h, step.t + step.h},
      *constraints);
  }

  ContactStep
  ImplicitMPM::find_contact(const TimeStep &step,
                            const Kinematics & /* kinematics */,
                            const MaterialPoints &points)
  {
    return obstacles->begin(
      velocity_L,
      step.t,
      step.h,
      step.solved_h,
      gaps_of_particles(
        points, *scene, obstacles->moved(), *space, obstacles->margin()),
      bodies ? bodies->find(points, *constraints) : std::vector<FacingNode>());
  }

  std::string
  ImplicitMPM::try_move(const TimeStep       &step,
                        const MaterialPoints &points,
                        const Vector         &v_end,
                        const Vector         &v)
  {
    // By the midpoint rule a node that hits rebounds, but its particles share
    // the rebound with others at the start of the next step. Hence contacts
    // come to rest without ObstacleContact::settle, unlike in fixed meshes.
    trial = {};
    trial.share =
      constraints->multipliers.low_mass_share(v, lumped_mass, *space);
    const std::string why_not = rejection(trial.share);
    return why_not.empty() ? transfer(points, v_end, v, step.h) : why_not;
  }

  void
  ImplicitMPM::accept_move(const TimeStep       &step,
                           const MaterialPoints &points,
                           const Vector         &v)
  {
    if (advection == Advection::none)
      return;
    moving->move(nodes_with_mass(), v, step.h, step.solved_at);
    put_points_back(points);
  }

  double
  ImplicitMPM::update_nodes(const TimeStep & /* step */,
                            const Vector & /* v_end */,
                            const Vector &v,
                            Kinematics   &kinematics)
  {
    kinematics.velocity = v;
    had_mass.resize(v.locally_owned_size());
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      had_mass[i] = constraints->has_mass(i);
    return 0.;
  }

  void
  ImplicitMPM::finish(const TimeStep        &step,
                      const NonsmoothNewton &newton,
                      TimerOutput           &timer,
                      Kinematics            &kinematics,
                      MaterialPoints        &points,
                      StepReport            &report)
  {
    TimerOutput::Scope scope(timer, "transfer");
    if (following)
      follow_side();
    const double       t             = step.t + step.h;
    const unsigned int n_lost_before = particles.n_lost();
    Energies           before;
    if (points_may_leave())
      before = state_energies(kinematics, points, t);
    particles.sort(points);
    begun = false;
    if (particles.n_lost() > n_lost_before)
      report.of_lost = before - state_energies(kinematics, points, t);
    const unsigned int n_light_of_step = n_light;
    if (is_unbalanced(points))
      {
        scope.stop(); // the new problem is timed separately
        hand_over_state(newton, timer, kinematics, points);
      }
    report.motion = {n_light_of_step,
                     moving->n_penetrated(points),
                     trial.n_returned,
                     trial.returned_by,
                     trial.share.largest,
                     largest_coordinates(points)};
  }
} // namespace geocone::GEOCONE_DIM
