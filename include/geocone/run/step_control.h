// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_run_step_control_h
#define geocone_run_step_control_h

#include <geocone/base/state_row.h>
#include <geocone/newton/solver_report.h>

#include <deal.II/base/parameter_acceptor.h>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  /**
   * Sizes of the substeps into which implicit runs subdivide a step of the loading
   * programme: a failed substep is halved; after a substep with few iterations, the size
   * increases by half, up to the largest one. This is the full step or, for friction with
   * memory, at most half of the memory time, for which the tangent is nearly elliptic
   * (doc/theory/friction_memory.md).
   */
  class StepControl : public dealii::ParameterAcceptor
  {
  public:
    StepControl();

    void
    prepare();

    /** Limits substeps by the memory time of friction (s). */
    void
    limit(const double friction_memory)
    {
      memory = friction_memory;
    }

    /** Begins a stage of the loading programme. @param h size of its first step (s) */
    void
    begin_stage(const double h);

    /** Begins a step of size h (s), unless an interrupted step is continued.
     *  @param follows whether it follows another step of the same stage
     *  @return whether a step has begun */
    bool
    begin_step(const double h, const bool follows);

    void
    end_step();

    /** Completed part of the current step (s). */
    double
    done() const
    {
      return completed;
    }

    bool
    is_done() const
    {
      return completed >= step_size;
    }

    /** Selected size of substeps (s). */
    double
    size() const
    {
      return substep;
    }

    /** Returns the size of the next substep (s). The last one ends exactly at the end of
     *  the step and is not tiny. */
    double
    next() const;

    /** Returns the accepted excess of the next substep with lagged friction
     *  (NonsmoothNewton::Hints). Infinite if smaller substeps do not help. */
    double
    accepted_excess_of_next() const;

    /** Completes a substep of size next(), and selects the next one. */
    void
    accept(const SolverReport &report);

    /** Selects a smaller substep after that of size next() has failed.
     *  @param is_first_step whether it starts from rest
     *  @return the smaller size (s) */
    double
    cut(const bool is_first_step, const SolverReport &report);

    /** Returns true if the next substep has been halved too often. */
    bool
    is_exhausted() const;

    unsigned int
    most_halvings() const
    {
      return max_halvings;
    }

    void
    state(StateRow &row)
    {
      row(substep, step_size, completed, halved_for_excess, is_in_step);
    }

  private:
    double
    largest() const;
    double
    smallest() const;

    /** Maximum of halved_for_excess. If the exact law has no solution near the iterate,
     *  smaller substeps do not help. */
    static constexpr unsigned int most_halved_for_excess = 3;

    unsigned int max_halvings    = 9;
    unsigned int easy_iterations = 12;
    double       accepted_excess = 0.01; ///< see NonsmoothNewton::Hints
    double       memory          = std::numeric_limits<double>::infinity();

    /** @name State */
    /** @{ */
    double substep    = 0.;    ///< size of the next substep (s)
    double step_size  = 0.;    ///< of the current or last step (s)
    double completed  = 0.;    ///< part of the current step (s)
    bool   is_in_step = false; ///< whether a step has begun

    /** Number of consecutive times that the substep was halved because the solution with
     *  lagged friction differed too much from the exact law
     *  (SolverReport::lag_error_too_large). */
    unsigned int halved_for_excess = 0;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
