// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/run/step_control.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  StepControl::StepControl()
    : ParameterAcceptor("/Time stepping")
  {
    add_parameter("Maximum halvings",
                  max_halvings,
                  "Maximum number of successive halvings of a step; beyond it "
                  "the run fails.");
    add_parameter("Easy iterations",
                  easy_iterations,
                  "Number of iterations up to which the next substep is 1.5 "
                  "times as long, up to the full step.");
    add_parameter(
      "Accepted excess",
      accepted_excess,
      "Tolerance of lagged friction [-], > 0 and <= 1, with 'Friction' = "
      "automatic: plastic work due to the difference from the exact strength "
      "over the plastic work of the substep. Substeps beyond it are halved up "
      "to three times in a row, then accepted with a warning.",
      prm,
      Patterns::Double(0., 1.));
  }

  void
  StepControl::prepare()
  {
    if (max_halvings > 30)
      throw InputError("Time stepping/Maximum halvings",
                       max_halvings,
                       "0 to 30",
                       "9 is usual");
    if (!(accepted_excess > 0.))
      throw InputError("Time stepping/Accepted excess",
                       accepted_excess,
                       "above 0 to 1",
                       "0.01 is usual; for none set 'Time stepping/Friction' = "
                       "exact");
  }

  void
  StepControl::begin_stage(const double h)
  {
    // Velocities jump at the onset of motion: a step of a small fraction of the memory
    // time is nearly convex, and later ones grow.
    constexpr double first_part = 1. / 16.;
    substep                     = std::min(h, first_part * memory);
  }

  bool
  StepControl::begin_step(const double h, const bool follows)
  {
    if (is_in_step)
      return false;
    is_in_step = true;
    // A substep that covered the full step grows with the steps.
    if (follows && substep >= step_size * (1. - 1e-6))
      substep = h;
    step_size = h;
    substep   = std::min(substep, largest());
    return true;
  }

  void
  StepControl::end_step()
  {
    completed  = 0.;
    is_in_step = false;
  }

  double
  StepControl::next() const
  {
    const double left = step_size - completed;
    return left <= substep * (1. + 1e-6) ? left : substep;
  }

  double
  StepControl::accepted_excess_of_next() const
  {
    return halved_for_excess < most_halved_for_excess &&
               next() / 8. >= smallest()
             ? accepted_excess
             : std::numeric_limits<double>::infinity();
  }

  void
  StepControl::accept(const SolverReport &report)
  {
    const double size = next();
    if (report.excess_share <= accepted_excess)
      halved_for_excess = 0;
    completed = size == step_size - completed ? step_size : completed + size;
    // Lagged friction is used where smaller steps have failed; its excess over the
    // strength grows with the step.
    if (report.iterations <= easy_iterations ||
        (report.friction_lag > 0. &&
         1.5 * report.excess_share <= accepted_excess))
      substep = std::min(largest(), 1.5 * substep);
  }

  double
  StepControl::cut(const bool is_first_step, const SolverReport &report)
  {
    halved_for_excess += report.lag_error_too_large;
    // The first step starts from rest and needs a far smaller size.
    substep = is_first_step && completed == 0. ? next() / 8. : next() / 2.;
    return substep;
  }

  bool
  StepControl::is_exhausted() const
  {
    return !(substep >= smallest() * (1. - 1e-6));
  }

  double
  StepControl::largest() const
  {
    // Substeps of equal size.
    const double most = memory / 2.;
    return step_size <= most ? step_size
                             : step_size / std::ceil(step_size / most - 1e-6);
  }

  double
  StepControl::smallest() const
  {
    return largest() * std::pow(0.5, max_halvings);
  }
} // namespace geocone::GEOCONE_DIM
