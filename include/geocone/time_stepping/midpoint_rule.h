// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_time_stepping_midpoint_rule_h
#define geocone_time_stepping_midpoint_rule_h

#include <geocone/base/choice.h>
#include <geocone/materials/material.h>
#include <geocone/mechanics/internal_forces.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone
{
  /** How a step from t to t + h is integrated. */
  enum class Integration
  {
    backward_euler,

    /** Backward Euler over h/2, and all that is linear in time doubled from there: of
     *  order two; elastic motion loses no energy. What is in contact stays at u_mid =
     *  -g/h, whose force does no positive work: energy never grows. */
    midpoint
  };

  inline Choice<Integration>
  integration_choice()
  {
    return {{{"backward Euler", Integration::backward_euler},
             {"midpoint", Integration::midpoint}}};
  }

  /** A step from t to t + h, and what is solved for. */
  struct TimeStep
  {
    double t, h;
    double solved_h;  ///< h, or h/2 by the midpoint rule
    double solved_at; ///< t + solved_h

    TimeStep(const Integration integration, const double t, const double h)
      : t(t)
      , h(h)
      , solved_h(integration == Integration::midpoint ? h / 2. : h)
      , solved_at(t + solved_h)
    {}
  };

  /** A point at the end of a step. */
  struct EndOfStep
  {
    Mandel stress;
    Mandel plastic;     ///< strain increment of the step
    double slip;        ///< its norm, with what is out of the plane
    double dissipation; ///< of the step, per volume (J/m^3)
  };

  /**
   * From what was solved for: by the midpoint rule the stress is extrapolated, and
   * taken back into what the soil can bear, by plastic strain. Gives the points their
   * histories, and nothing else yet.
   */
  std::vector<EndOfStep>
  end_step(const Integration     integration,
           const InternalForces &solved,
           const Materials      &materials,
           MaterialPoints       &points);

  /** @throws InputError for laws that it does not know, and for restitution @param name
   *  of the parameter */
  void
  check_midpoint(const Choice<Integration> &integration,
                 const Scene               &scene,
                 const std::string         &name);
} // namespace geocone

#endif
