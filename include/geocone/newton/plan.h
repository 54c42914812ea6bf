// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_plan_h
#define geocone_newton_plan_h

#include <geocone/base/types.h>
#include <geocone/problem/step_traits.h>

#include <limits>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Formulation of a step, a value of 'Newton/Formulation'. */
  enum class Formulation
  {
    automatic,
    return_map,
    natural_map,
    of_stresses ///< the first of StressMethods::formulations; others follow
  };

  /** Globalisation method, a value of 'Newton/Globalisation'. */
  enum class GlobalisationMethod
  {
    automatic,
    line_search,
    elastic_blend,
    merit_search,
    lag_continuation,
    none,
    explicit_friction ///< no word: the solution with explicit friction is the start
  };

  /** Law of contact in an iteration. */
  enum class ContactLaw
  {
    linearised, ///< with the rest of the step
    without_friction,
    bilateral, ///< active contacts stay closed
    exact      ///< solved by ContactDirection for each direction
  };

  /** A Newton iteration, as a line of a plan. */
  struct Try
  {
    static constexpr unsigned int unlimited =
      std::numeric_limits<unsigned int>::max();

    enum class Start
    {
      of_step,        ///< velocities of t_n, or the first iterate
      iterate,        ///< of the previous attempt, if finite
      flowing_iterate ///< the same if points yield there
    };

    GlobalisationMethod globalisation = GlobalisationMethod::line_search;
    bool                natural_map   = false; ///< or the return map
    unsigned int        iterations   = 60; ///< allowed; for a lag path in total
    unsigned int        with_one_lag = 0;  ///< allowed, of the lag continuation

    ContactLaw contact = ContactLaw::linearised;
    Start      start   = Start::of_step;

    unsigned int iterations_without_flow =
      unlimited;                                ///< only contact is nonlinear
    unsigned int iterations_if_far = unlimited; ///< NewtonLoop::far

    bool prepares = false; ///< only provides the start of the next one
    bool is_rough = false; ///< only up to NewtonLoop::near
    /** Uses the elastic tangent first, if the time stepper hints at it. */
    bool elastic_first = true;
  };

  /** Parameters on which a plan depends. */
  struct PlanOptions
  {
    Formulation         formulation   = Formulation::automatic;
    GlobalisationMethod globalisation = GlobalisationMethod::automatic;
    /** Maximum number of iterations of each attempt; 0: that of the plan. */
    unsigned int max_iterations = 0;
  };

  /**
   * Attempts at a step in order; the first that converges completes the step,
   * unless it only provides the initial guess of the next. A pure function. For
   * theta >= phi/2 the return map with the line search is tried first.
   * Otherwise, or if it fails, the natural map with the elastic blend follows:
   * its stresses satisfy the law at the end only, which avoids cycles of points
   * between modes. For non-associated flow the lag continuation is the last.
   * doc/performance.md compares them.
   */
  std::vector<Try>
  plan(const StepTraits &step, const PlanOptions &options = {});

  /** Plans of typical steps, a paragraph each. */
  std::string
  text_of_plans();
} // namespace geocone::GEOCONE_DIM

#endif
