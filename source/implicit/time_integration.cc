// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/implicit/time_integration.h>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_time_integration[] = {
      {"Material point method/Theta",
       "Material point method/Integration",
       {"theta-scheme"}},
      {"Material point method/Newmark gamma",
       "Material point method/Integration",
       {"Newmark"}},
      {"Material point method/Newmark beta",
       "Material point method/Integration",
       {"Newmark"}},
      {"Time stepping/Theta", "Time stepping/Integration", {"theta-scheme"}},
      {"Time stepping/Newmark gamma", "Time stepping/Integration", {"Newmark"}},
      {"Time stepping/Newmark beta", "Time stepping/Integration", {"Newmark"}}};
  } // namespace

  void
  TimeIntegration::declare(dealii::ParameterAcceptor &acceptor,
                           const std::string         &documentation)
  {
    using dealii::ParameterAcceptor;
    using dealii::Patterns::Double;
    rule.declare(acceptor, "Integration", documentation);
    acceptor.add_parameter(
      "Theta",
      theta,
      "Parameter theta of the theta-scheme [-], 0.5 to 1. 0.5: midpoint rule; "
      "1: backward Euler. A step dissipates the energy (theta - 1/2) (|dv|_M^2 "
      "+ |ds|_S^2).",
      ParameterAcceptor::prm,
      Double(0.5, 1.));
    acceptor.add_parameter(
      "Newmark gamma",
      gamma,
      "Newmark's gamma [-], 0.5 (second order, no damping) to 1.",
      ParameterAcceptor::prm,
      Double(0.5, 1.));
    acceptor.add_parameter(
      "Newmark beta",
      beta,
      "Newmark's beta [-], 0.25 to 1; >= gamma/2 for unconditional stability. "
      "0.25 with gamma = 0.5: average acceleration; (gamma + 1/2)^2/4: "
      "strongest damping of unresolved waves.",
      ParameterAcceptor::prm,
      Double(0.25, 1.));
  }

  void
  TimeIntegration::check(const Scene &scene, const std::string &section) const
  {
    if (is_newmark())
      check_newmark(scene, section);
    else if (!is_backward_euler())
      check_theta_scheme(scene, section);
  }

  void
  TimeIntegration::check_newmark(const Scene       &scene,
                                 const std::string &section) const
  {
    if (!(beta >= gamma / 2.))
      throw InputError(section + "Newmark beta",
                       beta,
                       format(">= %g, half of Newmark gamma", gamma / 2.),
                       format("(gamma + 1/2)^2/4 = %g is usual",
                              (gamma + 0.5) * (gamma + 0.5) / 4.));
    // Each of these exerts forces at the beginning of a step besides loads and
    // stresses, from which the acceleration is computed.
    const std::string what   = section + "Integration = Newmark",
                      remedy = "take the theta-scheme or backward Euler";
    scene.refuse_contact(what, remedy);
    scene.absorbing.refuse(what, remedy);
    if (scene.loading.scales_loads())
      throw InputError(section + "Integration",
                       word(),
                       "another one in stages with 'Scaled loads'",
                       remedy);
    for (const auto &condition : scene.dirichlet.list)
      if (condition->moves_with_body())
        throw InputError(condition->parameter("Imposed on"),
                         condition->imposition.word(),
                         "nodes with " + what,
                         remedy);
  }

  void
  TimeIntegration::check_theta_scheme(const Scene       &scene,
                                      const std::string &section) const
  {
    if (scene.materials.traits().spatial)
      throw InputError(section + "Integration",
                       word(),
                       "backward Euler or Newmark with laws that are spatial",
                       "they do not say which stress their strength allows is "
                       "nearest to another");
    const auto check = [&](const std::string &parameter, const double e) {
      if (e > 0.)
        throw InputError(parameter,
                         e,
                         "0 with Integration = " + word(),
                         "by this rule bodies rebound by their "
                         "elasticity alone: leave it out, or take backward "
                         "Euler");
    };
    for (const auto &obstacle : scene.obstacles.list)
      check(obstacle->parameter("Restitution"), obstacle->law.restitution);
    for (const auto &pair : scene.contacts.list)
      check("Contacts/" + pair->name + "/Restitution", pair->law.restitution);
  }

  double
  TimeIntegration::theta_of_rule() const
  {
    return rule == Integration::midpoint       ? 0.5
           : rule == Integration::theta_scheme ? theta
                                               : 1.;
  }

  TimeStep
  TimeIntegration::step(const double t, const double h) const
  {
    if (is_newmark())
      return {t,
              h,
              h,
              t + h,
              t + h / 2.,
              gamma / beta,
              h * (0.5 - beta),
              h * (0.5 - gamma + beta),
              0.5};
    const double solved_h  = theta_of_rule() * h;
    const double solved_at = t + solved_h;
    return {t, h, solved_h, solved_at, solved_at, h / solved_h, 0., 0., 0.};
  }

  const Vector &
  TimeIntegration::mass_of_problem(const Vector &lumped_mass)
  {
    if (!is_newmark())
      return lumped_mass;
    scaled_mass = lumped_mass;
    scaled_mass /= beta;
    return scaled_mass;
  }

  void
  TimeIntegration::predict(const TimeStep    &step,
                           const Vector      &net_force,
                           const Vector      &lumped_mass,
                           const Constraints &constraints,
                           Vector            &velocity)
  {
    Vector before(velocity.get_partitioner()), after = before;
    constraints.set_values(before, step.t);
    constraints.set_values(after, step.t + step.h);
    acceleration.reinit(velocity.get_partitioner());
    for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
      if (constraints.is_prescribed(i))
        acceleration.local_element(i) =
          (after.local_element(i) - before.local_element(i)) / step.h;
      else if (const double mass = lumped_mass.local_element(i); mass > 0.)
        acceleration.local_element(i) = net_force.local_element(i) / mass;
    velocity.add(step.predictor, acceleration);
  }

  Vector
  TimeIntegration::end_velocity(const TimeStep &step,
                                const Vector   &velocity_L,
                                const Vector   &v) const
  {
    Vector end = v;
    if (step.extrapolation != 1.)
      end.sadd(step.extrapolation, 1. - step.extrapolation, velocity_L);
    if (step.corrector != 0.)
      end.add(step.corrector, acceleration);
    return end;
  }

  namespace
  {
    /** @param history at the end */
    EndOfStep
    end_of_point(const TimeStep       &step,
                 const InternalForces &solved,
                 const unsigned int    point,
                 const Material       &material,
                 const Mandel         &stress_n,
                 const double         *history)
    {
      const Mandel        stress  = solved.trial_stress()[point];
      const SpatialMandel whole   = solved.plastic_strain_increment(point);
      const Mandel        plastic = whole.head<n_mandel>();
      const double        extrapolation = step.stress_extrapolation();
      if (extrapolation == 1.)
        {
          SpatialMandel dissipating = solved.whole_stress(point);
          if (step.start_part > 0.)
            dissipating +=
              step.start_part * (solved.whole_stress_n(point) - dissipating);
          return {stress, plastic, whole.norm(), dissipating.dot(whole)};
        }
      const Mandel beyond =
        extrapolation * stress - (extrapolation - 1.) * stress_n;
      const Mandel end  = material.nearest_admissible(beyond, history);
      const Mandel back =
        material.elasticity_at(stress_n, history).strain(Mandel(beyond - end));
      const Mandel all  = extrapolation * plastic + back;
      return {end,
              all,
              all.norm(),
              extrapolation * stress.dot(plastic) + stress.dot(back)};
    }
  } // namespace

  std::vector<EndOfStep>
  end_step(const TimeStep       &step,
           const InternalForces &solved,
           const Materials      &materials,
           MaterialPoints       &points)
  {
    const double        extrapolation = step.stress_extrapolation();
    std::vector<double> history       = solved.trial_history();
    if (extrapolation != 1.)
      for (std::size_t i = 0; i < history.size(); ++i)
        history[i] =
          extrapolation * history[i] - (extrapolation - 1.) * points.history[i];
    std::vector<EndOfStep> ends;
    ends.reserve(points.n_points());
    for (unsigned int p = 0; p < points.n_points(); ++p)
      ends.push_back(
        end_of_point(step,
                     solved,
                     p,
                     materials[points.material[p]],
                     points.stress[p],
                     history.data() + std::size_t(points.n_history()) * p));
    // Increments of the step follow from the histories at its beginning.
    points.history = std::move(history);
    return ends;
  }
} // namespace geocone::GEOCONE_DIM
