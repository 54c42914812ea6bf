// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/laws/spatial_law.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  void
  SpatialLaw::update(const Increment &increment, const Response &response) const
  {
    const bool linear = response.tangent.size() > 0;
    for (std::size_t p = 0; p < increment.strain.size(); ++p)
      {
        const double *const history_n =
          increment.history_n + increment.n_history * p;
        const SpatialMandel stress_n =
          whole_stress(increment.stress_n[p], history_n);
        const SpatialMandel strain = extended(
          increment.strain[p],
          increment.strain_zz != nullptr ? increment.strain_zz[p] : 0.);
        SpatialMandel       stress;
        SpatialMandelMatrix C;
        double *const       history = response.history != nullptr
                                        ? response.history + increment.n_history * p
                                        : nullptr;
        response.mode[p]            = respond(strain,
                                   stress_n,
                                   history_n,
                                   increment.step,
                                   stress,
                                   history,
                                   linear ? &C : nullptr);
        response.stress[p]          = stress.head<n_mandel>();
        if (linear)
          response.tangent[p] = C.topLeftCorner<n_mandel, n_mandel>();
        if (linear && response.tangent_zz != nullptr)
          response.tangent_zz[p] = {C.block<n_mandel, 1>(0, 3),
                                    C.block<1, n_mandel>(3, 0).transpose(),
                                    C(3, 3)};
        if (response.stress_zz != nullptr)
          response.stress_zz[p] = stress[3];
        if (history != nullptr)
          Material::initialise(stress_of(stress), 0., history);
      }
  }

  std::optional<double>
  SpatialLaw::overstress(const Mandel &stress, const double *history) const
  {
    return yield_function(whole_stress(stress, history), history);
  }

  void
  FrictionalSpatialLaw::prepare()
  {
    Frictional::prepare();
    set_strength(1.);
    memory.prepare(*this, non_associativity() > 0.);
  }

  SpatialReturnMap::OwnStrength
  FrictionalSpatialLaw::own_strength(const SpatialMandel &stress_n,
                                     const double        *history_n,
                                     const StepData      &step) const
  {
    OwnStrength own;
    own.cohesion = cohesion_increase(history_n);
    if (non_associativity() > 0.)
      {
        const FrictionHistory friction_history =
          friction_history_of(step, history_n, normal_stress(stress_n));
        own.part   = friction_history.part;
        own.normal = friction_history.stress;
      }
    return own;
  }

  std::optional<FlowCheck>
  FrictionalSpatialLaw::check_flow(const PointStep &point,
                                   const StepData  &step) const
  {
    return check_plastic_strain(
      point.strain -
        elasticity().strain(SpatialMandel(point.stress - point.stress_n)),
      point.stress,
      own_strength(point.stress_n, point.history_n, step));
  }

  void
  FrictionalSpatialLaw::remember(const SpatialMandel &stress,
                                 const StepData      &step,
                                 double              *history) const
  {
    if (memory.time() > 0.)
      {
        double &p = history[index_of_memory()];
        p         = memory.next(p, normal_stress(stress), step.size);
      }
  }

  double
  FrictionalSpatialLaw::earth_pressure_at_rest() const
  {
    return 1. - std::sin(radians(given.phi));
  }
} // namespace geocone::GEOCONE_DIM
