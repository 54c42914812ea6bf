// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/time_stepping/midpoint_rule.h>

namespace geocone
{
  namespace
  {
    /** @param history at the end */
    EndOfStep
    end_of_point(const Integration     integration,
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
      return {
        end, all, all.norm(), 2. * stress.dot(plastic) + stress.dot(back)};
    }
  } // namespace

  std::vector<EndOfStep>
  end_step(const Integration     integration,
           const InternalForces &solved,
           const Materials      &materials,
           MaterialPoints       &points)
  {
    std::vector<double> history = solved.trial_history();
    if (integration == Integration::midpoint)
      for (std::size_t i = 0; i < history.size(); ++i)
        history[i] = 2. * history[i] - points.history[i];
    std::vector<EndOfStep> ends;
    ends.reserve(points.n_points());
    for (unsigned int p = 0; p < points.n_points(); ++p)
      ends.push_back(
        end_of_point(integration,
                     solved,
                     p,
                     materials[points.material[p]],
                     points.stress[p],
                     history.data() + std::size_t(points.n_history()) * p));
    // Increments of the step are told from the histories at its beginning.
    points.history = std::move(history);
    return ends;
  }

  void
  check_midpoint(const Choice<Integration> &integration,
                 const Scene               &scene,
                 const std::string         &name)
  {
    if (integration != Integration::midpoint)
      return;
    if (scene.materials.are_spatial())
      throw InputError(name,
                       integration.word(),
                       "backward Euler with laws that are spatial",
                       "they do not say which stress their strength allows is "
                       "nearest to another");
    const auto check = [](const std::string &parameter, const double e) {
      if (e > 0.)
        throw InputError(parameter,
                         e,
                         "0 with Integration = midpoint",
                         "by the midpoint rule bodies rebound by their "
                         "elasticity alone: leave it out, or take backward "
                         "Euler");
    };
    for (const auto &obstacle : scene.obstacles.list)
      check(obstacle->parameter("Restitution"), obstacle->law.restitution);
    for (const auto &pair : scene.contacts.list)
      check("Contacts/" + pair->name + "/Restitution", pair->law.restitution);
  }
} // namespace geocone
