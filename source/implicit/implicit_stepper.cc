// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/implicit/implicit_stepper.h>

#include <deal.II/base/mpi.h>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;
  using dealii::TimerOutput;

  Vector
  ImplicitStepper::net_force(const MaterialPoints &points, const double t)
  {
    Vector net = problem->make_vector(), of_stress = net;
    evaluate_force(net, points, t);
    problem->internal_forces().forces_at_start(of_stress);
    constraints->turn_back(of_stress);
    net -= of_stress;
    return net;
  }

  void
  ImplicitStepper::begin_stage(const Stage &stage)
  {
    if (constraints->begin_stage(*mesh, stage.name))
      begun = false; // the problem has other unknowns
  }

  BodyChange
  ImplicitStepper::change_body(const Stage    &stage,
                               const double    t,
                               TimerOutput    &timer,
                               Kinematics     &kinematics,
                               MaterialPoints &points)
  {
    begin_stage(stage);
    if (!begun)
      begin(points, timer);
    BodyChange change;
    change.before   = state_energies(kinematics, points, t);
    const auto take = [&](const double duration, const auto &change_points) {
      const std::vector<bool> had_mass   = constraints->with_mass;
      Vector                  difference = net_force(points, t);
      change_points();
      begin(points, timer);
      difference -= net_force(points, t);
      change_nodes(had_mass, kinematics, difference);
      ramped.add(std::move(difference), t, duration);
    };
    if (stage.removes())
      take(stage.removal_duration,
           [&]() { remove(stage, points, change.remarks); });
    if (!stage.added_materials.empty())
      take(stage.addition_duration, [&]() { add(stage, points, change); });
    if (!stage.changed_materials.empty())
      {
        for (const std::string &remark :
             change_materials(stage,
                              *scene,
                              *space,
                              mesh->triangulation().get_communicator(),
                              points))
          change.remarks.push_back(remark);
        begin(points, timer);
      }
    change.after = state_energies(kinematics, points, t);
    return change;
  }

  ScaledLoads
  ImplicitStepper::begin_step(const TimeStep       &step,
                              const Kinematics     &kinematics,
                              const MaterialPoints &points,
                              TimerOutput          &timer)
  {
    const Stage &stage      = scene->loading.stage_at(step.t + step.h / 2.);
    const bool   scales     = stage.scales_loads();
    Vector       prescribed = problem->make_vector();
    ScaledLoads  scaled;
    {
      TimerOutput::Scope scope(timer, section);
      constraints->set_values(prescribed, step.prescribed_at);
      begin_motion(step, kinematics, points, prescribed);
      if (integration.is_newmark())
        {
          Vector net = net_force(points, step.t);
          ramped.add_to(net, step.t);
          constraints->turn(net);
          predicted = velocity_L;
          integration.predict(step, net, lumped_mass, *constraints, predicted);
          predicted.update_ghost_values();
        }
      if (scales)
        {
          Vector of_scaled = problem->make_vector();
          evaluate_force(of_scaled, points, step.solved_at, &stage, true);
          constraints->turn(of_scaled);
          scaled.add_row(stage, of_scaled, prescribed, *constraints);
        }
      if (has_force())
        {
          // At rotated dofs, the vectors of the problem have components along
          // these.
          evaluate_force(
            force, points, step.solved_at, scales ? &stage : nullptr);
          ramped.add_to(force, step.solved_at);
          constraints->turn(force);
        }
    }
    if (absorbing->exists())
      absorbing->begin_step(step.solved_at, *constraints);
    if (bars)
      bars->begin_step(stage.name, step.solved_h, *constraints);
    ContactStep touching;
    if (obstacles->exists())
      touching = find_contact(step, kinematics, points);
    problem->begin_step(step.solved_h,
                        has_force() ? &force : nullptr,
                        start_velocity(),
                        prescribed,
                        std::move(touching));
    if (!has_pattern || problem->needs_pattern())
      system->set_pattern(*problem, timer);
    has_pattern = true;
    return scaled;
  }

  ImplicitStepper::WorksOnNodes
  ImplicitStepper::works_on_nodes(const TimeStep &step,
                                  const Vector   &v,
                                  const Vector   &residual) const
  {
    std::array<double, 2> sums = {}; // of the weight, and the other forces
    const Tensor<1, dim>  g    = gravity_of_potential(step.solved_at);
    const bool            has_weight = g.norm() > 0.;
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      {
        const double weight = has_weight && constraints->has_mass(i)
                                ? g[i % dim] * lumped_mass.local_element(i)
                                : 0.;
        sums[0] += step.h * weight * v.local_element(i);
        if (has_force())
          sums[1] +=
            step.h * (force.local_element(i) - weight) * v.local_element(i);
        if (constraints->is_prescribed(i))
          sums[1] += step.h * residual.local_element(i) * v.local_element(i);
      }
    sum_over_ranks(sums, v.get_mpi_communicator());
    const Multipliers &rows = constraints->multipliers;
    if (rows.n_rows() > 0)
      {
        Eigen::VectorXd lambda = problem->multipliers();
        if (rows.has_loads()) // which are included in the force
          lambda[lambda.size() - 1] = 0.;
        sums[1] += step.h * lambda.dot(rows.multiply(v));
      }
    if (absorbing->exists())
      sums[1] += step.h * absorbing->power(v);
    if (bars)
      sums[1] += step.h * bars->power();
    return {sums[0], sums[1]};
  }

  void
  ImplicitStepper::add_works(const TimeStep       &step,
                             const MaterialPoints &points,
                             const Vector         &v,
                             const Vector         &residual,
                             StepReport           &report) const
  {
    WorksOnNodes work = works_on_nodes(step, v, residual);
    if (obstacles->exists())
      {
        report.contact = obstacles->report(problem->contact(), v, step.h);
        work.of_others += report.contact.work;
      }
    // Work of the ghost stiffness, which exists for material points only, is
    // part of neither energies nor dissipation.
    const double ghost_work =
      has_moving_points() ? problem->ghost_stiffness().work(v) : 0.;
    report.identity_error = energy_identity_error(
      *problem,
      points,
      scene->materials,
      start_velocity(),
      v,
      (work.of_weight + work.of_others) * (step.solved_h / step.h) -
        ghost_work);
    // Dissipation by friction in contact is part of the external work.
    report.works.external =
      external_work(work, step, points) + report.contact.dissipation;
    report.works.ghost_work = (step.h / step.solved_h) * ghost_work;
  }

  std::vector<Reaction>
  ImplicitStepper::support_reactions(const TimeStep       &step,
                                     const MaterialPoints &points,
                                     const Vector         &residual) const
  {
    Vector of_supports = residual;
    if (obstacles->exists())
      ObstacleContact::relieve_supports(
        problem->contact(), *constraints, of_supports);
    return constraints->reactions(of_supports,
                                  points,
                                  *mesh,
                                  problem->internal_forces().total_stress(),
                                  step.solved_at);
  }

  void
  ImplicitStepper::update_supports(const TimeStep        &step,
                                   const Vector          &v,
                                   Kinematics            &kinematics,
                                   std::vector<Reaction> &reactions) const
  {
    if (obstacles->exists())
      {
        for (const Reaction &reaction :
             obstacles->reactions(problem->contact()))
          reactions.push_back(reaction);
        obstacles->add_displacements(problem->contact(),
                                     v,
                                     step.h,
                                     scene->dirichlet.list.size(),
                                     kinematics.supports);
      }
    const Eigen::VectorXd &lambda = problem->multipliers();
    const Multipliers     &rows   = constraints->multipliers;
    for (unsigned int c = 0; c < scene->dirichlet.list.size(); ++c)
      {
        const bool moves = scene->dirichlet.list[c]->moves_with_body();
        if (moves)
          reactions[c].moment =
            rows.moment(lambda, c, constraints->centre(c), *space);
        for (unsigned int d = 0; d < dim; ++d)
          {
            kinematics.supports[c][d] +=
              step.h *
              (moves ? rows.mean_target(c, d) : constraints->mean(v, c, d));
            if (moves)
              reactions[c].force[d] = rows.resultant(lambda, c, d);
          }
      }
  }

  StepReport
  ImplicitStepper::advance(Kinematics            &kinematics,
                           MaterialPoints        &points,
                           const NonsmoothNewton &newton,
                           Freezer               &freezer,
                           TimerOutput           &timer,
                           const double           t,
                           const double           h,
                           const double           accepted_excess)
  {
    begin_stage(scene->loading.stage_at(t + h / 2.));
    if (!begun)
      begin(points, timer);
    const TimeStep    step   = integration.step(t, h);
    const ScaledLoads scaled = begin_step(step, kinematics, points, timer);
    StepReport        report;
    report.unknowns = unknowns =
      constraints->n_rows + (flow ? flow->n_rows() : 0);
    report.multipliers         = constraints->multipliers.n_rows();
    report.rows                = constraints->multipliers.n_given();
    Vector v = problem->make_vector(), residual = v;
    report.newton = solve(
      step, kinematics, {newton, freezer, timer, accepted_excess}, v, residual);
    if (!report.newton.converged)
      return report;

    TimerOutput::Scope scope(timer, section);
    Vector v_end         = integration.end_velocity(step, start_velocity(), v);
    report.newton.reason = try_move(step, points, v_end, v);
    if (const Stage &stage = scene->loading.stage_at(t + h / 2.);
        stage.requires_equilibrium() && report.newton.reason.empty())
      report.newton.reason = stage.no_equilibrium(accelerating_share(
        *problem, points, scene->materials, start_velocity(), v));
    if (!report.newton.reason.empty())
      return report;
    report.converged = true;

    // The step is accepted from here on.
    if (bars)
      {
        bars->commit();
        report.bars   = bars->states_of_bars();
        report.plates = bars->states_of_plates();
      }
    accept_move(step, points, v);
    report.load_factor = scaled.add_scaled_loads(
      *constraints, problem->multipliers(), force, residual);
    const InternalForces &forces = problem->internal_forces();
    const double          excess = forces.excess_work();
    report.quality               = forces.quality(excess);
    report.works.excess_work     = (step.h / step.solved_h) * excess;
    report.reactions             = support_reactions(step, points, residual);
    add_works(step, points, v, residual, report);
    report.works.dissipation = update_points(step, points);
    if (flow)
      {
        report.water = flow->commit();
        report.works.dissipation += report.water.dissipation;
      }
    constraints->turn_back(v_end);
    constraints->turn_back(v);
    report.contact.dissipation += update_nodes(step, v_end, v, kinematics);
    report.works.contact_dissipation =
      report.contact.dissipation - report.contact.of_rebound;
    update_supports(step, v, kinematics, report.reactions);
    if (obstacles->exists())
      obstacles->commit(
        problem->contact(), v, h, step.solved_h, moves_obstacles());
    scope.stop();
    finish(step, newton, timer, kinematics, points, report);
    report.energies = state_energies(kinematics, points, t + h);
    report.largest_plastic_strain =
      largest_plastic_strain(points, v.get_mpi_communicator());
    return report;
  }
} // namespace geocone::GEOCONE_DIM
