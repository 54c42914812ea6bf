// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/contact/condensed_contact.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone
{
  using Eigen::MatrixXd;
  using Eigen::Vector2d;
  using Eigen::VectorXd;

  double
  CondensedContact::tangential_rho(const Node &node) const
  {
    return K.diagonal().segment(node.first + 1, node.n_tangents).mean();
  }

  std::vector<CondensedContact::State>
  CondensedContact::states(const VectorXd &u) const
  {
    const VectorXd     r = K * u + c;
    std::vector<State> all;
    for (const Node &node : nodes)
      {
        const unsigned int i = node.first, m = node.n_tangents;
        const double       p     = r[i] - K(i, i) * (u[i] - node.least);
        State             &state = all.emplace_back();
        if (!(p >= -node.tension))
          continue;
        state.contact = Contact::stick;
        if (m == 0)
          continue;
        const double   bound = node.friction * p + node.adhesion;
        const VectorXd pull =
          r.segment(i + 1, m) - tangential_rho(node) * u.segment(i + 1, m);
        if (pull.norm() <= bound)
          continue;
        state.contact              = Contact::slip;
        state.direction            = pull / pull.norm();
        state.direction_derivative = MatrixXd::Zero(m, m);
        if (m > 1)
          state.direction_derivative =
            bound / pull.norm() *
            (MatrixXd::Identity(m, m) -
             state.direction * state.direction.transpose());
      }
    return all;
  }

  VectorXd
  CondensedContact::solve_for(const std::vector<State> &state) const
  {
    MatrixXd A = K;
    VectorXd b = -c;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        const Node        &node = nodes[k];
        const unsigned int i = node.first, m = node.n_tangents;
        if (state[k].contact == Contact::open)
          {
            b[i] -= node.tension;
            continue;
          }
        if (state[k].contact == Contact::slip)
          {
            const VectorXd &d = state[k].direction;
            const MatrixXd &direction_derivative =
              state[k].direction_derivative;
            MatrixXd of_pull = K.middleRows(i + 1, m);
            of_pull.middleCols(i + 1, m).diagonal().array() -=
              tangential_rho(node);
            A.middleRows(i + 1, m) -=
              node.friction * d * K.row(i) + direction_derivative * of_pull;
            b.segment(i + 1, m) += (node.friction * c[i] + node.adhesion) * d +
                                   direction_derivative * c.segment(i + 1, m);
          }
        else
          for (unsigned int t = i + 1; t <= i + m; ++t)
            {
              A.row(t).setZero();
              A(t, t) = K(t, t);
              b[t]    = 0.;
            }
        A.row(i).setZero();
        A(i, i) = K(i, i);
        b[i]    = K(i, i) * node.least;
      }
    return A.partialPivLu().solve(b);
  }

  CondensedContact::OfNode
  CondensedContact::solve_node(const Node &node, const OfNode &b) const
  {
    const unsigned int i = node.first, m = node.n_tangents;
    const MatrixXd     own  = K.block(i, i, m + 1, m + 1);
    const double       l    = node.least;
    OfNode             pull = -b;
    pull[0] -= node.tension;
    OfNode at = own.partialPivLu().solve(pull);
    if (at[0] > l)
      return at;
    at.setZero();
    at[0]          = l;
    const OfNode r = b + own.col(0) * l;
    const double bound =
      node.friction * std::max(r[0], -node.tension) + node.adhesion;
    double square = 0.; // of r_T
    for (unsigned int t = 1; t <= m; ++t)
      square += r[t] * r[t];
    if (m == 0 || (r[0] >= -node.tension && square <= bound * bound))
      return at;
    double least = std::numeric_limits<double>::infinity();
    OfNode best  = at;
    if (m > 1)
      {
        // Contact problem of this node alone, by the same equations.
        CondensedContact alone;
        alone.K     = own;
        alone.c     = b;
        alone.nodes = {node};

        alone.nodes[0].first = 0;
        VectorXd u           = at;
        for (unsigned int step = 0; step < 10 && least > 1e-13; ++step)
          {
            u = alone.solve_for(alone.states(u));
            if (!u.allFinite())
              break;
            if (const double lack = alone.error(u); lack < least)
              {
                least = lack;
                best  = u;
              }
          }
        return best;
      }
    // It slides against the sticking force.
    for (const double sign : {1., -1.})
      {
        const double slope = own(1, 1) - sign * node.friction * own(0, 1),
                     u_t =
                       (sign * (node.friction * r[0] + node.adhesion) - r[1]) /
                       slope,
                     r_n = r[0] + own(0, 1) * u_t;
        // Violation of the assumed state.
        const double lack =
          std::max({sign * u_t * own(1, 1), -node.tension - r_n, 0.}) +
          (slope > 0. ? 0. : 1.);
        if (std::isfinite(u_t) && lack < least)
          {
            least = lack;
            best  = Vector2d(l, u_t);
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
        const unsigned int i = node.first, n = node.n_tangents + 1;
        const OfNode       r = K.middleRows(i, n) * u + c.segment(i, n),
                     old     = u.segment(i, n);
        const OfNode now     = solve_node(node, r - K.block(i, i, n, n) * old);
        u.segment(i, n)      = now;
        change  = std::max(change, (K.block(i, i, n, n) * (now - old)).norm());
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
        const unsigned int i = node.first, m = node.n_tangents;
        const double       rho = K(i, i), w = u[i] - node.least,
                     q = std::max(r[i] - rho * w, -node.tension);
        double lack    = std::abs(r[i] - q);
        largest        = std::max({largest, std::abs(r[i])});
        if (m > 0)
          {
            const double bound =
              q > -node.tension ? node.friction * q + node.adhesion : 0.;
            VectorXd pull =
              r.segment(i + 1, m) - tangential_rho(node) * u.segment(i + 1, m);
            if (const double size = pull.norm(); size > bound)
              pull *= bound / size;
            lack    = std::hypot(lack, (r.segment(i + 1, m) - pull).norm());
            largest = std::max(largest, r.segment(i + 1, m).norm());
          }
        worst = std::max(worst, lack);
      }
    return worst / largest;
  }

  double
  CondensedContact::rounding(const VectorXd &u) const
  {
    const VectorXd summed = K.cwiseAbs() * u.cwiseAbs() + c.cwiseAbs();
    return std::numeric_limits<double>::epsilon() * summed.maxCoeff() /
           std::max((K * u + c).cwiseAbs().maxCoeff(),
                    std::numeric_limits<double>::min());
  }

  bool
  CondensedContact::solve(VectorXd &u) const
  {
    constexpr double tolerance = 1e-11, of_rounding = 10.;
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
      // A large error is not rounding, whose evaluation takes a product with K.
      return best_error <= tolerance ||
             (best_error < 1e-7 && best_error <= of_rounding * rounding(best));
    };
    // A repeated set starts a cycle. With two tangents, where directions vary
    // continuously, only the last set can repeat.
    std::vector<std::vector<State>> seen;
    const auto                      active_set = [&](std::vector<State> state) {
      for (int step = 0; step < most_steps; ++step)
        {
          if (std::find(seen.begin(), seen.end(), state) != seen.end())
            return false;
          seen.push_back(state);
          const VectorXd at = solve_for(state);
          if (keep(at))
            return true;
          if (at.allFinite())
            state = states(at);
        }
      return false;
    };
    State all_stick;
    all_stick.contact = Contact::stick;
    // From the initial guess, from all nodes sticking, and from sweeps as long
    // as they change the result.
    VectorXd swept = u;
    bool     done  = best_error <= tolerance || active_set(states(u)) ||
                active_set(std::vector<State>(nodes.size(), all_stick));
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; !done && round < rounds; ++round)
      {
        double change = last;
        for (int k = 0; k < (25 << round) && change > tolerance; ++k)
          change = sweep(swept);
        done = keep(swept) || active_set(states(swept));
        if (!(change < last / 2.))
          break;
        last = change;
      }
    u = best;
    return done;
  }
} // namespace geocone
