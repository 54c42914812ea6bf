// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, directions of Newton's method would not end where the laws of contact
// hold. Random bodies, condensed to 1 to 60 nodes: K is that of a chain of nodes on springs,
// turned at random, c pulls and presses, some nodes have no friction or adhesion, and
// in a second run some bear a pull. Nodes have one tangent, as in the plane, or two. The
// solution must fulfil the laws, one by one: not the root functions that solve() looks at.

#include <geocone/contact/condensed_contact.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

namespace mechanics_condensed_contact_01
{
  using namespace geocone;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  /** What the laws lack at u, over the largest force, or velocity at a unit stiffness. */
  double
  lack(const CondensedContact &problem, const VectorXd &u)
  {
    const VectorXd r     = problem.K * u + problem.c;
    const double   size  = r.cwiseAbs().maxCoeff() + u.cwiseAbs().maxCoeff();
    double         worst = 0.;
    for (const CondensedContact::Node &node : problem.nodes)
      {
        const unsigned int i = node.first, n_t = node.n_tangents;
        const double       w = u[i] - node.least, borne = r[i] + node.tension;
        worst =
          std::max({worst, -borne, -w, std::min(std::abs(borne), std::abs(w))});
        if (n_t == 0)
          continue;
        const double bound =
          std::abs(w) < 1e-9 * size ? node.friction * r[i] + node.adhesion : 0.;
        const VectorXd r_T = r.segment(i + 1, n_t), u_T = u.segment(i + 1, n_t);
        worst = std::max(worst, r_T.norm() - bound);
        // Where it slides, at the bound and against the motion.
        if (u_T.norm() > 1e-9 * size)
          worst = std::max({worst,
                            std::abs(r_T.norm() - bound),
                            (r_T + bound * u_T / u_T.norm()).norm()});
      }
    return worst / size;
  }

  /** @param n_t tangents of the nodes that rub
   *  @param pulled whether some bear a pull */
  void
  run(const unsigned int n_t, const bool pulled)
  {
    std::mt19937                           random(20);
    std::uniform_real_distribution<double> uniform(0., 1.);
    const auto in = [&](const double a, const double b) {
      return a + (b - a) * uniform(random);
    };
    unsigned int n_solved = 0, n_open = 0, n_stick = 0, n_slip = 0;
    double       worst = 0.;
    for (unsigned int trial = 0; trial < 300; ++trial)
      {
        const unsigned int n = 1 + static_cast<unsigned int>(in(0., 60.));
        CondensedContact   problem;
        unsigned int       m = 0;
        for (unsigned int k = 0; k < n; ++k)
          {
            const bool rubs = uniform(random) > 0.1;
            problem.nodes.push_back(
              {m,
               rubs ? n_t : 0,
               in(-1., 0.1),
               rubs && uniform(random) > 0.1 ? in(0., 1.) : 0.,
               rubs && uniform(random) > 0.98 ? in(0., 0.3) : 0.});
            m += rubs ? n_t + 1 : 1;
            if (pulled && uniform(random) > 0.7)
              {
                CondensedContact::Node &node = problem.nodes.back();
                node.tension                 = in(0., 0.3);
                // At the apex of the cone, or before it.
                node.adhesion =
                  rubs ? in(1., 2.) * node.friction * node.tension : 0.;
              }
          }
        // Springs between neighbours, and weak ones to the ground; normal and tangential
        // components are coupled.
        MatrixXd B = MatrixXd::Zero(2 * m, m);
        for (unsigned int i = 0; i < m; ++i)
          {
            B(i, i) = in(0.05, 0.3);
            for (unsigned int j = i; j < std::min(m, i + 4); ++j)
              B(m + i, j) = in(-1., 1.) * (j == i ? 1. : 0.7);
          }
        problem.K = B.transpose() * B;
        problem.c = VectorXd(m);
        for (double &force : problem.c)
          force = in(-1., 1.);
        VectorXd u = VectorXd::Zero(m);
        if (!problem.solve(u))
          continue;
        ++n_solved;
        worst            = std::max(worst, lack(problem, u));
        const VectorXd r = problem.K * u + problem.c;
        for (const CondensedContact::Node &node : problem.nodes)
          {
            const bool open = u[node.first] > node.least + 1e-9;
            n_open += open;
            if (!open && node.n_tangents > 0)
              ++(u.segment(node.first + 1, n_t).norm() > 1e-9 ? n_slip
                                                              : n_stick);
          }
      }
    // With friction, and more so with adhesion, which is there only where a node is closed, a
    // solution need not exist, and none be found where it does. With two tangents fewer nodes
    // stick, and Newton's method has to find the ways of those that slide.
    const unsigned int enough  = n_t == 1 ? 290 : 280,
                       of_each = n_t == 1 ? 500 : 200;
    const unsigned int least   = std::min({n_open, n_stick, n_slip});
    std::cout << n_t << " tangents" << (pulled ? ", some bear a pull" : "")
              << "\nsolved, of 300: "
              << (n_solved >= enough ? "at least " + std::to_string(enough)
                                     : std::to_string(n_solved))
              << std::endl;
    std::cout << "open, sticking and slipping nodes: "
              << (least > of_each
                    ? "more than " + std::to_string(of_each) + " each"
                    : "too few")
              << std::endl;
    std::cout << "the laws hold to 1e-8: " << (worst < 1e-8 ? "yes" : "no")
              << std::endl;
    if (!(worst < 1e-8))
      std::cout << worst << std::endl;
  }

  void
  test()
  {
    for (const unsigned int n_t : {1, 2})
      for (const bool pulled : {false, true})
        run(n_t, pulled);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_condensed_contact_01
