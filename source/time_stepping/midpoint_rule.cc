// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/time_stepping/midpoint_rule.h>

namespace geocone
{
  EndOfStep
  end_of_step(const Integration     integration,
              const InternalForces &solved,
              const unsigned int    point,
              const Material       &material,
              const Mandel         &stress_n,
              const double         *history)
  {
    const Mandel stress  = solved.trial_stress()[point];
    const Mandel plastic = solved.plastic_strain_increment(point);
    if (integration == Integration::backward_euler)
      return {stress, plastic, stress.dot(plastic)};
    const Mandel beyond = 2. * stress - stress_n;
    const Mandel end    = material.nearest_admissible(beyond, history);
    const Mandel back   = material.elasticity().strain(Mandel(beyond - end));
    return {end,
            Mandel(2. * plastic + back),
            2. * stress.dot(plastic) + stress.dot(back)};
  }

  void
  extrapolate(const Integration          integration,
              const std::vector<double> &history_n,
              std::vector<double>       &history)
  {
    if (integration == Integration::midpoint)
      for (std::size_t i = 0; i < history.size(); ++i)
        history[i] = 2. * history[i] - history_n[i];
  }
} // namespace geocone
