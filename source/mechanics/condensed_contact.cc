// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/condensed_contact.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
{
  using Eigen::Matrix2d;
  using Eigen::Vector2d;
  using Eigen::VectorXd;

  std::vector<CondensedContact::State>
  CondensedContact::states(const VectorXd &u) const
  {
    const VectorXd     r = K * u + c;
    std::vector<State> all;
    for (const Node &node : nodes)
      {
        const unsigned int i   = node.first;
        const double       rho = K(i, i), p = r[i] - rho * (u[i] - node.least);
        if (!(p >= 0.))
          {
            all.push_back(State::open);
            continue;
          }
        const double bound = node.friction * p + node.adhesion,
                     pull =
                       node.rubs ? r[i + 1] - K(i + 1, i + 1) * u[i + 1] : 0.;
        all.push_back(!node.rubs || std::abs(pull) <= bound ? State::stick
                      : pull > 0.                           ? State::slip_forth
                                                            : State::slip_back);
      }
    return all;
  }

  VectorXd
  CondensedContact::solve_for(const std::vector<State> &state) const
  {
    Eigen::MatrixXd A = K;
    VectorXd        b = -c;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        const Node        &node = nodes[k];
        const unsigned int i    = node.first;
        if (state[k] == State::open)
          continue;
        if (node.rubs)
          {
            if (state[k] == State::stick)
              {
                A.row(i + 1).setZero();
                A(i + 1, i + 1) = K(i + 1, i + 1);
                b[i + 1]        = 0.;
              }
            else
              {
                const double sign = state[k] == State::slip_forth ? 1. : -1.;
                A.row(i + 1) -= sign * node.friction * K.row(i);
                b[i + 1] += sign * (node.friction * c[i] + node.adhesion);
              }
          }
        A.row(i).setZero();
        A(i, i) = K(i, i);
        b[i]    = K(i, i) * node.least;
      }
    return A.partialPivLu().solve(b);
  }

  Vector2d
  CondensedContact::solve_node(const Node &node, const Vector2d &b) const
  {
    const unsigned int i = node.first;
    if (!node.rubs)
      return {std::max(-b[0] / K(i, i), node.least), 0.};
    const Matrix2d own  = K.block<2, 2>(i, i);
    const Vector2d open = own.partialPivLu().solve(-b);
    if (open[0] > node.least)
      return open;
    const double l     = node.least;
    Vector2d     r     = b + own.col(0) * l;
    const double bound = node.friction * std::max(r[0], 0.) + node.adhesion;
    if (r[0] >= 0. && std::abs(r[1]) <= bound)
      return {l, 0.};
    // It slips against the force that it would take to stick.
    Vector2d best(l, 0.);
    double   least = std::numeric_limits<double>::infinity();
    for (const double sign : {1., -1.})
      {
        const double slope = own(1, 1) - sign * node.friction * own(0, 1),
                     u_t =
                       (sign * (node.friction * r[0] + node.adhesion) - r[1]) /
                       slope,
                     r_n = r[0] + own(0, 1) * u_t;
        // What such a state lacks.
        const double lack =
          std::max({sign * u_t * own(1, 1), -r_n, 0.}) + (slope > 0. ? 0. : 1.);
        if (std::isfinite(u_t) && lack < least)
          {
            least = lack;
            best  = {l, u_t};
          }
      }
    return best;
  }

  double
  CondensedContact::sweep(VectorXd &u) const
  {
    double change = 0., largest = std::numeric_limits<double>::min();
    for (const Node &node : nodes)
      {
        const unsigned int i = node.first, n = node.rubs ? 2 : 1;
        Vector2d           r = Vector2d::Zero(), old = Vector2d::Zero(), b;
        r.head(n)   = K.middleRows(i, n) * u + c.segment(i, n);
        old.head(n) = u.segment(i, n);
        b           = r;
        b.head(n) -= K.block(i, i, n, n) * old.head(n);
        const Vector2d now = solve_node(node, b);
        u.segment(i, n)    = now.head(n);
        change =
          std::max(change, (K.block(i, i, n, n) * (now - old).head(n)).norm());
        largest = std::max(largest, r.norm());
      }
    return change / largest;
  }

  double
  CondensedContact::error(const VectorXd &u) const
  {
    const VectorXd r       = K * u + c;
    double         largest = std::numeric_limits<double>::min(), worst = 0.;
    for (const Node &node : nodes)
      {
        const unsigned int i   = node.first;
        const double       rho = K(i, i), w = u[i] - node.least,
                     q = std::max(r[i] - rho * w, 0.);
        double lack    = std::abs(r[i] - q);
        largest        = std::max({largest, std::abs(r[i])});
        if (node.rubs)
          {
            const double bound =
                           q > 0. ? node.friction * q + node.adhesion : 0.,
                         pull = r[i + 1] - K(i + 1, i + 1) * u[i + 1];
            lack = std::hypot(lack, r[i + 1] - std::clamp(pull, -bound, bound));
            largest = std::max(largest, std::abs(r[i + 1]));
          }
        worst = std::max(worst, lack);
      }
    return worst / largest;
  }

  bool
  CondensedContact::solve(VectorXd &u) const
  {
    constexpr double tolerance  = 1e-11;
    constexpr int    most_steps = 25, rounds = 7;
    VectorXd         best       = u;
    double           best_error = error(u);
    const auto       keep       = [&](const VectorXd &at) {
      const double lack = at.allFinite() ? error(at) : 2. * best_error;
      if (lack < best_error)
        {
          best       = at;
          best_error = lack;
        }
      return best_error <= tolerance;
    };
    const auto active_set = [&](std::vector<State> state) {
      for (int step = 0; step < most_steps; ++step)
        {
          const VectorXd at = solve_for(state);
          if (keep(at))
            return true;
          std::vector<State> next = at.allFinite() ? states(at) : state;
          if (next == state)
            return false;
          state = std::move(next);
        }
      return false;
    };
    // From the start, from where all of them stick, and from where sweeps lead.
    VectorXd swept = u;
    bool     done  = best_error <= tolerance || active_set(states(u)) ||
                active_set(std::vector<State>(nodes.size(), State::stick));
    for (int round = 0; !done && round < rounds; ++round)
      {
        for (int k = 0; k < (25 << round) && sweep(swept) > tolerance; ++k)
          {}
        done = keep(swept) || active_set(states(swept));
      }
    u = best;
    return done;
  }
} // namespace geocone
