// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
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
    const Mandel        stress  = solved.trial_stress()[point];
    const SpatialMandel whole   = solved.plastic_strain_increment(point);
    const Mandel        plastic = whole.head<n_mandel>();
    if (integration == Integration::backward_euler)
      return {
        stress, plastic, whole.norm(), solved.whole_stress(point).dot(whole)};
    const Mandel beyond = 2. * stress - stress_n;
    const Mandel end    = material.nearest_admissible(beyond, history);
    const Mandel back   = material.elasticity().strain(Mandel(beyond - end));
    const Mandel all    = 2. * plastic + back;
    return {end, all, all.norm(), 2. * stress.dot(plastic) + stress.dot(back)};
  }

  void
  check_midpoint(const Choice<Integration> &integration,
                 const Materials           &materials,
                 const std::string         &name)
  {
    if (integration == Integration::midpoint && materials.are_spatial())
      throw InputError(name,
                       integration.word(),
                       "backward Euler with laws that are spatial",
                       "they do not say which stress their strength allows is "
                       "nearest to another");
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
