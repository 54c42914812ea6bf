// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_gradients_h
#define geocone_limit_analysis_gradients_h

#include <geocone/folder/expectations.h>
#include <geocone/limit_analysis/certified_bounds.h>

#include <array>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Sensitivity of the lower and the upper bound to a parameter p, with all other
   *  parameters constant. */
  struct Gradient
  {
    std::array<std::string, 3> place; ///< keys in the topic, see below
    std::string                unit;  ///< unit of p
    double                     value =
      0.; ///< p; for a load, the mean unit weight or largest traction

    /** Derivatives of the lower and the upper bound with respect to a parameter
     *  p, and elasticities d ln bound/d ln p. For a friction angle they are
     *  derivatives per degree and d ln bound/d ln tan(phi). NaN if the bound is
     *  not certified. */
    std::array<double, 2> derivative, elasticity;
  };

  /** Input and solution of a lower-bound or upper-bound problem. */
  struct SolvedBound
  {
    const BoundScene            &scene;
    const CertifiedSide         &side;
    double                       F = 1.; ///< divisor of the strength
  };

  /** Derivative of a s_n + k with respect to ln tan(phi), for constant cohesion and
   *  normal stress s_n: a = sin(phi), and k is proportional to cos(phi). */
  double
  by_log_tan_phi(const PointCone &cone, const double s_n);

  /**
   * Computes the gradients of both bounds on a load with respect to all parameters. No
   * further solution is required, only the fields of the bounds. At the optimum the
   * derivative of the load is the derivative of the Lagrangian,
   *   lambda + q.(F0 + lambda f - sum V B's) + sum V y (a s_n + k - |s_t|),
   * with the rates y of the cones: sum V y per k, sum V y s_n per a, and -q.dF per dead
   * load. For the upper bound's strengths k and loads this is the derivative of a
   * certified bound, since its mechanism is admissible whatever they are.
   *
   * Places are those of the topic: materials (cohesion, cohesion_gradient, friction_angle
   * if it is not zero, tensile_strength, passive_strength_ratio and
   * simple_shear_strength_ratio if there are any, unit_weight), tractions (traction), obstacles
   * (friction_coefficient, adhesion, tensile_strength), and others (load: the forces of
   * water and of free obstacles).
   *
   * @param given input with unreduced strength
   * @param load_unit load that corresponds to the load factor 1 of a problem
   */
  std::vector<Gradient>
  gradients_of_load(const BoundScene  &given,
                    const SolvedBound &lower,
                    const SolvedBound &upper,
                    const double       load_unit);

  /**
   * Computes the gradients of both bounds on the factor of safety F. They follow from the
   * gradients of the factor lambda of all loads for strength divided by F: dF/dp = -(d
   * lambda/dp)/(d lambda/dF).
   * @param lower,upper solved near the roots lambda(F) = 1
   */
  std::vector<Gradient>
  gradients_of_safety(const BoundScene  &given,
                      const SolvedBound &lower,
                      const SolvedBound &upper);

  /** Converts gradients to the JSON object bounds/gradients of summary.json. */
  Json
  topic_of(const std::vector<Gradient> &gradients);

  /** Returns the elasticities of both bounds (relative change per relative
   *  change of a parameter) as lines of text, in descending order. */
  std::string
  text_of(const std::vector<Gradient> &gradients, const std::string &bounded);
} // namespace geocone::GEOCONE_DIM

#endif
