// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_gradients_h
#define geocone_limit_analysis_gradients_h

#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/output/expectations.h>

#include <array>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Dependence of both bounds on one parameter p, all others constant. */
  struct Gradient
  {
    std::array<std::string, 3> place; ///< as in the topic, below
    std::string                unit;  ///< of p
    double                     value =
      0.; ///< p; of a load the mean unit weight or largest traction

    /** Lower and upper: derivatives with respect to p, and d ln bound/d ln p; of a
     *  friction angle per degree, and d ln bound/d ln tan(phi). Not a number where
     *  that bound is not certified. */
    std::array<double, 2> derivative, elasticity;
  };

  /** A problem solved for one bound. */
  struct SolvedBound
  {
    const BoundScene            &scene;
    const CertifiedBounds::Side &side;
    double                       F = 1.; ///< by which the strength is divided
  };

  /**
   * Gradients of both bounds of a load from their fields, without another solution. At
   * the optimum the derivative of the load is that of the Lagrangian,
   *   lambda + q.(F0 + lambda f - sum V B's) + sum V y (a s_n + k - |s_t|),
   * with the rates y of the cones: sum V y per k, sum V y s_n per a, and -q.dF per dead
   * load. For the upper bound's strengths k and loads this is the derivative of a
   * certified bound, since its mechanism is admissible whatever they are.
   *
   * Places are those of the topic: materials (cohesion, cohesion_gradient,
   * friction_angle if it is not zero, tensile_strength, unit_weight), tractions
   * (traction), obstacles (friction_coefficient, adhesion, tensile_strength), and others
   * (load: the forces of water and of free obstacles).
   *
   * @param given with the whole strength
   * @param load_unit load that a problem's 1 corresponds to
   */
  std::vector<Gradient>
  gradients_of_load(const BoundScene  &given,
                    const SolvedBound &lower,
                    const SolvedBound &upper,
                    const double       load_unit);

  /**
   * Gradients of the factor of safety, from those of the factor of all loads where the
   * strength is divided by F: dF/dp = -(d lambda/dp)/(d lambda/dF).
   * @param lower,upper near their roots
   */
  std::vector<Gradient>
  gradients_of_safety(const BoundScene  &given,
                      const SolvedBound &lower,
                      const SolvedBound &upper);

  /** Topic bounds/gradients. */
  Json
  topic_of(const std::vector<Gradient> &gradients);

  /** The elasticities, the largest first, as lines of text. */
  std::string
  text_of(const std::vector<Gradient> &gradients, const std::string &bounded);
} // namespace geocone::GEOCONE_DIM

#endif
