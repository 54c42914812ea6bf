// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_freezer_h
#define geocone_problem_freezer_h

#include <geocone/problem/frozen_problem.h>
#include <geocone/scene/scene.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Writes incremental problems as data into the folder of the run: those of
   * selected steps, and those that did not converge.
   */
  class Freezer : public dealii::ParameterAcceptor
  {
  public:
    Freezer();

    /** @throws InputError for steps outside the programme, and for features
     *  that frozen problems cannot represent */
    void
    check(const Scene &scene) const;

    /** @param folder of the run, which exists */
    void
    prepare(const std::string &folder);

    /** Whether any problem may be written. */
    bool
    is_used() const
    {
      return failures || !steps.empty();
    }

    /** Sets the step of the programme for the problems that follow. */
    void
    set_step(const unsigned int number);

    /**
     * Writes a problem after an attempt to solve it, if chosen. Collective.
     * @param start initial guess
     */
    void
    take(const IncrementalProblem &problem,
         const Vector             &start,
         const bool                particles,
         const bool                converged);

  private:
    std::vector<unsigned int> steps;
    bool                      failures = false;

    std::string  path;
    unsigned int step = 0, n_taken = 0, n_failures = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
