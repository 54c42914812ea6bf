// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Plans of Newton's method, without a mesh: those of typical steps, which
// doc/theory/newton.md must have, too; with limits and globalisations that are asked for;
// and with each combination of properties, none of which may be without a try, end with
// one that only prepares another, or have a try before the first that starts from an
// iterate.

#include <geocone/newton/plan.h>

#include "../test.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace solvers_plan_01
{
  using namespace geocone;

  /** A step whose properties are the bits of a number. */
  StepTraits
  step_of(const unsigned int bits)
  {
    const auto bit = [&](const unsigned int i) { return (bits >> i & 1U) > 0; };
    StepTraits step;
    step.law.can_yield              = bit(0);
    step.law.non_associativity      = bit(1) ? (bit(2) ? 1. : 0.3) : 0.;
    step.law.frictionless           = bit(3);
    step.law.has_natural_map        = bit(4);
    step.points_move                = bit(5);
    step.has_inertia                = bit(6);
    step.has_constraints            = bit(7);
    step.contact.exists             = bit(8);
    step.contact.has_friction       = bit(8) && bit(9);
    step.contact.has_free_obstacles = bit(8) && bit(10);
    step.contact.obstacles_loaded   = bit(8) && bit(10) && bit(11);
    if (bit(12))
      step.law.friction_memory = 1.;
    return step;
  }

  void
  test()
  {
    const std::string text = text_of_plans();
    std::printf("%s\n", text.c_str());

    std::ifstream      in(GEOCONE_SOURCE_DIR "/doc/theory/newton.md");
    std::ostringstream theory;
    theory << in.rdbuf();
    std::printf("in doc/theory/newton.md: %s\n",
                theory.str().find(text) != std::string::npos ? "yes" : "NO");

    PlanOptions options;
    options.max_iterations = 7;
    bool limited           = true;
    for (const Attempt &line : plan(step_of((1U << 13) - 1), options))
      limited = limited && line.iterations == 7;
    std::printf("limits that are asked for: %s\n", limited ? "yes" : "NO");

    options               = {};
    options.globalisation = GlobalisationMethod::merit_search;
    const auto one        = plan(step_of(7), options);
    std::printf("merit search: %zu try of %u iterations\n",
                one.size(),
                one[0].iterations);

    unsigned int n_wrong = 0;
    for (unsigned int bits = 0; bits < 1U << 13; ++bits)
      {
        const auto attempts = plan(step_of(bits));
        n_wrong += attempts.empty() || attempts.back().prepares ||
                   attempts.front().start != Attempt::Start::of_step;
      }
    std::printf("plans that cannot be: %u of %u\n", n_wrong, 1U << 13);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_plan_01
