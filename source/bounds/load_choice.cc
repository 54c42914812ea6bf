// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/number_in.h>
#include <geocone/bounds/load_choice.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  void
  LoadChoice::declare(dealii::ParameterAcceptor &section)
  {
    asked.declare(section,
                  "Load factor of",
                  ". Loads multiplied by the load factor; other loads are "
                  "constant. Velocity: the bounded load is the reaction to the "
                  "velocities prescribed at t = 0. Automatic: velocity if one "
                  "of them is not zero, else weight, else tractions.");
  }

  void
  LoadChoice::choose(const std::optional<dealii::Tensor<1, dim>> &velocity,
                     const bool                                   has_weight)
  {
    chosen = asked;
    if (chosen == LoadFactor::automatic)
      chosen = velocity     ? LoadFactor::velocity
               : has_weight ? LoadFactor::weight
                            : LoadFactor::tractions;
    if (chosen == LoadFactor::velocity && !velocity)
      throw InputError(
        "Analysis/Load factor of",
        "velocity",
        "a prescribed velocity that is not zero at t = 0",
        "push a part of the boundary, or bound the weight or the "
        "tractions");
    if (chosen != LoadFactor::velocity && velocity)
      throw InputError("Analysis/Load factor of",
                       asked.word(),
                       "velocity where a velocity is prescribed that is not "
                       "zero",
                       "set it to 0, or bound its reaction");
    units.velocity = velocity ? velocity->norm() : 1.;
    if (velocity)
      direction = *velocity / units.velocity;
  }

  void
  LoadChoice::choose_all(const bool has_velocity, const std::string &kind)
  {
    if (has_velocity)
      throw InputError("Analysis/Kind",
                       kind,
                       "limit load where a velocity is prescribed that is not "
                       "zero",
                       "reduce the strength of a body that carries its weight "
                       "and tractions");
    chosen = LoadFactor::all;
  }

  void
  LoadChoice::choose_tractions(const bool has_velocity, const std::string &kind)
  {
    if (has_velocity)
      throw InputError("Analysis/Kind",
                       kind,
                       "limit load where a velocity is prescribed that is not "
                       "zero",
                       "load the body by 'Tractions'");
    chosen     = LoadFactor::tractions;
    may_vanish = true;
  }

  void
  LoadChoice::refuse_pore_pressures(const Scene &scene) const
  {
    for (const auto &load : scene.tractions.list)
      if (load->is_pore_pressure() &&
          (chosen == LoadFactor::weight || chosen == LoadFactor::tractions))
        throw InputError(load->parameter("Traction normal"),
                         load->formula(dim),
                         "a formula where weight or tractions are multiplied",
                         "bound the reaction to a velocity or reduce the "
                         "strength, in which water stays as it is, or give "
                         "the pressure by a formula");
  }

  double
  LoadChoice::stress_of_weight(const Scene &scene, const double height)
  {
    double density = 0.;
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      density = std::max(density, scene.materials.law(m).saturated_density());
    return height * density *
           scene.gravity.at(std::numeric_limits<double>::max()).norm();
  }

  void
  LoadChoice::refuse_zero_load() const
  {
    const std::string allowed = "a load that is not zero",
                      weight  = "give 'Gravity/Acceleration' and densities";
    if (chosen == LoadFactor::all)
      throw InputError(
        "Gravity/Acceleration", "0, 0", allowed, weight + ", or 'Tractions'");
    throw InputError("Analysis/Load factor of",
                     asked.word(),
                     allowed,
                     chosen == LoadFactor::weight
                       ? weight
                       : "give 'Tractions' that are not zero at t = 0");
  }

  namespace
  {
    /** Names of the conditions and obstacles that are pushed. */
    std::vector<std::string>
    pushed_supports(const Scene &scene)
    {
      std::vector<std::string> names;
      for (const auto &condition : scene.dirichlet.list)
        for (unsigned int d = 0; d < dim; ++d)
          if (condition->components[d] &&
              number_in(condition->formula(d)).value_or(1.) != 0.)
            {
              names.push_back(condition->name);
              break;
            }
      for (const auto &obstacle : scene.obstacles.list)
        if (obstacle->velocity(0.).centre.norm() > 0.)
          names.push_back(obstacle->name);
      return names;
    }

    std::string
    listed(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "'" : ", '") + name + "'";
      return text;
    }

    /** The support whose reaction is the load of steps; empty if there is none. */
    std::string
    observed_support(const Scene &scene)
    {
      const auto &conditions = scene.observation.conditions;
      return conditions.empty() ? "" : scene.supports()[conditions.front()];
    }
  } // namespace

  void
  LoadChoice::check_observed(const Scene &scene) const
  {
    const std::string name = observed_support(scene);
    if (!is_reaction() || name.empty())
      return;
    const auto pushed = pushed_supports(scene);
    require(std::find(pushed.begin(), pushed.end(), name) != pushed.end(),
            "Observation/Conditions",
            name,
            listed(pushed) + ", which is pushed, as the first name where the "
                             "reaction to a velocity is bounded",
            "name what is pushed; without weight and tractions other reactions "
            "follow by equilibrium");
  }

  std::string
  LoadChoice::other_than_observed(const Scene &scene) const
  {
    const Observation &observation = scene.observation;
    if (!is_reaction() || !observation.has_load())
      return "";
    if (const std::string name = observed_support(scene); !name.empty())
      if (const auto pushed = pushed_supports(scene);
          pushed != std::vector<std::string>{name})
        return "the bounded load is the reaction of all that is pushed, " +
               listed(pushed) + "; the load of steps is that of '" + name +
               "', the first of 'Observation/Conditions'";
    const double       factor = observation.factor;
    const unsigned int d      = observation.component;
    if (direction[d] * factor > (1. - 1e-9) * std::abs(factor))
      return "";
    std::string along = format("%g", direction[0]);
    for (unsigned int i = 1; i < dim; ++i)
      along += format(", %g", direction[i]);
    return format("the bounded load is %g times the reaction in the direction "
                  "(%s) of the prescribed velocity; the load of steps is %g "
                  "times its component %c ('Observation/Factor', 'Component'), "
                  "another one",
                  std::abs(factor),
                  along.c_str(),
                  factor,
                  "xyz"[d]);
  }

  std::string
  LoadChoice::word() const
  {
    return chosen == LoadFactor::velocity ? "velocity"
           : chosen == LoadFactor::weight ? "weight"
           : chosen == LoadFactor::all    ? "weight and tractions"
                                          : "tractions";
  }

  std::string
  LoadChoice::unit() const
  {
    return is_reaction() ? unit_of_reaction : "-";
  }
} // namespace geocone::GEOCONE_DIM
