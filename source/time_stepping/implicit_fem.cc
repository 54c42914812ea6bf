// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/time_stepping/implicit_fem.h>

#include <deal.II/base/mpi.h>

namespace geocone
{
  using dealii::TimerOutput;

  ImplicitFEM::ImplicitFEM()
    : dealii::ParameterAcceptor("/Time stepping")
  {
    add_parameter("Inertia",
                  inertia,
                  "false: quasi-static, no mass is assembled and the density "
                  "enters only the weight. true: lumped mass (row sums; for P2 "
                  "the scaled diagonal).");
  }

  void
  ImplicitFEM::prepare(const Scene           &scene_,
                       const BackgroundMesh  &mesh,
                       const Space           &space,
                       const Constraints     &constraints_,
                       const MaterialPoints  &points,
                       const NonsmoothNewton &newton,
                       TimerOutput           &timer)
  {
    scene         = &scene_;
    constraints   = &constraints_;
    linear_solver = make_linear_solver(newton.linear_solver_name(),
                                       mesh.triangulation().get_communicator(),
                                       scene->materials.symmetric());
    if (!inertia)
      constraints->check_support(mesh, space);
    loads = std::make_unique<Loads>(*scene, mesh, space);
    if (inertia || scene->gravity.acts())
      integrate_density(*scene, mesh, space, weight_per_g, lumped_mass);
    if (loads->exist())
      force.reinit(space.partitioner());
    problem =
      std::make_unique<IncrementalProblem>(points,
                                           scene->materials,
                                           *constraints,
                                           space.partitioner(),
                                           inertia ? &lumped_mass : nullptr);
    matrix = problem->make_pattern(linear_solver->wants_one_triangle());
    TimerOutput::Scope scope(timer, "analyse");
    linear_solver->analyse(matrix);
  }

  StepReport
  ImplicitFEM::advance(Kinematics            &kinematics,
                       MaterialPoints        &points,
                       const NonsmoothNewton &newton,
                       TimerOutput           &timer,
                       const double           t,
                       const double           h)
  {
    if (loads->exist())
      loads->evaluate(force, weight_per_g, t + h);
    problem->begin_step(
      h, t + h, loads->exist() ? &force : nullptr, kinematics.velocity);

    StepReport report;
    report.residual = problem->make_vector();
    Vector v        = kinematics.velocity;
    report.newton =
      newton.solve(*problem, matrix, *linear_solver, timer, v, report.residual);
    report.converged = report.newton.converged;
    if (!report.converged)
      return report;

    TimerOutput::Scope scope(timer, "commit");
    report.quality  = problem->quality();
    report.energies = energies(*problem, points, v, report.residual);
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Mandel plastic = problem->plastic_strain_increment(p);
        points.plastic_strain[p] += plastic;
        points.cumulative_plastic_strain[p] += plastic.norm();
        points.plastic_strain_rate[p] = plastic.norm() / h;
      }
    points.stress       = problem->trial_stress();
    kinematics.velocity = v;
    kinematics.displacement.add(h, v);
    return report;
  }

  Energies
  ImplicitFEM::energies(const IncrementalProblem &problem,
                        const MaterialPoints     &points,
                        const Vector             &v,
                        const Vector             &residual) const
  {
    const double h = problem.time_step();
    Energies     e;
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      {
        const double vi = v.local_element(i);
        if (inertia)
          e.kinetic += lumped_mass.local_element(i) * vi * vi / 2.;
        if (loads->exist())
          e.external_work += h * force.local_element(i) * vi;
        if (!constraints->is_free(i))
          e.external_work += h * residual.local_element(i) * vi;
      }
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        const Mandel &s = problem.trial_stress()[p];
        e.elastic +=
          points.weight[p] / 2. *
          s.dot(scene->materials[points.material[p]].elasticity().strain(s));
        e.dissipation +=
          points.weight[p] * s.dot(problem.plastic_strain_increment(p));
      }
    std::array<double, 4> sums = {
      {e.kinetic, e.elastic, e.external_work, e.dissipation}};
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(), 4),
                                v.get_mpi_communicator(),
                                dealii::ArrayView<double>(sums.data(), 4));
    return {sums[0], sums[1], sums[2], sums[3]};
  }
} // namespace geocone
