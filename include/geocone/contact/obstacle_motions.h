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
  /** How an obstacle moves in a step. */
  struct ObstacleBody
  {
    /** Its velocity y_0 at the end where nothing touches it. */
    RigidMotion without_contact;

    std::array<bool, RigidMotion::n_components> is_free = {};

    RigidMotion inertia;    ///< M/h of what is free
    RigidMotion velocity_n; ///< of what is free, at the start

    unsigned int
    n_free() const
    {
      return std::count(is_free.begin(), is_free.end(), true);
    }
  };

  /**
   * The velocities y of the obstacles at the end of a step: driven ones as they are
   * driven, of free ones those for which the forces q_i of the nodes that touch them are
   * in equilibrium with their own,
   *   M (y - y_0)/h + sum_i G_i' q_i(y) = 0,
   * as many equations as motions are free, found by Newton's method with E = M/h + sum rho G' Q G. Who
   * knows the nodes gives the sums; see Contact.
   */
  class ObstacleMotions
  {
  public:
    using Matrix = Eigen::
      Matrix<double, RigidMotion::n_components, RigidMotion::n_components>;

    void
    begin_step(std::vector<ObstacleBody> bodies);

    /** Of each obstacle in turn: sum G' q, sum rho G' Q G by rows, and the size of what
     *  is added, at the present motions, of all ranks. */
    using Sums = std::function<std::vector<double>()>;
    static constexpr unsigned int n_sums =
      n_motions + n_motions * n_motions + 1;

    /** Finds the motions of the free ones, from the last ones. Collective as the sums
     *  are. */
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

    /** Whether a load acts along a free motion of one of them. */
    bool
    are_loaded() const;

    /** Of all obstacles. */
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

    /** E^-1 of an obstacle, zero for what is driven. */
    const Matrix &
    mobility(const unsigned int obstacle) const
    {
      return inverse_E[obstacle];
    }

    /** What the equilibrium lacks (N/m), over all obstacles. */
    double
    error() const
    {
      return lack_of_all;
    }

    /** Calls f(motion, number) for each free motion of an obstacle. */
    template <typename Function>
    void
    for_free(const unsigned int obstacle, const Function &f) const
    {
      unsigned int number = first_free[obstacle];
      for (unsigned int k = 0; k < n_motions; ++k)
        if (bodies[obstacle].is_free[k])
          f(k, number++);
    }

    /** M/h of the free motions, and what the equilibrium of each lacks without the
     *  forces of nodes: M/h (y - y_0). */
    void
    balance(Eigen::VectorXd &inertia, Eigen::VectorXd &lack) const;

    /** y'M (y - y_n) and y'M y/2 of the free motions, over h (W/m). */
    struct Kinetic
    {
      double change = 0., energy = 0.;
    };
    Kinetic
    kinetic() const;

    /** Changes the velocities from which the next find() begins. */
    void
    change(const Eigen::VectorXd &by);

  private:
    std::vector<ObstacleBody> bodies;
    std::vector<RigidMotion>  motion;
    std::vector<Matrix>       inverse_E;
    std::vector<unsigned int> first_free; ///< number of an obstacle's first one
    unsigned int              n_free_motions = 0;
    double                    lack_of_all    = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
