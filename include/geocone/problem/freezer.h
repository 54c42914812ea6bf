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
   * Writes incremental problems as data files into the output folder. They are the
   * problems of selected steps, and of steps that did not converge.
   */
  class Freezer : public dealii::ParameterAcceptor
  {
  public:
    Freezer();

    /** Checks the options. @throws InputError for steps outside the loading
     *  programme, and for features that frozen problems cannot represent */
    void
    check(const Scene &scene) const;

    /** Sets the output folder. @param folder existing folder of the run */
    void
    prepare(const std::string &folder);

    /** Returns true if any incremental problems are selected for output. They are
     *  selected by step, or as all steps that do not converge. */
    bool
    is_used() const
    {
      return failures || !steps.empty();
    }

    /** Sets the number of the current step of the loading programme. */
    void
    set_step(const unsigned int number);

    /**
     * Writes the incremental problem of a selected or failed step to a file. The
     * problem is written if its step is selected (first attempt only), or if the
     * attempt did not converge and failures are selected. Collective.
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
