// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/materials/material.h>
#include <geocone/newton/plan.h>

#include <algorithm>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using Method = GlobalisationMethod;
  using Start  = Attempt::Start;

  namespace
  {
    /** Adds the attempts with one local law, with the variants for contact. */
    void
    add_attempts(const Attempt        &law,
                 const StepTraits     &step,
                 const PlanOptions    &options,
                 std::vector<Attempt> &attempts)
    {
      const auto allowed = [&](const unsigned int automatic) {
        return options.max_iterations > 0 ? options.max_iterations : automatic;
      };
      const ContactTraits &contact      = step.contact;
      const bool           can_be_exact = !step.has_constraints;
      // If an obstacle moves away, nodes of an iterate lose their support, the soil yields
      // there, and the search does not recover. Active contacts are therefore bilateral
      // until the iterate is near, or far even after three iterations.
      const bool bilateral_first = contact.exists && step.law.can_yield &&
                                   !contact.has_free_obstacles &&
                                   !contact.of_bodies && !law.natural_map;
      const auto variant = [&](const ContactLaw   contact,
                               const Start        start,
                               const unsigned int iterations) {
        Attempt next    = law;
        next.contact    = contact;
        next.start      = start;
        next.iterations = allowed(iterations);
        // The bilateral iterate is a better start than the elastic tangent.
        next.elastic_first = !bilateral_first;
        return next;
      };
      if (bilateral_first)
        {
          Attempt bilateral =
            variant(ContactLaw::bilateral, Start::of_step, 10);
          bilateral.prepares = bilateral.is_rough = true;
          bilateral.elastic_first                 = true;
          bilateral.iterations_if_far             = 3;
          attempts.push_back(bilateral);
        }
      const Start start = bilateral_first ? Start::iterate : Start::of_step;
      // Motions of free obstacles depend on all contacts, and steps in which
      // many states change converge slowly. Without inertia nothing else
      // carries their loads: contact is solved exactly from the start, which
      // takes a tenth of the iterations. Obstacles without loads are first
      // tried with linearised contact, which costs less.
      const bool exact_first = contact.has_free_obstacles &&
                               !step.has_inertia && contact.obstacles_loaded &&
                               can_be_exact;
      if (exact_first)
        attempts.push_back(variant(ContactLaw::exact, start, law.iterations));
      if (!contact.has_friction)
        attempts.push_back(
          variant(ContactLaw::linearised, start, law.iterations));
      else
        {
          // If many nodes close in a step, nodes that would stick impede each
          // other. Contact is then solved exactly in each iteration; otherwise
          // the frictionless step may be a better initial guess.
          Attempt first = variant(
            ContactLaw::linearised, start, std::min(law.iterations, 30U));
          first.iterations_without_flow = 6;
          if (contact.has_free_obstacles)
            first.iterations_if_far = 20;
          attempts.push_back(first);
          // If points yield, the last iterate is a good initial guess, unless
          // obstacles moved.
          if (can_be_exact && !exact_first)
            attempts.push_back(variant(ContactLaw::exact,
                                       contact.has_free_obstacles
                                         ? Start::of_step
                                         : Start::yielding_iterate,
                                       law.iterations));
          Attempt smooth =
            variant(ContactLaw::without_friction, Start::of_step, 30);
          smooth.prepares = true;
          attempts.push_back(smooth);
          attempts.push_back(
            variant(ContactLaw::linearised, Start::iterate, law.iterations));
          attempts.back().elastic_first = false;
        }
    }
  } // namespace

  std::vector<Attempt>
  plan(const StepTraits &step, const PlanOptions &options)
  {
    std::vector<Attempt> attempts;
    const auto           add = [&](const Method       method,
                         const bool         natural_map,
                         const unsigned int iterations) {
      Attempt law;
      law.globalisation = method;
      law.natural_map   = natural_map;
      law.iterations    = iterations;
      add_attempts(law, step, options, attempts);
    };
    const auto add_lag = [&](const Method method) {
      const unsigned int most = options.max_iterations;
      Attempt            lag;
      lag.globalisation = method;
      lag.iterations    = most > 0 ? most : 60;
      lag.with_one_lag  = most > 0 ? most : 40;
      attempts.push_back(lag);
    };
    const LawTraits &law        = step.law;
    const bool       associated = law.non_associativity == 0.;
    const bool       hard =
      law.non_associativity > Material::strong_non_associativity;
    const Formulation formulation =
      step.needs_return_map() ? Formulation::return_map : options.formulation;
    const bool by_itself = formulation == Formulation::automatic;
    // With associated flow, lag has no effect: the first point of the path is
    // its end.
    const Method chosen =
      options.globalisation == Method::lag_continuation && associated
        ? Method::line_search
        : options.globalisation;

    if (chosen != Method::automatic && chosen != Method::lag_continuation)
      {
        add(chosen,
            formulation == Formulation::natural_map,
            associated ? 150 : 60);
        return attempts;
      }
    if (chosen == Method::automatic && law.has_friction_memory() && by_itself)
      {
        // The tangent of friction with memory is nearly elliptic. If the line
        // search has not converged early it rarely does. Then the natural map
        // is tried, or, for particles, whose apex states defeat it, explicit
        // friction as the start. If neither converges soon, subdividing the
        // step is cheaper.
        add(Method::line_search, false, step.points_move ? 40 : 20);
        if (step.points_move)
          add_lag(Method::explicit_friction);
        else
          add(Method::elastic_blend, true, 30);
        return attempts;
      }
    if (chosen == Method::automatic)
      {
        // Tresca's law, which has no apex.
        const bool natural_first = by_itself && law.frictionless;
        if (natural_first)
          add(Method::elastic_blend, true, 40);
        if (formulation == Formulation::return_map || (by_itself && !hard))
          add(hard ? Method::elastic_blend : Method::line_search,
              false,
              hard || natural_first        ? 30
              : associated && !law.spatial ? 150
                                           : 60);
        if (!natural_first && formulation != Formulation::return_map)
          add(Method::elastic_blend, true, by_itself ? 40 : 100);
      }
    if (!associated && formulation != Formulation::natural_map)
      add_lag(Method::lag_continuation);
    return attempts;
  }

  namespace
  {
    std::string
    text_of(const Attempt &line)
    {
      if (line.globalisation == Method::lag_continuation)
        return format("lag continuation: %u iterations on its path, %u with "
                      "one lag",
                      line.iterations,
                      line.with_one_lag);
      if (line.globalisation == Method::explicit_friction)
        return format("return map from the solution with explicit friction: "
                      "%u iterations each",
                      line.with_one_lag);
      std::string text =
        std::string(line.natural_map ? "natural map" : "return map") +
        (line.globalisation == Method::elastic_blend ? ", elastic blend"
                                                     : ", line search");
      text += line.contact == ContactLaw::bilateral ? ", bilateral contact"
              : line.contact == ContactLaw::exact
                ? ", exact directions of contact"
              : line.contact == ContactLaw::without_friction
                ? ", frictionless contact"
                : "";
      text += line.start == Start::iterate ? ", from the last iterate"
              : line.start == Start::yielding_iterate
                ? ", from the last iterate if points yield"
                : "";
      text += format(": %u iterations", line.iterations);
      if (line.iterations_if_far != Attempt::unlimited)
        text += format(", %u if far", line.iterations_if_far);
      if (line.iterations_without_flow != Attempt::unlimited)
        text += format(", %u without flow", line.iterations_without_flow);
      return text;
    }
  } // namespace

  std::string
  text_of_plans()
  {
    const double mild = Material::strong_non_associativity / 2., hard = 1.;
    std::vector<std::pair<std::string, StepTraits>> steps;
    const auto add = [&](const std::string &name, const double flow) -> auto &
    {
      steps.emplace_back(name, StepTraits());
      steps.back().second.law.can_yield         = true;
      steps.back().second.law.non_associativity = flow;
      return steps.back().second;
    };
    add("Associated flow", 0.);
    add("Associated flow, a law of all principal stresses", 0.).law.spatial =
      true;
    add("theta >= phi/2", mild);
    add("theta < phi/2", hard);
    {
      LawTraits &tresca   = add("phi = 0", 0.).law;
      tresca.frictionless = true;
    }
    add("theta < phi/2 without a natural map: B-bar of soil that dilates", hard)
      .has_cell_pressures                                        = true;
    add("Friction with a memory, FEM", hard).law.friction_memory = 1.;
    {
      StepTraits &particles = add("Friction with a memory, particles", hard);
      particles.law.friction_memory = 1.;
      particles.points_move         = true;
    }
    add("theta >= phi/2, fixed obstacles without friction", mild)
      .contact.exists = true;
    {
      ContactTraits &contact =
        add("theta >= phi/2, fixed obstacles with friction", mild).contact;
      contact.exists = contact.has_friction = true;
    }
    {
      ContactTraits &contact =
        add("theta >= phi/2, loaded free obstacles with friction, no inertia",
            mild)
          .contact;
      contact.exists = contact.has_friction = true;
      contact.has_free_obstacles = contact.obstacles_loaded = true;
    }
    std::string text;
    for (const auto &[name, step] : steps)
      {
        text += (text.empty() ? "" : "\n") + name + "\n";
        unsigned int n = 0;
        for (const Attempt &line : plan(step))
          text += format("  %u. ", ++n) + text_of(line) + "\n";
      }
    return text;
  }
} // namespace geocone::GEOCONE_DIM
