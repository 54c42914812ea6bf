// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/time_stepping/implicit_mpm.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    using Imposition = BoundaryCondition::Imposition;

    /** A Mandel vector turned by an angle: Q t Q'. */
    Mandel
    turn(const Mandel &t, const double angle)
    {
      const double c = std::cos(2. * angle), s = std::sin(2. * angle);
      const double mean = (t[0] + t[1]) / 2., half = (t[0] - t[1]) / 2.,
                   shear = t[2] / sqrt2;
      const double h     = c * half - s * shear;
      return {mean + h, mean - h, sqrt2 * (s * half + c * shear)};
    }

  } // namespace

  ImplicitMPM::ImplicitMPM(const ParameterFile &file)
    : ParameterAcceptor("/Material point method")
    , particles(file)
  {
    add_parameter("Advection",
                  advection,
                  "grid velocity | particle velocity | none: what moves the "
                  "particles. The second lets loads drift with FLIP. None: "
                  "they stay, as do supports, for limit loads by small "
                  "strains.",
                  prm,
                  Patterns::Selection("grid velocity|particle velocity|none"));
    add_parameter("Consistent mass part",
                  consistent_mass,
                  "M = (1 - c) lumped + c consistent; 0 to 1. Up to 0.999 is "
                  "safe; 1 is singular where a cell has fewer particles than "
                  "functions.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Integration",
                  integration,
                  "backward Euler | midpoint, which loses less energy.",
                  prm,
                  Patterns::Selection("backward Euler|midpoint"));
    add_parameter(
      "Start",
      start_name,
      "Where Newton's method starts: grid velocity (of the last "
      "step; best for slow loading) | particle velocity (vL, with "
      "the elastic tangent first) | automatic: the former, and "
      "the latter if it fails.",
      prm,
      Patterns::Selection("grid velocity|particle velocity|automatic"));
    add_parameter("Largest move",
                  largest_move,
                  "A step in which a particle would move farther than so many "
                  "cells is cut.");
  }

  void
  ImplicitMPM::check_parameters()
  {
    const std::string section = "Material point method/";
    if (rule.is_affine() && consistent_mass > 0.)
      throw InputError(section + "Consistent mass part",
                       consistent_mass,
                       "0 with Transfer = APIC",
                       "APIC hands over momentum by the lumped mass and grows "
                       "without bound with another: set it to 0, or Transfer = "
                       "FLIP");
    if (!(largest_move > 0.))
      throw InputError(
        section + "Largest move", largest_move, "> 0 cells", "3 is usual");
    midpoint = integration == "midpoint";
    if (start_name != "particle velocity")
      starts.push_back(Start::nodes);
    if (start_name != "grid velocity")
      starts.push_back(Start::particles);
    if (!space->is_non_negative() && consistent_mass < 1.)
      throw InputError("Discretisation/Basis",
                       "Lagrange",
                       "Bernstein where MPM lumps the mass",
                       "Lagrange's functions of degree 2 and 3 are negative "
                       "in places, and so would be masses: set Basis = "
                       "automatic, or '" +
                         section + "Consistent mass part' = 1");
  }

  std::string
  ImplicitMPM::prepare(const Scene           &scene_,
                       const BackgroundMesh  &mesh_,
                       const Space           &space_,
                       const NonsmoothNewton &newton,
                       TimerOutput           &timer,
                       Kinematics            &kinematics,
                       MaterialPoints        &points)
  {
    scene = &scene_;
    mesh  = &mesh_;
    space = &space_;
    check_parameters();

    for (const auto &condition : scene->dirichlet.list)
      condition->refuse_normal("free with MPM",
                               "give Velocity x and y, or set "
                               "Discretisation/Method = FEM");
    moving = std::make_unique<MovingConditions>(*scene, *mesh, *space);

    std::string warning = particles.prepare(*scene, *mesh, *space);
    if (midpoint && advection == "particle velocity")
      warning += std::string(warning.empty() ? "" : "; ") +
                 "the midpoint rule with Advection = particle velocity lets "
                 "the total energy grow where particles and nodes move "
                 "differently: take the grid velocity";
    points = particles.collect(*mesh, *space);
    datum  = mesh->lower_corner();

    constraints = std::make_unique<Constraints>(*scene, *mesh, *space);
    system =
      std::make_unique<LinearSystem>(newton.linear_solver_name(),
                                     mesh->triangulation().get_communicator(),
                                     scene->materials.symmetric());
    force.reinit(space->partitioner());
    if (rule.is_affine())
      for (unsigned int p = 0; p < points.n_points(); ++p)
        points.affine[p] = scene->initial_velocity.gradient(
          points.position[p], std::sqrt(points.weight[p]));
    begin(points, timer);
    newton.check(*problem);
    moving->check_held_particles(points);
    Vector v = problem->make_vector();
    constraints->set_values(v, 0.);
    moving->make_rows(
      points, v, 0., *constraints); // refuses what it must before the run
    kinematics.velocity = velocity_L;
    kinematics.supports.resize(scene->dirichlet.list.size());
    return warning;
  }

  Energies
  ImplicitMPM::state_energies(const Kinematics &,
                              const MaterialPoints &points,
                              const double          t) const
  {
    const Tensor<1, dim> g = scene->gravity.at(t);
    Energies             e;
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        e.kinetic += points.mass[p] * points.velocity[p].norm_square() / 2.;
        e.potential -= points.mass[p] * (g * (points.position[p] - datum));
      }
    if (rule.is_affine())
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            const Tensor<2, dim> &C = points.affine[p];
            e.kinetic +=
              points.mass[p] / 2. *
              scalar_product(
                C, C * moment(points, p, &points.nodes[c * points.n_nodes]));
          }
    const MPI_Comm comm = force.get_mpi_communicator();
    e.kinetic           = Utilities::MPI::sum(e.kinetic, comm);
    e.potential         = Utilities::MPI::sum(e.potential, comm);
    e.elastic           = elastic_energy(points, scene->materials, comm);
    return e;
  }

  void
  ImplicitMPM::begin(const MaterialPoints &points, TimerOutput &timer)
  {
    if (Utilities::MPI::sum(points.n_points(), force.get_mpi_communicator()) ==
        0)
      throw StepFailure("all particles have left the background mesh\n"
                        "  remedy:  end the loading earlier, or enlarge "
                        "'Mesh/Box'");
    {
      TimerOutput::Scope scope(timer, "transfer");
      lumped_mass.reinit(space->partitioner());
      velocity_L.reinit(space->partitioner());
      const unsigned int n = points.n_nodes;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const unsigned int *nodes = &points.nodes[c * n];
          for (unsigned int p = points.first_point[c];
               p < points.first_point[c + 1];
               ++p)
            for (unsigned int i = 0; i < n; ++i)
              {
                const double   m = points.mass[p] * points.values[p * n + i];
                Tensor<1, dim> v = points.velocity[p];
                if (rule.is_affine())
                  v += points.affine[p] *
                       (space->node_positions()[nodes[i]] - points.position[p]);
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    lumped_mass.local_element(dim * nodes[i] + d) += m;
                    velocity_L.local_element(dim * nodes[i] + d) += m * v[d];
                  }
              }
        }
      lumped_mass.compress(VectorOperation::add);
      velocity_L.compress(VectorOperation::add);
      lumped_mass.update_ghost_values();
      constraints->number_unknowns(&lumped_mass);
    }
    problem = std::make_unique<IncrementalProblem>(points,
                                                   scene->materials,
                                                   *constraints,
                                                   space->partitioner(),
                                                   &lumped_mass,
                                                   consistent_mass);
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
    system->set_pattern(*problem, timer);
    begun = true;
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
        problem.apply_mass(dst, src);
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
  ImplicitMPM::evaluate_force(const double t)
  {
    force                  = 0.;
    const Tensor<1, dim> g = scene->gravity.at(t);
    moving->add_tractions(force, t);
    for (unsigned int dof = 0; dof < force.locally_owned_size(); ++dof)
      force.local_element(dof) =
        constraints->has_mass(dof)
          ? force.local_element(dof) +
              g[dof % dim] * lumped_mass.local_element(dof)
          : 0.;
  }

  StepReport
  ImplicitMPM::advance(Kinematics            &kinematics,
                       MaterialPoints        &points,
                       const NonsmoothNewton &newton,
                       Freezer               &freezer,
                       TimerOutput           &timer,
                       const double           t,
                       const double           h)
  {
    if (!begun)
      begin(points, timer);
    // The midpoint rule is backward Euler over half of the step, doubled.
    const double solved_h = midpoint ? h / 2. : h;
    const double end      = t + solved_h;
    StepReport   report;
    Vector       v = problem->make_vector(), residual = problem->make_vector();
    {
      TimerOutput::Scope scope(timer, "transfer");
      constraints->set_values(v, end);
      moving->make_rows(points, v, end, *constraints);
      evaluate_force(end);
    }
    report.unknowns    = constraints->n_rows;
    report.multipliers = constraints->multipliers.n_rows();
    report.rows        = constraints->multipliers.n_given();

    problem->begin_step(solved_h, &force, velocity_L, v);
    for (const Start start : starts)
      {
        v = velocity_L;
        if (start == Start::nodes)
          for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
            if (had_mass.empty() || had_mass[i])
              v.local_element(i) = constraints->has_mass(i)
                                     ? kinematics.velocity.local_element(i)
                                     : 0.;
        constraints->set_values(v, end);
        const Vector v_start = v;
        SolverReport tried   = newton.solve(
          *problem, *system, timer, v, residual, {start == Start::particles});
        tried.add_earlier(report.newton);
        report.newton = std::move(tried);
        freezer.take(*problem, v_start, true, report.newton.converged);
        if (report.newton.converged)
          break;
      }
    if (!report.newton.converged)
      return report;

    TimerOutput::Scope scope(timer, "transfer");
    Vector             v_end = v;
    if (midpoint)
      v_end.sadd(2., -1., velocity_L);
    v.update_ghost_values();
    v_end.update_ghost_values();
    std::vector<Moved> moved;
    report.newton.reason = transfer(points, v_end, v, h, moved);
    if (!report.newton.reason.empty())
      return report;
    report.converged = true;

    // From here on the step is accepted.
    report.reactions =
      constraints->reactions(residual, points, problem->trial_stress(), end);
    report.quality                = problem->quality();
    const MPI_Comm         comm   = v.get_mpi_communicator();
    const Eigen::VectorXd &lambda = problem->multipliers();
    const Multipliers     &rows   = constraints->multipliers;
    std::array<double, 2>  sums   = {}; // works of weight, other external
    const Tensor<1, dim>   g      = scene->gravity.at(end);
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      {
        const double weight = constraints->has_mass(i)
                                ? g[i % dim] * lumped_mass.local_element(i)
                                : 0.;
        sums[0] += h * weight * v.local_element(i);
        sums[1] += h * (force.local_element(i) - weight) * v.local_element(i);
        if (constraints->is_prescribed(i))
          sums[1] += h * residual.local_element(i) * v.local_element(i);
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), 2),
                        comm,
                        ArrayView<double>(sums.data(), 2));
    if (rows.n_rows() > 0)
      sums[1] += h * lambda.dot(rows.multiply(v));
    report.identity_error =
      energy_identity_error(*problem,
                            points,
                            scene->materials,
                            velocity_L,
                            v,
                            (sums[0] + sums[1]) * (solved_h / h));

    // Particles that stay keep their potential energy, whatever moves the nodes:
    // as with FEM, the work of the weight is that of an external force.
    const double work_of_weight = advection == "none" ? sums[0] : 0.;

    // Gravity that changes works on points at rest.
    const Tensor<1, dim> change =
      scene->gravity.at(t + h) - scene->gravity.at(t);
    double work_of_change = 0.;
    if (change.norm() > 0.)
      for (unsigned int p = 0; p < points.n_points(); ++p)
        work_of_change -=
          points.mass[p] * (change * (points.position[p] - datum));
    double              dissipation = 0.;
    std::vector<double> history     = problem->trial_history();
    if (midpoint) // extrapolated to the end, as the stress
      for (std::size_t i = 0; i < history.size(); ++i)
        history[i] = 2. * history[i] - points.history[i];
    points.history = std::move(history);
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        Mandel       stress  = problem->trial_stress()[p];
        Mandel       plastic = problem->plastic_strain_increment(p);
        const double volume  = points.weight[p];
        dissipation += (h / solved_h) * volume * stress.dot(plastic);
        if (midpoint)
          {
            // Extrapolated to the end, and back onto the cone.
            plastic *= 2.;
            stress                   = 2. * stress - points.stress[p];
            const Material &material = scene->materials[points.material[p]];
            if (const auto cone = material.flow_cone(points.history_of(p)))
              {
                const Mandel on_cone = from_cone_axes(
                  project(cone->a, cone->k, Mandel(to_cone_axes(stress))));
                const Mandel strain =
                  material.elasticity().strain(Mandel(stress - on_cone));
                dissipation += volume * on_cone.dot(strain);
                plastic += strain;
                stress = on_cone;
              }
          }
        points.stress[p] = turn(stress, moved[p].spin);
        points.plastic_strain[p] =
          turn(points.plastic_strain[p] + plastic, moved[p].spin);
        points.cumulative_plastic_strain[p] += plastic.norm();
        points.plastic_strain_rate[p] = plastic.norm() / h;
        points.weight[p]              = moved[p].volume;
        points.displacement[p] += moved[p].displacement;
        points.position[p] = moved[p].position;
        points.velocity[p] = moved[p].velocity;
        points.affine[p]   = moved[p].affine;
        if (points.held_by[p] > 0)
          {
            const BoundaryCondition &condition =
              *scene->dirichlet.list[points.held_by[p] - 1];
            if (condition.imposition == Imposition::points)
              for (unsigned int d = 0; d < dim; ++d)
                if (condition.components[d])
                  points.velocity[p][d] =
                    condition.components[d]->value(points.position[p], t + h);
          }
      }

    for (unsigned int c = 0; c < kinematics.supports.size(); ++c)
      {
        const bool moves = scene->dirichlet.list[c]->moves();
        if (moves)
          report.reactions[c].moment =
            rows.moment(lambda, c, constraints->centre(c), *space);
        for (unsigned int d = 0; d < dim; ++d)
          {
            kinematics.supports[c][d] +=
              h * (moves ? rows.mean_target(c, d) : constraints->mean(v, c, d));
            if (moves)
              report.reactions[c].force[d] = rows.resultant(lambda, c, d);
          }
      }
    if (advection != "none")
      moving->move(v, h, end);

    had_mass.resize(v.locally_owned_size());
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      had_mass[i] = constraints->has_mass(i);
    kinematics.velocity = v;
    particles.move(points);
    points = particles.collect(*mesh, *space);
    begun  = false;

    report.energies               = state_energies(kinematics, points, t + h);
    report.largest_plastic_strain = largest_plastic_strain(points, comm);
    report.energies.external_work =
      sums[1] + work_of_weight + Utilities::MPI::sum(work_of_change, comm);
    report.energies.dissipation = Utilities::MPI::sum(dissipation, comm);
    return report;
  }

  Tensor<2, dim>
  ImplicitMPM::moment(const MaterialPoints &points,
                      const unsigned int    p,
                      const unsigned int   *nodes) const
  {
    Tensor<2, dim> D;
    for (unsigned int i = 0; i < points.n_nodes; ++i)
      {
        const Tensor<1, dim> r =
          space->node_positions()[nodes[i]] - points.position[p];
        D += points.values[p * points.n_nodes + i] * outer_product(r, r);
      }
    return D;
  }

  std::string
  ImplicitMPM::transfer(const MaterialPoints &points,
                        const Vector         &v,
                        const Vector         &v_mean,
                        const double          h,
                        std::vector<Moved>   &moved) const
  {
    moved.resize(points.n_points());
    const unsigned int n         = points.n_nodes;
    const double       flip_part = rule.flip_part();
    std::string        obstacle;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const unsigned int *nodes = &points.nodes[c * n];
        const double extent[dim]  = {points.cells[c]->extent_in_direction(0),
                                     points.cells[c]->extent_in_direction(1)};
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            const double  *N  = &points.values[p * n];
            const double  *gx = &points.gradients[2 * p * n], *gy = gx + n;
            Tensor<1, dim> new_velocity, mean_velocity, change;
            Tensor<2, dim> gradient; // d_d v_c of the mean velocity
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const unsigned int dof = dim * nodes[i] + d;
                  const double       vi  = v.local_element(dof);
                  const double       mi  = v_mean.local_element(dof);
                  new_velocity[d] += N[i] * vi;
                  mean_velocity[d] += N[i] * mi;
                  change[d] += N[i] * (vi - velocity_L.local_element(dof));
                  gradient[d][0] += gx[i] * mi;
                  gradient[d][1] += gy[i] * mi;
                }
            Moved &next   = moved[p];
            next.velocity = flip_part * (points.velocity[p] + change) +
                            (1. - flip_part) * new_velocity;
            if (rule.is_affine())
              next.affine = affine_part(
                points, p, nodes, v, std::min(extent[0], extent[1]));
            next.displacement = h * mean_velocity;
            if (advection == "particle velocity")
              {
                // Particles held one by one stay in their row: out of it, their
                // rows would prescribe a gradient as well.
                const BoundaryCondition *holder =
                  points.held_by[p] > 0
                    ? scene->dirichlet.list[points.held_by[p] - 1].get()
                    : nullptr;
                for (unsigned int d = 0; d < dim; ++d)
                  if (holder == nullptr ||
                      holder->imposition != Imposition::points ||
                      !holder->components[d])
                    next.displacement[d] = h * next.velocity[d];
              }
            Tensor<1, dim> move = next.displacement;
            if (advection == "none")
              {
                move     = 0.;
                gradient = 0.;
              }
            next.position          = points.position[p] + move;
            Tensor<2, dim> stretch = h * gradient;
            for (unsigned int d = 0; d < dim; ++d)
              stretch[d][d] += 1.;
            const double ratio = determinant(stretch);
            next.volume        = ratio * points.weight[p];
            next.spin          = h * (gradient[1][0] - gradient[0][1]) / 2.;

            if (!std::isfinite(next.position.square()) ||
                !std::isfinite(next.velocity.norm_square()))
              obstacle = format("the velocity of particle %u is not a number",
                                points.id[p]);
            else if (!(ratio > 0.05))
              obstacle = format("the volume of particle %u at (%g, %g) would "
                                "collapse to %.2g of itself",
                                points.id[p],
                                points.position[p][0],
                                points.position[p][1],
                                ratio);
            for (unsigned int d = 0; d < dim; ++d)
              if (std::abs(move[d]) > largest_move * extent[d])
                obstacle =
                  format("particle %u at (%g, %g) would cross %.1f cells, more "
                         "than 'Material point method/Largest move'",
                         points.id[p],
                         points.position[p][0],
                         points.position[p][1],
                         std::abs(move[d]) / extent[d]);
          }
      }
    return text_of_any_rank(v.get_mpi_communicator(), obstacle);
  }

  Tensor<2, dim>
  ImplicitMPM::affine_part(const MaterialPoints &points,
                           const unsigned int    p,
                           const unsigned int   *nodes,
                           const Vector         &v,
                           const double          size) const
  {
    const unsigned int n = points.n_nodes;
    Tensor<2, dim>     B, gradient;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double         vi = v.local_element(dim * nodes[i] + d);
          const Tensor<1, dim> r =
            space->node_positions()[nodes[i]] - points.position[p];
          for (unsigned int e = 0; e < dim; ++e)
            {
              B[d][e] += points.values[p * n + i] * vi * r[e];
              gradient[d][e] += points.gradients[(2 * p + e) * n + i] * vi;
            }
        }
    return affine_velocity(B, moment(points, p, nodes), gradient, size);
  }

  void
  ImplicitMPM::save(Archive &archive, MaterialPoints &)
  {
    particles.save(archive, *mesh);
    Vector mass(velocity_L);
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      mass.local_element(i) = had_mass.empty() || had_mass[i];
    save_nodes(archive, "had mass", *mesh, *space, mass);
    StateRow row;
    moving->state(row);
    archive.write_row("sides", row);
  }

  void
  ImplicitMPM::load(const Archive &archive, MaterialPoints &points)
  {
    particles.load(archive, *mesh);
    Vector mass(velocity_L);
    load_nodes(archive, "had mass", *mesh, *space, mass);
    had_mass.resize(mass.locally_owned_size());
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      had_mass[i] = mass.local_element(i) > 0.;
    StateRow row = archive.read_row("sides");
    moving->state(row);
    points = particles.collect(*mesh, *space);
    begun  = false;
  }
} // namespace geocone
