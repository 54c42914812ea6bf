// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/contact/obstacle_motions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    constexpr unsigned int n_sums = ObstacleMotions::n_sums;

    using MotionVector = Eigen::Matrix<double, n_motions, 1>;

    /** Balance of an obstacle at a motion: out-of-balance force, E, and the
     *  size of its sums. */
    struct BodyBalance
    {
      MotionVector            R = MotionVector::Zero();
      ObstacleMotions::Matrix E = ObstacleMotions::Matrix::Identity();
      double                  size;

      BodyBalance(const ObstacleBody &body,
                  const RigidMotion  &motion,
                  const double       *sums)
        : size(sums[n_sums - 1])
      {
        for (unsigned int k = 0; k < n_motions; ++k)
          if (body.is_free[k])
            {
              const double inertia = body.inertia[k];
              R[k] = inertia * (motion[k] - body.without_contact[k]) + sums[k];
              size += inertia *
                      (std::abs(motion[k]) + std::abs(body.without_contact[k]));
              for (unsigned int l = 0; l < n_motions; ++l)
                if (body.is_free[l])
                  E(k, l) = sums[n_motions + n_motions * k + l] +
                            (k == l ? inertia : 0.);
            }
      }
    };
    using Balances = std::vector<BodyBalance>;

    bool
    is_solved(const Balances &now)
    {
      return std::all_of(now.begin(), now.end(), [](const BodyBalance &body) {
        return body.R.norm() <= 1e-14 * body.size;
      });
    }

    /** Norm of all residuals, each over the diagonal of E at @p scale. */
    double
    norm(const Balances &at, const Balances &scale)
    {
      double sum = 0.;
      for (unsigned int o = 0; o < at.size(); ++o)
        for (unsigned int k = 0; k < n_motions; ++k)
          sum += at[o].R[k] * at[o].R[k] / scale[o].E(k, k);
      return std::sqrt(sum);
    }
  } // namespace

  void
  ObstacleMotions::begin_step(std::vector<ObstacleBody> of_step)
  {
    bodies = std::move(of_step);
    motion.clear();
    first_free.clear();
    n_free_motions = 0;
    for (const ObstacleBody &body : bodies)
      {
        // Initial guess of free motions: their last velocity, so that an
        // obstacle at rest remains at rest and free fall takes one iteration.
        // 'without_contact' would be a poor guess for a heavy body in long
        // steps.
        motion.push_back(body.without_contact);
        for (unsigned int k = 0; k < n_motions; ++k)
          if (body.is_free[k])
            motion.back()[k] = body.velocity_n[k];
        first_free.push_back(n_free_motions);
        n_free_motions += body.n_free();
      }
  }

  void
  ObstacleMotions::find(const Sums &sums)
  {
    inverse_E.assign(bodies.size(), ObstacleMotions::Matrix::Zero());
    out_of_balance_norm = 0.;
    if (n_free_motions == 0)
      return;
    const auto balance = [&]() {
      const std::vector<double> now = sums();
      Balances                  result;
      for (unsigned int o = 0; o < bodies.size(); ++o)
        result.emplace_back(bodies[o], motion[o], &now[n_sums * o]);
      return result;
    };

    // Backtracking line search.
    Balances now = balance();
    for (unsigned int iteration = 0; iteration < 50 && !is_solved(now);
         ++iteration)
      {
        const std::vector<RigidMotion> before = motion;
        const Balances                 old    = now;
        for (double step = 1.; step > 1e-4; step /= 2.)
          {
            for (unsigned int o = 0; o < bodies.size(); ++o)
              {
                const MotionVector change =
                  old[o].E.partialPivLu().solve(old[o].R);
                for (unsigned int k = 0; k < n_motions; ++k)
                  motion[o][k] = before[o][k] - step * change[k];
              }
            now = balance();
            if (norm(now, old) <= (1. - 0.1 * step) * norm(old, old))
              break;
          }
        if (norm(now, old) >= norm(old, old)) // rounding, or no improvement
          break;
      }
    for (unsigned int o = 0; o < bodies.size(); ++o)
      {
        out_of_balance_norm += now[o].R.norm();
        const ObstacleMotions::Matrix inverse = now[o].E.inverse();
        for (unsigned int k = 0; k < n_motions; ++k)
          for (unsigned int l = 0; l < n_motions; ++l)
            if (bodies[o].is_free[k] && bodies[o].is_free[l])
              inverse_E[o](k, l) = inverse(k, l);
      }
  }

  bool
  ObstacleMotions::are_loaded() const
  {
    for (const ObstacleBody &body : bodies)
      for (unsigned int k = 0; k < n_motions; ++k)
        if (body.is_free[k] && body.without_contact[k] != body.velocity_n[k])
          return true;
    return false;
  }

  void
  ObstacleMotions::balance(Eigen::VectorXd &inertia,
                           Eigen::VectorXd &out_of_balance) const
  {
    inertia.resize(n_free_motions);
    out_of_balance.resize(n_free_motions);
    for (unsigned int o = 0; o < bodies.size(); ++o)
      for_free(o, [&](const unsigned int k, const unsigned int number) {
        inertia[number] = bodies[o].inertia[k];
        out_of_balance[number] =
          bodies[o].inertia[k] * (motion[o][k] - bodies[o].without_contact[k]);
      });
  }

  ObstacleMotions::Kinetic
  ObstacleMotions::kinetic() const
  {
    Kinetic sum;
    for (unsigned int o = 0; o < bodies.size(); ++o)
      for_free(o, [&](const unsigned int k, const unsigned int) {
        const double y = motion[o][k], momentum = bodies[o].inertia[k] * y;
        sum.work += momentum * (y - bodies[o].velocity_n[k]);
        sum.energy += momentum * y / 2.;
      });
    return sum;
  }

  void
  ObstacleMotions::change(const Eigen::VectorXd &by)
  {
    for (unsigned int o = 0; o < bodies.size(); ++o)
      for_free(o, [&](const unsigned int k, const unsigned int number) {
        motion[o][k] += by[number];
      });
  }
} // namespace geocone::GEOCONE_DIM
