// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_obstacle_motions_h
#define geocone_contact_obstacle_motions_h

#include <geocone/shapes/rigid_motion.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Prescribed and free rigid motions of an obstacle in a step. */
  struct ObstacleBody
  {
    /** Velocity y_0 of the obstacle at the end of the step in the absence of
     *  contact forces. */
    RigidMotion without_contact;

    std::array<bool, RigidMotion::n_components> is_free = {};

    RigidMotion inertia;    ///< M/h of the free motions
    RigidMotion velocity_n; ///< velocities y_n of the free motions at t_n

    unsigned int
    n_free() const
    {
      return std::count(is_free.begin(), is_free.end(), true);
    }
  };

  /**
   * Velocities y of the obstacles at the end of a step. Velocities of driven
   * obstacles are prescribed; velocities of free obstacles balance the forces q_i
   * of the contact nodes,
   *   M (y - y_0)/h + sum_i G_i' q_i(y) = 0,
   * with as many equations as free motions, solved by Newton's method with E =
   * M/h + sum rho G' Q G. The sums are supplied by the caller; see Contact.
   */
  class ObstacleMotions
  {
  public:
    using Matrix = Eigen::
      Matrix<double, RigidMotion::n_components, RigidMotion::n_components>;

    void
    begin_step(std::vector<ObstacleBody> bodies);

    /** Function that sums contact forces and their derivatives over the nodes of
     *  each obstacle. It returns, for each obstacle in turn, sum G' q, sum rho G'
     *  Q G by rows, and the sum of magnitudes, at the current motions; summed
     *  over all ranks. */
    using Sums = std::function<std::vector<double>()>;
    static constexpr unsigned int n_sums =
      n_motions + n_motions * n_motions + 1;

    /** Solves for the velocities of the free motions by Newton's method, with the
     *  last velocities as initial guess. Collective if @p sums is. */
    void
    find(const Sums &sums);

    unsigned int
    n_obstacles() const
    {
      return bodies.size();
    }

    bool
    is_free(const unsigned int obstacle) const
    {
      return bodies[obstacle].n_free() > 0;
    }

    /** Returns true if a load acts along a free motion of any obstacle. */
    bool
    are_loaded() const;

    /** Total number of free motions over all obstacles. */
    unsigned int
    n_free() const
    {
      return n_free_motions;
    }

    const std::vector<RigidMotion> &
    velocities() const
    {
      return motion;
    }

    /** Mobility matrix of an obstacle: velocity increments of the free motions
     *  due to unit forces and moments. Zero for driven motions. */
    const Matrix &
    mobility(const unsigned int obstacle) const
    {
      return inverse_E[obstacle];
    }

    /** Norm of the out-of-balance forces of all obstacles (N/m). */
    double
    error() const
    {
      return out_of_balance_norm;
    }

    /** Calls f(motion, number) for each free rigid-body motion of an obstacle,
     *  where number is the index of the motion among the free motions of all
     *  obstacles. */
    template <typename Function>
    void
    for_free(const unsigned int obstacle, const Function &f) const
    {
      unsigned int number = first_free[obstacle];
      for (unsigned int k = 0; k < n_motions; ++k)
        if (bodies[obstacle].is_free[k])
          f(k, number++);
    }

    /** Computes the inertia M/h of the free obstacle motions y and the
     *  out-of-balance forces M/h (y - y_0), with mass M and step size h.
     *  Contact forces are not included. */
    void
    balance(Eigen::VectorXd &inertia, Eigen::VectorXd &out_of_balance) const;

    /** Kinetic energy and work of the free obstacle motions, both divided by the
     *  step size h (W/m). The energy is y'M y/2, the work done on the motions is
     *  y'M (y - y_n). */
    struct Kinetic
    {
      double work = 0., energy = 0.;
    };
    Kinetic
    kinetic() const;

    /** Corrects the initial guess for the velocities of obstacles, used by the
     *  next call to find(). */
    void
    change(const Eigen::VectorXd &by);

  private:
    std::vector<ObstacleBody> bodies;
    std::vector<RigidMotion>  motion;
    std::vector<Matrix>       inverse_E;
    std::vector<unsigned int> first_free; ///< first free motion, by obstacle
    unsigned int              n_free_motions      = 0;
    double                    out_of_balance_norm = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
