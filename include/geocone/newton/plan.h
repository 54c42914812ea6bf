// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_newton_plan_h
#define geocone_newton_plan_h

#include <geocone/base/types.h>
#include <geocone/terms/step_traits.h>

#include <limits>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Formulation of the incremental problem (return mapping, natural map or
   *  stresses as unknowns), selected by the parameter 'Newton/Formulation'. */
  enum class Formulation
  {
    automatic,
    return_map,
    natural_map,
    of_stresses ///< the first of StressMethods::formulations; others follow
  };

  /** Globalisation method of Newton's method, selected by the parameter
   *  'Newton/Globalisation'. */
  enum class GlobalisationMethod
  {
    automatic,
    line_search,
    elastic_blend,
    merit_search,
    lag_continuation,
    none,
    explicit_friction ///< no parameter value: starts from explicit friction
  };

  /** Treatment of the contact law in a Newton iteration. */
  enum class ContactLaw
  {
    linearised, ///< linearised, as the rest of the step
    without_friction,
    bilateral, ///< active contacts stay closed
    exact      ///< solved exactly in each ContactDirection
  };

  /** Attempt at solving a step by Newton's method, one entry in the sequence of
   *  attempts (the plan()). */
  struct Attempt
  {
    static constexpr unsigned int unlimited =
      std::numeric_limits<unsigned int>::max();

    enum class Start
    {
      of_step,         ///< velocities at t_n, or the first iterate
      iterate,         ///< last of the previous attempt, if finite
      yielding_iterate ///< as iterate, if points yield there
    };

    GlobalisationMethod globalisation = GlobalisationMethod::line_search;
    bool                natural_map   = false; ///< if false, return map
    unsigned int        iterations    = 60;    ///< maximum; total of a lag path
    unsigned int        with_one_lag  = 0; ///< maximum per lag of a lag path

    ContactLaw contact = ContactLaw::linearised;
    Start      start   = Start::of_step;

    unsigned int iterations_without_flow = unlimited; ///< if no point yields
    unsigned int iterations_if_far =
      unlimited; ///< if above NewtonLoop::far_threshold

    bool prepares = false; ///< provides the next initial guess
    bool is_rough = false; ///< only to residual NewtonLoop::near_tolerance
    /** True if the first iteration may use the elastic tangent, as requested by
     *  the time stepper (NonsmoothNewton::Hints). */
    bool elastic_first = true;
  };

  /** User parameters that determine the sequence of attempts at a step. */
  struct PlanOptions
  {
    Formulation         formulation   = Formulation::automatic;
    GlobalisationMethod globalisation = GlobalisationMethod::automatic;
    /** Maximum number of iterations of each attempt; 0 for the default of the
     *  plan. */
    unsigned int max_iterations = 0;
  };

  /**
   * Creates the sequence of attempts at solving a step. The first converged
   * attempt completes the step, unless the attempt only provides the initial
   * guess of the next. A pure function. For theta >= phi/2 the return map with
   * the line search is tried first. Otherwise, or if it fails, the natural map
   * with the elastic blend follows: the stresses of the natural map satisfy the
   * law only at convergence, which prevents points from cycling between modes.
   * For non-associated flow the lag continuation is the last attempt.
   * doc/performance.md compares the attempts.
   */
  std::vector<Attempt>
  plan(const StepTraits &step, const PlanOptions &options = {});

  /** Text description of typical plans (sequences of attempts), one paragraph
   *  per plan. */
  std::string
  text_of_plans();
} // namespace geocone::GEOCONE_DIM

#endif
