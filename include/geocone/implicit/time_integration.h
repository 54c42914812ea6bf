// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_time_integration_h
#define geocone_implicit_time_integration_h

#include <geocone/base/choice.h>
#include <geocone/conditions/constraints.h>
#include <geocone/materials/material.h>
#include <geocone/problem/internal_forces.h>
#include <geocone/scene/scene.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Time integration of a step from t to t + h. */
  enum class Integration
  {
    backward_euler,

    /** Theta-scheme with theta = 1/2: of order two, without loss of energy in
     *  elastic motion. Nodes in contact stay at u_mid = -g/h, whose force does
     *  no positive work: energy never grows. */
    midpoint,

    /** Backward Euler over theta h, with linear extrapolation of all quantities
     *  to t + h. */
    theta_scheme,

    /** Newmark's formulas for displacement and velocity; the law holds at t + h. */
    newmark
  };

  /** A step from t to t + h, and the problem solved for it: backward Euler for
   *  a velocity v, by which points move h v. */
  struct TimeStep
  {
    double t, h;
    double solved_h;      ///< strain increments: theta h, or h
    double solved_at;     ///< time of loads and stresses
    double prescribed_at; ///< time of prescribed velocities

    double extrapolation; ///< e of TimeIntegration::end_velocity()
    double predictor;     ///< h (1/2 - beta) by Newmark, or 0 (s)
    double corrector;     ///< h (1/2 - gamma + beta) by Newmark, or 0 (s)
    double start_part; ///< of s^n in the stress that dissipates: 1/2 by Newmark

    /** Extrapolation of stresses, strains and dissipation: 1/theta, or 1. */
    double
    stress_extrapolation() const
    {
      return h / solved_h;
    }
  };

  /**
   * Time integration of the steps of FEM and implicit MPM.
   *
   * Theta-scheme, theta in [1/2, 1] (1: backward Euler, 1/2: midpoint rule):
   * the problem is solved over theta h from v^n, s^n, and v^{n+1} = v^n + (v -
   * v^n)/theta.
   *
   * Newmark (gamma, beta): with M a = F - sum V B's at t_n and t_{n+1},
   *   h v = u^{n+1} - u^n = h v^n + h^2 ((1/2 - beta) a^n + beta a^{n+1}),
   *   v^{n+1} = v^n + h ((1 - gamma) a^n + gamma a^{n+1}).
   * The problem is solved over h with the mass M/beta from vL = v^n + h (1/2 -
   * beta) a^n. No acceleration is stored: a^n follows from forces and stresses
   * at t_n.
   */
  class TimeIntegration
  {
  public:
    /** Declares its parameters in the section of an acceptor. */
    void
    declare(dealii::ParameterAcceptor &acceptor,
            const std::string         &documentation);

    /** @param section of the parameters, with a slash @throws InputError */
    void
    check(const Scene &scene, const std::string &section) const;

    bool
    is_backward_euler() const
    {
      return rule == Integration::backward_euler;
    }

    bool
    is_newmark() const
    {
      return rule == Integration::newmark;
    }

    /** Value of the parameter. */
    std::string
    word() const
    {
      return rule.word();
    }

    TimeStep
    step(const double t, const double h) const;

    /** Mass of the problem that is solved: M, or M/beta, which is stored
     *  here. */
    const Vector &
    mass_of_problem(const Vector &lumped_mass);

    /**
     * Newmark's prediction: v += h (1/2 - beta) a, a = M^-1 f; prescribed
     * velocities have their mean acceleration in the step.
     * @param net_force f at t_n, external less internal forces, along rotated
     * dofs
     */
    void
    predict(const TimeStep    &step,
            const Vector      &net_force,
            const Vector      &lumped_mass,
            const Constraints &constraints,
            Vector            &velocity);

    /** Velocity at t + h: vL + e (v - vL) + h (1/2 - gamma + beta) a. */
    Vector
    end_velocity(const TimeStep &step,
                 const Vector   &velocity_L,
                 const Vector   &v) const;

  private:
    void
    check_newmark(const Scene &scene, const std::string &section) const;
    void
    check_theta_scheme(const Scene &scene, const std::string &section) const;

    /** Theta: 1 for backward Euler, 1/2 for the midpoint rule. */
    double
    theta_of_rule() const;

    Choice<Integration> rule = {
      {{"backward Euler", Integration::backward_euler},
       {"midpoint", Integration::midpoint},
       {"theta-scheme", Integration::theta_scheme},
       {"Newmark", Integration::newmark}}};
    double theta = 0.5, gamma = 0.5, beta = 0.25;

    Vector scaled_mass;  ///< M/beta by Newmark
    Vector acceleration; ///< a^n of the last predict()
  };

  /** A point at the end of a step. */
  struct EndOfStep
  {
    Mandel stress;
    Mandel plastic;     ///< strain increment of the step
    double slip;        ///< its norm, including out-of-plane parts
    double dissipation; ///< of the step, per volume (J/m^3)
  };

  /**
   * State of the points at the end of the step from the solution. In the
   * theta-scheme the extrapolated stress is returned to the admissible set, by
   * plastic strain. Updates only the histories of the points.
   */
  std::vector<EndOfStep>
  end_step(const TimeStep       &step,
           const InternalForces &solved,
           const Materials      &materials,
           MaterialPoints       &points);
} // namespace geocone::GEOCONE_DIM

#endif
