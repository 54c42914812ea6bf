// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/problem/freezer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_freezer[] = {
      {"Output/Freeze steps", "Discretisation/Method", {"FEM", "MPM"}},
      {"Output/Freeze failures", "Discretisation/Method", {"FEM", "MPM"}}};
  } // namespace

  namespace
  {
    /** A run that fails at every step must not fill the disk. */
    constexpr unsigned int most_failures = 100;
  } // namespace

  Freezer::Freezer()
    : dealii::ParameterAcceptor("/Output")
  {
    add_parameter(
      "Freeze steps",
      steps,
      "Numbers of steps, from 1, whose incremental problems are written to "
      "frozen-STEP.h5, to be solved again by geocone-lab with other options. "
      "Of a subdivided step the first substep is written.",
      prm,
      dealii::Patterns::List(dealii::Patterns::Integer(1)));
    add_parameter("Freeze failures",
                  failures,
                  "Whether problems that did not converge are written to "
                  "failed-STEP-NUMBER.h5, at most 100.");
  }

  void
  Freezer::check(const Scene &scene) const
  {
    if (is_used())
      {
        const std::string remedy =
          "leave 'Output/Freeze steps' and 'Freeze failures' out";
        for (const auto &condition : scene.dirichlet.list)
          condition->refuse_normal("free where problems are frozen",
                                   "give Velocity x and y, or " + remedy);
        scene.refuse_contact("frozen problems", remedy);
        scene.absorbing.refuse("frozen problems", remedy);
        scene.structures.refuse("frozen problems", remedy);
      }
    std::size_t n_steps = 0;
    for (const auto &stage : scene.loading.list)
      n_steps += stage->step_sizes().size();
    for (const unsigned int number : steps)
      if (number > n_steps)
        throw InputError("Output/Freeze steps",
                         number,
                         format("1 to %zu, the steps of this run", n_steps),
                         "name steps that the run has");
  }

  void
  Freezer::prepare(const std::string &folder)
  {
    path = folder;
  }

  void
  Freezer::set_step(const unsigned int number)
  {
    step    = number;
    n_taken = 0;
  }

  void
  Freezer::take(const IncrementalProblem &problem,
                const Vector             &start,
                const bool                particles,
                const bool                converged)
  {
    const bool chosen =
      n_taken++ == 0 &&
      std::find(steps.begin(), steps.end(), step) != steps.end();
    const bool failed = failures && !converged && n_failures < most_failures;
    if (!chosen && !failed)
      return;
    FrozenProblem frozen = problem.freeze(start);
    frozen.particles     = particles;
    if (dealii::Utilities::MPI::this_mpi_process(
          start.get_mpi_communicator()) == 0)
      {
        if (chosen)
          frozen.write(path + format("/frozen-%u.h5", step));
        if (failed)
          frozen.write(path + format("/failed-%u-%u.h5", step, n_taken));
      }
    n_failures += failed;
  }
} // namespace geocone::GEOCONE_DIM
