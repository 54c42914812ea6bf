// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/reduced/one_cone.h>
#include <geocone/reduced/reduced_problem.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Natural-map error of an accepted solution, relative to the terms in it. */
    constexpr double tolerance = 1e-13;

    class OneCone
    {
    public:
      OneCone(const FlowCone &cone, const MandelMatrix &W, const Mandel &q)
        : cone(cone)
        , W(W)
        , q(q)
        , rho(natural_scale(W))
      {}

      /** Natural-map error relative to the size of the terms in it. */
      double
      error(const Mandel &s) const
      {
        const double terms = s.norm() + cone.k + rho * q.norm();
        return terms > 0.
                 ? natural_map_norm(cone, s, Mandel(W * s + q), rho) / terms
                 : 0.;
      }

      Mandel
      inside() const
      {
        return W.llt().solve(-q);
      }

      Mandel
      apex() const
      {
        return {-cone.k / cone.a, 0., 0.};
      }

      /** Function f for u = (0, cos x, sin x). */
      double
      f(const Mandel &u) const
      {
        return direction(u).dot(moment(u));
      }

      /** Newton's method for f, for a tangential unit vector. */
      Mandel
      polished(Mandel u) const
      {
        for (unsigned int i = 0; i < 10; ++i)
          {
            const Mandel v(0., -u[2], u[1]), Wv = W * v;
            const double slope = direction(u).dot(cone.a * Wv.cross(q) +
                                                  cone.k * W.col(0).cross(Wv)) -
                                 v.dot(moment(u));
            const double turn = f(u) / slope;
            if (!std::isfinite(turn))
              break;
            u = (u - turn * v).normalized();
            if (std::abs(turn) < 1e-15)
              break;
          }
        return u;
      }

      /** Stress on the surface for a root of f. */
      Mandel
      on_surface(const Mandel &u) const
      {
        // d is normal to v and m: two equations for s_n, either of which may be
        // degenerate if b < a.
        const Mandel v(0., -u[2], u[1]);
        const Mandel m  = (Mandel::UnitX() + cone.b * u).normalized();
        const Mandel p  = W * (Mandel::UnitX() + cone.a * u);
        const Mandel c  = cone.k * W * u + q;
        const double mp = m.dot(p), vp = v.dot(p);
        const double s_n =
          -(mp * m.dot(c) + vp * v.dot(c)) / (mp * mp + vp * vp);
        return s_n * Mandel::UnitX() + (cone.a * s_n + cone.k) * u;
      }

      /** Values of u near the real roots of f. */
      std::vector<Mandel>
      directions() const
      {
        // f(x) = A_0 + sum_i A_i cos(i x) + B_i sin(i x) from five values.
        constexpr unsigned int n = 5;
        std::array<double, n>  values;
        const auto angle = [](const int j) { return 2. * pi * j / n; };
        for (unsigned int j = 0; j < n; ++j)
          values[j] = f(unit(angle(j)));
        // With y = x - x_0 and t = tan(y/2), f becomes a polynomial of degree 4 in t,
        // whose leading coefficient is the value opposite to x_0: the largest is
        // chosen.
        const unsigned int opposite =
          std::max_element(values.begin(),
                           values.end(),
                           [](const double x, const double y) {
                             return std::abs(x) < std::abs(y);
                           }) -
          values.begin();
        std::vector<Mandel> result;
        const double        largest = values[opposite];
        if (largest == 0.)
          return result;
        std::array<double, 3> A{}, B{};
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < 3; ++i)
            {
              // The value opposite to x_0 has y = pi.
              const double y = pi + angle(int(j) - int(opposite));
              const double w = (i == 0 ? 1. : 2.) / n * values[j] / largest;
              A[i] += w * std::cos(i * y);
              B[i] += w * std::sin(i * y);
            }
        Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
        companion.diagonal(-1).setOnes();
        companion.col(3) << -(A[0] + A[1] + A[2]), -(2. * B[1] + 4. * B[2]),
          -(2. * A[0] - 6. * A[2]), -(2. * B[1] - 4. * B[2]);
        const Eigen::EigenSolver<Eigen::Matrix4d> roots(companion, false);
        for (const auto &t : roots.eigenvalues())
          // Near a double root, rounding shifts a pair of roots by the square root of
          // its size.
          if (std::abs(t.imag()) < 1e-4 * (1. + std::abs(t.real())))
            result.push_back(
              unit(angle(opposite) - pi + 2. * std::atan(t.real())));
        return result;
      }

    private:
      static Mandel
      unit(const double x)
      {
        return {0., std::cos(x), std::sin(x)};
      }

      Mandel
      direction(const Mandel &u) const
      {
        return cone.b * Mandel::UnitX() - u;
      }

      Mandel
      moment(const Mandel &u) const
      {
        const Mandel Wn = W.col(0), Wu = W * u;
        return (Wn + cone.a * Wu).cross(q) + cone.k * Wn.cross(Wu);
      }

      const FlowCone     &cone;
      const MandelMatrix &W;
      const Mandel       &q;
      const double        rho;
    };
  } // namespace

  OneConeSolutions
  one_cone_solutions(const FlowCone     &cone,
                     const MandelMatrix &W,
                     const Mandel       &q)
  {
    const OneCone    problem(cone, W, q);
    OneConeSolutions solutions;
    Mandel           best       = Mandel::Zero();
    double           best_error = std::numeric_limits<double>::infinity();
    const auto       add        = [&](const Mandel &s) {
      const double error = problem.error(s);
      if (error < best_error)
        {
          best       = s;
          best_error = error;
        }
      if (!(error <= tolerance))
        return;
      for (int i = 0; i < solutions.cols(); ++i)
        if ((solutions.col(i) - s).norm() <= 1e-7 * (s.norm() + cone.k))
          return;
      solutions.conservativeResize(Eigen::NoChange, solutions.cols() + 1);
      solutions.rightCols<1>() = s;
    };
    add(problem.inside());
    if (cone.a > 0.)
      add(problem.apex());
    for (const Mandel &u : problem.directions())
      add(problem.on_surface(problem.polished(u)));
    if (solutions.cols() == 0)
      solutions = best;
    return solutions;
  }

  Mandel
  solve_one_cone(const FlowCone     &cone,
                 const MandelMatrix &W,
                 const Mandel       &q,
                 const Mandel       &guess)
  {
    const OneCone problem(cone, W, q);
    const double  tangential = FlowCone::tangential_norm(guess);
    // The computed radius is a difference: at the apex it may be rounding error.
    const double outside = tangential - cone.a * guess[0] - cone.k +
                           1e-12 * (cone.a * std::abs(guess[0]) + cone.k);
    const bool on_surface = outside >= 0.;
    if (on_surface && tangential > 0.)
      {
        Mandel u = guess / tangential;
        u[0]     = 0.;
        if (const Mandel s = problem.on_surface(problem.polished(u));
            problem.error(s) <= tolerance)
          return s;
      }
    else if (on_surface && cone.a > 0.)
      {
        if (const Mandel s = problem.apex(); problem.error(s) <= tolerance)
          return s;
      }
    else if (const Mandel s = problem.inside(); problem.error(s) <= tolerance)
      return s;

    const OneConeSolutions solutions = one_cone_solutions(cone, W, q);
    int                    nearest;
    (solutions.colwise() - guess).colwise().squaredNorm().minCoeff(&nearest);
    return solutions.col(nearest);
  }
} // namespace geocone::GEOCONE_DIM
