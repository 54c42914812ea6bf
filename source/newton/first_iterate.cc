// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/newton/first_iterate.h>

namespace geocone::GEOCONE_DIM
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
} // namespace geocone::GEOCONE_DIM
