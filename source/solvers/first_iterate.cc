// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/reduction.h>
#include <geocone/solvers/first_iterate.h>
#include <geocone/solvers/gauss_seidel.h>

namespace geocone
{
  std::vector<Mandel>
  fixed_point_iterate(const unsigned int   n_iterations,
                      const StepWorkspace &work)
  {
    StepWorkspace::Jump jump      = work.jump();
    Vector              direction = work.problem.make_vector();
    work.record(work.evaluate(), 0., 0., 0.);
    if (!work.factorise(1.))
      return work.problem.internal_forces().trial_stress();
    for (unsigned int i = 0; i < n_iterations; ++i)
      {
        work.solve(i == 0 ? &jump.prescribed : nullptr, jump.defect, direction);
        work.v += direction;
        work.problem.set_prescribed(work.v);
        jump.defect = work.problem.free_dofs().multipliers.defect(work.v);
        work.record(work.evaluate(), 1., 1., 0.);
      }
    return work.problem.internal_forces().trial_stress();
  }

  std::vector<Mandel>
  gauss_seidel_iterate(const unsigned int n_sweeps, const StepWorkspace &work)
  {
    dealii::TimerOutput::Scope scope(work.timer, "solve");
    const Reduction            reduction(work.problem);
    Eigen::VectorXd            s = reduction.stress_at_start();
    GaussSeidel                sweeps;
    sweeps.tolerance  = 0.;
    sweeps.max_sweeps = n_sweeps;
    sweeps.solve(reduction.problem(), s);
    reduction.recover_velocity(s, work.v);
    std::vector<Mandel> stress;
    for (unsigned int p = 0; p < reduction.problem().n_cones(); ++p)
      stress.push_back(
        from_cone_axes(Mandel(s.segment<n_mandel>(n_mandel * p))));
    return stress;
  }
} // namespace geocone
