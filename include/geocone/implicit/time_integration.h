// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_implicit_time_integration_h
#define geocone_implicit_time_integration_h

#include <geocone/base/choice.h>
#include <geocone/conditions/constraints.h>
#include <geocone/materials/material.h>
#include <geocone/scene/scene.h>
#include <geocone/terms/internal_forces.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Time integration scheme of a step from t to t + h. */
  enum class Integration
  {
    backward_euler,

    /** Midpoint rule, the theta-scheme with theta = 1/2: second-order accurate,
     *  and energy-conserving in elastic motion. Nodes in contact remain at
     *  u_mid = -g/h, where the contact force does no positive work: the energy
     *  does not increase. */
    midpoint,

    /** Theta-scheme: backward Euler step of size theta h, then linear
     *  extrapolation to t + h. */
    theta_scheme,

    /** Newmark scheme in which the constitutive equations are satisfied at t +
     *  h. */
    newmark
  };

  /** Parameters of a time step from t to t + h. The incremental problem of the
   *  step is backward Euler for a velocity v, with displacement h v of the
   *  points. */
  struct TimeStep
  {
    double t, h;
    double solved_h;      ///< step of the problem: theta h, or h
    double solved_at;     ///< time of loads and stresses
    double prescribed_at; ///< time of prescribed velocities

    double extrapolation; ///< e of TimeIntegration::end_velocity()
    double predictor;     ///< h (1/2 - beta) by Newmark, or 0 (s)
    double corrector;     ///< h (1/2 - gamma + beta) by Newmark, or 0 (s)
    double start_part;    ///< weight of s^n in the dissipation

    /** Extrapolation factor of stresses, strains and dissipation: 1/theta for
     *  the theta-scheme, otherwise 1. */
    double
    stress_extrapolation() const
    {
      return h / solved_h;
    }
  };

  /**
   * Time integration schemes of FEM and implicit MPM.
   *
   * Theta-scheme, theta in [1/2, 1] (1: backward Euler, 1/2: midpoint rule):
   * the problem is solved over theta h from v^n, s^n, and v^{n+1} = v^n + (v -
   * v^n)/theta.
   *
   * Newmark (gamma, beta): with accelerations from M a = F - sum V B's at t_n
   * and t_{n+1},
   *   h v = u^{n+1} - u^n = h v^n + h^2 ((1/2 - beta) a^n + beta a^{n+1}),
   *   v^{n+1} = v^n + h ((1 - gamma) a^n + gamma a^{n+1}).
   * The problem is solved over h with the mass M/beta from vL = v^n + h (1/2 -
   * beta) a^n. No acceleration is stored: a^n follows from forces and stresses
   * at t_n.
   */
  class TimeIntegration
  {
  public:
    /** Declares the time integration parameters in the section of a parameter
     *  acceptor. */
    void
    declare(dealii::ParameterAcceptor &acceptor,
            const std::string         &documentation);

    /** Checks that the time integration scheme is available for a scene.
     *  @param section parameter section, with a slash @throws InputError */
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

    /** Parameter value that selects the time integration scheme. */
    std::string
    word() const
    {
      return rule.word();
    }

    TimeStep
    step(const double t, const double h) const;

    /** Lumped mass matrix in the incremental problem: M/beta for Newmark
     *  schemes, otherwise M. The scaled mass is stored in this object. */
    const Vector &
    mass_of_problem(const Vector &lumped_mass);

    /**
     * Applies Newmark's displacement predictor, written for the mean velocity
     * of the step (displacement increment / h): v += h (1/2 - beta) a, with the
     * acceleration a = M^-1 f at t_n. At prescribed dofs, a is the mean
     * acceleration in the step.
     * @param net_force f at t_n, external minus internal forces, in rotated
     * dofs
     */
    void
    predict(const TimeStep    &step,
            const Vector      &net_force,
            const Vector      &lumped_mass,
            const Constraints &constraints,
            Vector            &velocity);

    /** Computes the nodal velocities at t + h from the solution v of the
     *  incremental problem. They are vL + e (v - vL) + h (1/2 - gamma + beta)
     *  a, with e = TimeStep::extrapolation. */
    Vector
    end_velocity(const TimeStep &step,
                 const Vector   &velocity_L,
                 const Vector   &v) const;

  private:
    void
    check_newmark(const Scene &scene, const std::string &section) const;
    void
    check_theta_scheme(const Scene &scene, const std::string &section) const;

    /** Parameter theta of the selected scheme: 1 for backward Euler, 1/2 for
     *  the midpoint rule. */
    double
    theta_of_rule() const;

    Choice<Integration> rule = {
      {{"backward Euler", Integration::backward_euler},
       {"midpoint", Integration::midpoint},
       {"theta-scheme", Integration::theta_scheme},
       {"Newmark", Integration::newmark}}};
    double theta = 0.5, gamma = 0.5, beta = 0.25;

    Vector scaled_mass;  ///< M/beta by Newmark
    Vector acceleration; ///< a^n of the last predict() (m/s^2)
  };

  /** State of a material or quadrature point at the end of a step. */
  struct EndOfStep
  {
    Mandel stress;
    Mandel plastic;     ///< plastic strain increment
    double slip;        ///< norm of plastic, with out-of-plane part
    double dissipation; ///< dissipation density (J/m^3)
  };

  /**
   * Computes the state of all points at the end of a step from the solution of
   * the incremental problem. In the theta-scheme, the extrapolated stress is
   * returned onto the set of admissible stresses by additional plastic strain.
   * Of the points, only the history variables are updated.
   */
  std::vector<EndOfStep>
  end_step(const TimeStep       &step,
           const InternalForces &solved,
           const Materials      &materials,
           MaterialPoints       &points);
} // namespace geocone::GEOCONE_DIM

#endif
