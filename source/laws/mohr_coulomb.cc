// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/cone/varying_cone.h>
#include <geocone/kernels/cone_kernel.h>
#include <geocone/laws/mohr_coulomb.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  void
  MohrCoulomb::prepare()
  {
    Frictional::prepare();
    anisotropy.prepare(parameter(), given);
    set_cone(1.);
    memory.prepare(*this, cone.b < cone.a);
  }

  void
  MohrCoulomb::set_cone(const double F)
  {
    const FrictionalStrength now = given.reduced(F);
    cone                         = cone_of(now.c, now.phi, now.theta);
    cone.cut_off                 = sqrt2 * now.tension;
    k_per_cohesion               = cone_of(1. / F, now.phi, now.theta).k;
  }

  std::optional<FlowCone>
  MohrCoulomb::flow_cone(const double *history) const
  {
    FlowCone here = cone;
    here.k += k_per_cohesion * cohesion_increase(history);
    return here;
  }

  FlowCone
  MohrCoulomb::cone_of(const double cohesion,
                       const double phi,
                       const double theta)
  {
    FlowCone cone;
    cone.a = std::sin(radians(phi));
    cone.b = std::min(std::sin(radians(theta)), cone.a);
    cone.k = sqrt2 * cohesion * std::cos(radians(phi));
    return cone;
  }

  void
  MohrCoulomb::reduce_strength(const double F)
  {
    if (has_history() && n_history() > MohrCoulomb::n_history())
      Material::reduce_strength(F);
    set_cone(F);
  }

  void
  MohrCoulomb::set_friction_memory(const double time)
  {
    if (FrictionMemory::is_hard(non_associativity(), cone.a - cone.b))
      memory.set_automatic(time);
  }

  std::optional<FlowCone>
  MohrCoulomb::step_cone(const Mandel   &stress_n,
                         const double   *history_n,
                         const StepData &step) const
  {
    return with_memory(*flow_cone(history_n), stress_n, history_n, step);
  }

  FlowCone
  MohrCoulomb::with_memory(const FlowCone &exact,
                           const Mandel   &stress_n,
                           const double   *history_n,
                           const StepData &step) const
  {
    const FrictionHistory friction_history =
      friction_history_of(step, history_n, to_cone_axes(stress_n)[0]);
    return friction_history.part > 0.
             ? exact.delayed(friction_history.part, friction_history.stress)
             : exact;
  }

  Mode
  MohrCoulomb::return_to_cone(const Elasticity &elastic,
                              const Mandel     &trial,
                              const Mandel     &stress_n,
                              const double     *history_n,
                              const StepData   &step,
                              Mandel           &stress,
                              double           &slip,
                              MandelMatrix     *tangent) const
  {
    const double K = elastic.normal_stiffness(), two_G = elastic.two_G;
    if (varies())
      return return_map_varying(
        [&](const double g) { return *end_cone(stress_n, history_n, step, g); },
        K,
        two_G,
        trial,
        stress,
        tangent,
        slip);
    const Mode mode = return_map(
      *step_cone(stress_n, history_n, step), K, two_G, trial, stress, tangent);
    slip = FlowCone::tangential_norm(Mandel(trial - stress)) / two_G;
    return mode;
  }

  std::optional<FlowCone>
  MohrCoulomb::strength(const double *history) const
  {
    const std::optional<FlowCone> exact = flow_cone(history);
    return memory.time() > 0. ? exact->delayed(1., history[index_of_memory()])
                              : exact;
  }

  void
  MohrCoulomb::advance(const PointBlock &block, LawCounts &counts) const
  {
    const bool only_has_memory = memory.time() > 0. && !cohesion_grows() &&
                                 has_constant_stiffness() &&
                                 n_history() == MohrCoulomb::n_history();
    if (!only_has_memory || cone.is_cut())
      return Material::advance(block, counts);
    counts.updates += block.n_points;
    advance_cone(cone,
                 elasticity(),
                 block,
                 memory.remembered(block.step),
                 index_of_memory());
  }

  void
  MohrCoulomb::update(const Increment &increment,
                      const Response  &response) const
  {
    const double       K               = elasticity().normal_stiffness();
    const double       two_G           = elasticity().two_G;
    const bool         linear          = response.tangent.size() > 0;
    const MandelMatrix elastic_tangent = elasticity().stiffness();
    const bool         fixed           = !has_history();
    const bool         is_plain = fixed && increment.step.friction_lag == 0.;
    const bool         uniform         = has_constant_stiffness();
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        const std::size_t first = increment.n_history * p;
        const Elasticity  elastic =
          uniform ? elasticity() : own_elasticity(increment.history_n + first);
        const Mandel trial =
          increment.stress_n[p] + elastic.stress(increment.strain[p]);
        const Mandel        in_axes = to_cone_axes(trial);
        Mandel              returned;
        MandelMatrix        tangent;
        MandelMatrix *const wanted = linear ? &tangent : nullptr;
        double              slip   = 0.;
        response.mode[p] =
          is_plain ? return_map(cone, K, two_G, in_axes, returned, wanted)
                   : return_to_cone(elastic,
                                    in_axes,
                                    increment.stress_n[p],
                                    increment.history_n + first,
                                    increment.step,
                                    returned,
                                    slip,
                                    wanted);
        if (!fixed && response.history != nullptr)
          {
            double *history = response.history + first;
            if (memory.time() > 0.)
              history[index_of_memory()] = memory.next(
                history[index_of_memory()], returned[0], increment.step.size);
            add_to_history(slip, history);
          }
        // Elastic points keep their trial stress exactly.
        const bool is_elastic = response.mode[p] == Mode::elastic;
        response.stress[p]    = is_elastic ? trial : from_cone_axes(returned);
        if (linear)
          response.tangent[p] = !is_elastic ? from_cone_axes(tangent)
                                : uniform   ? elastic_tangent
                                            : elastic.stiffness();
      }
  }
} // namespace geocone::GEOCONE_DIM
