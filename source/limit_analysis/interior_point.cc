// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/base/stop_request.h>
#include <geocone/limit_analysis/cone_algebra.h>
#include <geocone/limit_analysis/interior_point.h>
#include <geocone/limit_analysis/point_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector2d;
    using Eigen::Vector3d;
    using Eigen::VectorXd;
    using Points = std::vector<Vector3d>;
    using namespace cone_algebra;

    /** Stiffness of the method of multipliers for Tresca's normal stress; strength,
     *  lengths and velocities are of order one. */
    constexpr double bulk = 1e6;

    /** Load below all others, for inadmissible stresses. */
    constexpr double no_load = -std::numeric_limits<double>::infinity();

    class Solver
    {
    public:
      Solver(const BoundProblem &problem, const InteriorPoint::Options &options)
        : problem(problem)
        , options(options)
        , n(problem.n_points())
        , strains(scaled_strains(problem))
        , matrix(problem.is_prescribed, strains)
      {
        const double mean =
          std::accumulate(problem.volume.begin(), problem.volume.end(), 0.) / n;
        for (const double V : problem.volume)
          omega.push_back(V / mean);
      }

      BoundSolution
      solve();

    private:
      static PointStrains
      scaled_strains(const BoundProblem &problem)
      {
        PointStrains all = problem.B;
        for (unsigned int p = 0; p < problem.n_points(); ++p)
          if (!problem.cone[p].is_cylinder())
            all.divide_normal(p, problem.cone[p].a);
        return all;
      }

      Points
      rates(const VectorXd &velocities) const
      {
        return strains.rates(velocities);
      }

      VectorXd
      forces(const Points &s) const
      {
        return strains.forces(problem.volume, s, problem.n_dofs());
      }

      /** Stresses dual to Bs: x - o, or s_n and s_t of a cylinder. */
      Points
      stresses() const
      {
        Points s = x;
        for (unsigned int p = 0; p < n; ++p)
          s[p][0] =
            problem.cone[p].is_cylinder() ? s_n[p] : x[p][0] - strength(p);
        return s;
      }

      /** Strength k of a point less the margin. */
      double
      strength(const unsigned int p) const
      {
        return problem.cone[p].k - options.strength_margin;
      }

      VectorXd
      only_free(VectorXd f) const
      {
        for (unsigned int i = 0; i < f.size(); ++i)
          if (problem.is_prescribed[i])
            f[i] = 0.;
        return f;
      }

      void
      start();

      /** Residuals at the present iterate. */
      void
      evaluate();

      /** Direction of the iterate, with the largest steps of x and z along it. */
      struct Direction
      {
        Points                x, z;
        Points                scaled_x, scaled_z; ///< W^-1 dx, W dz
        VectorXd              s_n, q;
        double                lambda = 0.;
        std::array<double, 2> steps;

        double
        shorter() const
        {
          return std::min(steps[0], steps[1]);
        }
      };

      /** Newton direction for W^-1 dx + W dz = d. */
      Direction
      direction(const Points &d) const;

      /** Scales the iterate.
       *  @return whether the matrix of the directions could be factorised */
      bool
      factorise();

      /** Mehrotra's predictor-corrector direction (1992), with further correctors. */
      Direction
      centred_direction();

      /**
       * Gondzio's corrector (1996): with longer steps than the direction allows, points
       * would leave the neighbourhood of the central path; a right-hand side that moves
       * them back allows a longer step. It costs a solution but no factorisation.
       * @param target centre times mu
       * @param[in,out] d right-hand side
       * @return whether the direction was changed
       */
      bool
      correct(const double target, Points &d, Direction &along) const;

      /** Restores equilibrium in the metric of the cones, which limits their violation,
       *  until the residual no longer decreases. */
      void
      polish();

      /** Load of the stresses after scaling them back into their cones; no_load if that
       *  is impossible or equilibrium is violated. */
      double
      admissible_load() const;

      /** Keeps the polished stresses if their admissible load is higher than the best
       *  so far. The iterate does not change. */
      void
      keep_stresses();

      /** Whether the gap is closed, with velocities of admissible flow. */
      bool
      is_closed() const
      {
        return gap < allowed_gap() && flow < options.flow_tolerance &&
               std::abs(r_g) < options.tolerance;
      }

      double
      allowed_gap() const
      {
        return options.tolerance * std::abs(load);
      }

      /** @name Termination criteria; the solution then gives the reason */
      /** @{ */
      bool
      has_diverged();
      bool
      has_ended(const unsigned int iteration);
      /** Whether the question about the load is answered. */
      bool
      is_answered();
      /** @} */

      bool
      is_only_compared() const
      {
        return !std::isnan(options.question);
      }

      /** Counts iterates without progress towards admissible stresses. */
      void
      watch_stresses();

      /** Moves the iterate along a direction, up to a hundredth before the boundary of
       *  the cones. */
      void
      advance(const Direction &along);

      /** Copies the best stresses and the velocities into the solution. */
      void
      collect();

      const BoundProblem          &problem;
      const InteriorPoint::Options options;
      const unsigned int           n;
      const PointStrains           strains; ///< Bs
      PointMatrix                  matrix;
      std::vector<double>          omega;
      double                       margin = 0.; ///< of the cones of rates

      Points   x, z;
      VectorXd s_n, q;
      double   lambda = 0.;

      Points                  rate, r_p;
      VectorXd                r_d, x_2;
      double                  r_g = 0., mu = 0., gap = 0., load = 0.;
      double                  equilibrium = 0., flow = 0.;
      std::vector<Scaling<3>> scaling;
      Points                  scaled;         ///< W z = W^-1 x
      double                  last_step = 1.; ///< the shorter of the two

      Points kept; ///< stresses() of the best iterate, and their load
      double kept_load = 0., most_admissible = no_load;

      double       most         = 0.; ///< largest stress over strength
      unsigned int first_solved = options.max_iterations + 1;
      unsigned int n_without    = 0; ///< without progress
      double       smallest_gap = std::numeric_limits<double>::infinity(),
             least_equilibrium  = smallest_gap;

      BoundSolution solution;
    };

    void
    Solver::start()
    {
      PointMatrix::Blocks blocks(n);
      for (unsigned int p = 0; p < n; ++p)
        {
          blocks[p] = problem.volume[p] * Matrix3d::Identity();
          if (problem.cone[p].is_cylinder())
            blocks[p](0, 0) *= 100.;
        }
      matrix.factorise(blocks);
      q = problem.prescribed;
      if (problem.has_factor())
        {
          q += matrix.solve(problem.live);
          q /= problem.live.dot(q);
        }
      else
        {
          Points s = rates(q);
          for (unsigned int p = 0; p < n; ++p)
            if (problem.cone[p].is_cylinder())
              s[p][0] *= 100.;
          q -= matrix.solve(forces(s));
        }

      rate        = rates(q);
      double V    = 0.;
      double mean = 0.;
      z.resize(n);
      for (unsigned int p = 0; p < n; ++p)
        {
          z[p] = -omega[p] * rate[p];
          if (problem.cone[p].is_cylinder())
            z[p][0] = 0.;
          V += problem.volume[p];
          mean += problem.volume[p] * z[p].squaredNorm();
        }
      mean   = std::sqrt(mean / V);
      margin = options.flow_margin * mean;
      x.assign(n, Vector3d::Zero());
      for (unsigned int p = 0; p < n; ++p)
        {
          const PointCone &cone = problem.cone[p];
          z[p][0]          = std::max(z[p][0], z[p].tail<2>().norm() + mean);
          const double a   = std::min(cone.a, 0.9); // more: interfaces
          const double K_p = (1. + a) / (1. - a);
          // Positive also without cohesion.
          x[p][0] = cone.is_cylinder() ? strength(p)
                                       : K_p * K_p * std::max(cone.k, 0.1);
        }
      s_n.setZero(n);
      lambda = 0.;
    }

    void
    Solver::evaluate()
    {
      rate               = rates(q);
      const Points   s   = stresses();
      const VectorXd all = forces(s);
      r_d = only_free(all - lambda * problem.live - problem.dead);
      r_g = problem.has_factor() ? 1. - problem.live.dot(q) : 0.;
      r_p.resize(n);
      double product = 0., miss = 0., size = 0.;
      gap = 0.;
      for (unsigned int p = 0; p < n; ++p)
        {
          r_p[p] = z[p] + omega[p] * rate[p];
          if (problem.cone[p].is_cylinder()) // its normal rate must vanish
            r_p[p][0] = omega[p] * rate[p][0];
          else
            r_p[p][0] += omega[p] * margin;
          miss += problem.volume[p] * (r_p[p] / omega[p]).squaredNorm();
          if (problem.cone[p].is_cylinder())
            r_p[p][0] = 0.;
          size += problem.volume[p] * rate[p].squaredNorm();
          product += x[p].dot(z[p]);
          gap += problem.volume[p] * x[p].dot(z[p]) / omega[p];
        }
      mu   = product / (2. * n);
      flow = std::sqrt(miss / size);
      // Power of the reactions to prescribed velocities.
      load               = problem.has_factor()
                             ? lambda
                             : (all - problem.dead).dot(problem.prescribed);
      const double force = std::max({all.norm(), problem.dead.norm(), 1e-300});
      equilibrium        = r_d.norm() / force;
    }

    Solver::Direction
    Solver::direction(const Points &d) const
    {
      Direction along;
      Points    rhs(n), r_c(n);
      for (unsigned int p = 0; p < n; ++p)
        {
          r_c[p] = scaling[p].times(d[p]);
          if (problem.cone[p].is_cylinder())
            {
              const Eigen::Matrix2d S = scaling[p].tangential();
              rhs[p][0]               = bulk * rate[p][0];
              rhs[p].tail<2>() =
                scaling[p].eliminated(r_c[p]) + S * r_p[p].tail<2>();
            }
          else
            rhs[p] = r_c[p] + scaling[p].square_times(r_p[p]);
        }
      along.q = matrix.solve(-r_d - forces(rhs));
      if (problem.has_factor())
        {
          along.lambda =
            (r_g - problem.live.dot(along.q)) / problem.live.dot(x_2);
          along.q += along.lambda * x_2;
        }
      const Points e = rates(along.q);
      along.x.resize(n);
      along.z.resize(n);
      along.scaled_x.resize(n);
      along.scaled_z.resize(n);
      along.s_n.setZero(n);
      along.steps = {{1. / 0.99, 1. / 0.99}};
      for (unsigned int p = 0; p < n; ++p)
        {
          const Scaling<3> &scale = scaling[p];
          Vector3d         &dx = along.x[p], &dz = along.z[p];
          dz = -r_p[p] - omega[p] * e[p];
          if (problem.cone[p].is_cylinder())
            {
              const Vector2d dz_t = dz.tail<2>();
              dx[0]               = 0.;
              dx.tail<2>() =
                scale.eliminated(r_c[p]) - scale.tangential() * dz_t;
              dz[0]        = scale.first_rate(r_c[p][0], dz_t);
              along.s_n[p] = bulk * (rate[p][0] + e[p][0]);
            }
          else
            dx = r_c[p] - scale.square_times(dz);
          along.scaled_x[p] = scale.inverse_times(dx);
          along.scaled_z[p] = scale.times(dz);
          along.steps[0]    = std::min(along.steps[0],
                                    step_in_cone(scaled[p], along.scaled_x[p]));
          along.steps[1]    = std::min(along.steps[1],
                                    step_in_cone(scaled[p], along.scaled_z[p]));
        }
      return along;
    }

    bool
    Solver::factorise()
    {
      scaling.clear();
      scaled.resize(n);
      PointMatrix::Blocks blocks(n);
      for (unsigned int p = 0; p < n; ++p)
        {
          scaling.emplace_back(x[p], z[p]);
          scaled[p] = scaling[p].times(z[p]);
          blocks[p] = omega[p] * scaling[p].square();
          if (problem.cone[p].is_cylinder())
            {
              blocks[p].setZero();
              blocks[p](0, 0)             = bulk;
              blocks[p].block<2, 2>(1, 1) = omega[p] * scaling[p].tangential();
            }
          blocks[p] *= problem.volume[p];
        }
      return matrix.factorise(blocks);
    }

    Solver::Direction
    Solver::centred_direction()
    {
      if (problem.has_factor())
        x_2 = matrix.solve(problem.live);
      Points d(n);
      for (unsigned int p = 0; p < n; ++p)
        d[p] = -scaled[p];
      Direction    along  = direction(d);
      double       affine = 0.;
      const double a_x    = std::min(1., along.steps[0]),
                   a_z    = std::min(1., along.steps[1]);
      for (unsigned int p = 0; p < n; ++p)
        affine += (x[p] + a_x * along.x[p]).dot(z[p] + a_z * along.z[p]);
      affine /= 2. * n;
      // Stronger centring after a short step, as further short steps would follow.
      const double centre = std::max(std::pow(std::max(affine, 0.) / mu, 3),
                                     last_step < 0.15 ? 0.8 : 0.);
      for (unsigned int p = 0; p < n; ++p)
        {
          Vector3d c = -product(along.scaled_x[p], along.scaled_z[p]);
          c[0] += centre * mu;
          d[p] = -scaled[p] + divide(scaled[p], c);
        }
      along = direction(d);
      for (unsigned int k = 0; k < options.correctors; ++k)
        if (!correct(centre * mu, d, along))
          break;
      return along;
    }

    bool
    Solver::correct(const double target, Points &d, Direction &along) const
    {
      // Steps that are long enough; the attempted and the required increase of the
      // step; and the neighbourhood of the target for the eigenvalues.
      constexpr double enough = 0.5, longer = 0.1, gained = 0.01, near = 0.1;
      if (along.shorter() > enough)
        return false;
      const double t_x = std::min(1., along.steps[0] + longer),
                   t_z = std::min(1., along.steps[1] + longer);
      Points d_new     = d;
      for (unsigned int p = 0; p < n; ++p)
        {
          const Vector3d v = product<3>(scaled[p] + t_x * along.scaled_x[p],
                                        scaled[p] + t_z * along.scaled_z[p]);
          const double   T = v.tail<2>().norm();
          // Correction that moves an eigenvalue to the neighbourhood of the target.
          const auto moved = [&](const double x) {
            return std::max(std::clamp(x, near * target, target / near) - x,
                            -target / near);
          };
          const double a = moved(v[0] + T), b = moved(v[0] - T);
          if (a == 0. && b == 0.)
            continue;
          Vector3d w = Vector3d::Zero();
          w[0]       = (a + b) / 2.;
          if (T > 0.)
            w.tail<2>() = (a - b) / (2. * T) * v.tail<2>();
          d_new[p] += divide(scaled[p], w);
        }
      Direction next = direction(d_new);
      if (next.shorter() < along.shorter() + gained)
        return false;
      d     = std::move(d_new);
      along = std::move(next);
      return true;
    }

    void
    Solver::polish()
    {
      for (double before = 1.; equilibrium < before / 2.;)
        {
          before           = equilibrium;
          const VectorXd d = matrix.solve(-r_d);
          const Points   e = rates(d);
          for (unsigned int p = 0; p < n; ++p)
            if (problem.cone[p].is_cylinder())
              {
                s_n[p] += bulk * e[p][0];
                x[p].tail<2>() +=
                  scaling[p].tangential() * omega[p] * e[p].tail<2>();
              }
            else
              x[p] += scaling[p].square_times(omega[p] * e[p]);
          evaluate();
        }
    }

    double
    Solver::admissible_load() const
    {
      if (!(equilibrium < 1e-10) || !std::isfinite(load))
        return no_load;
      double part = 1.;
      bool   ok   = true;
      for (unsigned int p = 0; p < n; ++p)
        {
          const double k = problem.cone[p].k;
          if (const double f =
                x[p].tail<2>().norm() - x[p][0] - options.strength_margin;
              f > 0.)
            {
              ok   = false;
              part = std::min(part, k / (k + f));
            }
        }
      if (ok)
        return load;
      // Stresses under dead loads or in cohesionless soil cannot be scaled back.
      return problem.dead.squaredNorm() == 0. && part > 0. ? part * load
                                                           : no_load;
    }

    void
    Solver::keep_stresses()
    {
      const Points   x_before   = x;
      const VectorXd s_n_before = s_n;
      polish();
      // The latest stresses, while none are admissible.
      const double carried = admissible_load();
      if (carried > most_admissible ||
          (most_admissible == no_load && std::isfinite(load)))
        {
          most_admissible = carried;
          kept            = stresses();
          kept_load       = load;
        }
      x   = x_before;
      s_n = s_n_before;
      evaluate();
    }

    bool
    Solver::has_diverged()
    {
      double stress = 0., strength = 0.;
      for (unsigned int p = 0; p < n; ++p)
        {
          stress   = std::max({stress, x[p][0], std::abs(s_n[p])});
          strength = std::max(strength, problem.cone[p].k);
        }
      if (!std::isfinite(gap + load + flow + equilibrium))
        {
          solution.reason = "the iterates are not finite";
          solution.grows  = most > 1e5;
          return true;
        }
      most           = stress / std::max(strength, 1.);
      solution.grows = most > 1e12;
      if (solution.grows)
        solution.reason = "the stresses grow beyond all bounds";
      return solution.grows;
    }

    void
    Solver::watch_stresses()
    {
      // Stresses that cannot be scaled back violate their cones in proportion to the
      // gap, so a sharper optimum is needed. Without stresses in equilibrium the gap
      // grows again or closes.
      if (flow < options.flow_tolerance)
        smallest_gap = std::min(smallest_gap, gap);
      if (most_admissible == no_load && most < 1e3) // else no limit
        n_without += gap > 5. * smallest_gap ||
                     (is_closed() && equilibrium > least_equilibrium / 2.);
      least_equilibrium = std::min(least_equilibrium, equilibrium);
    }

    bool
    Solver::is_answered()
    {
      if (!is_only_compared())
        return false;
      // Kept stresses are admissible and in equilibrium; velocities still need their
      // repair.
      const bool is_admissible = flow < options.flow_tolerance &&
                                 std::abs(r_g) < options.tolerance,
                 is_below      = is_admissible && load + gap < options.question;
      solution.converged =
        options.stresses
          ? most_admissible >= options.question
          : is_admissible &&
              load + gap < options.question * (1. - options.tolerance);
      if (solution.converged)
        return true;
      const bool is_above =
        equilibrium < options.equilibrium_tolerance && load > options.question;
      if (!(options.stresses ? is_below : is_above))
        return false;
      solution.reason = "the optimum of this mesh does not answer the question";
      return true;
    }

    bool
    Solver::has_ended(const unsigned int iteration)
    {
      if (is_answered())
        return true;
      const bool is_solved =
        is_closed() && equilibrium < options.equilibrium_tolerance;
      if (is_solved)
        first_solved = std::min(first_solved, iteration);
      // Kept stresses are admissible and in equilibrium.
      if (is_closed() && most_admissible > load - 0.3 * allowed_gap())
        {
          solution.converged = true;
          return true;
        }
      watch_stresses();
      if ((is_solved && (!options.stresses || most_admissible > no_load)) ||
          iteration == first_solved + 6 || (options.stresses && n_without == 4))
        {
          solution.converged = is_solved;
          if (!is_solved)
            solution.reason =
              format("no stresses are in equilibrium and in their cones: the "
                     "best ones miss %.1e of the forces",
                     equilibrium);
          return true;
        }
      if (iteration == options.max_iterations)
        solution.reason =
          format("the gap is %.1e of the load, the residuals are %.1e "
                 "(equilibrium) and %.1e (flow) after %u iterations",
                 gap / std::max(std::abs(load), 1e-300),
                 equilibrium,
                 flow,
                 iteration);
      return iteration == options.max_iterations;
    }

    void
    Solver::advance(const Direction &along)
    {
      const double b_x = std::min(1., 0.99 * along.steps[0]),
                   b_z = std::min(1., 0.99 * along.steps[1]);
      last_step        = std::min(b_x, b_z);
      for (unsigned int p = 0; p < n; ++p)
        {
          x[p] += b_x * along.x[p];
          z[p] += b_z * along.z[p];
        }
      s_n += b_x * along.s_n;
      lambda += b_x * along.lambda;
      q += b_z * along.q;
    }

    void
    Solver::collect()
    {
      solution.q = q;
      solution.s = stresses();
      if (!kept.empty() &&
          (most_admissible > admissible_load() || !std::isfinite(load)))
        {
          solution.s = kept;
          load       = kept_load;
        }
      for (unsigned int p = 0; p < n; ++p) // s_n of cones: (x_0 - k)/a
        if (!problem.cone[p].is_cylinder())
          solution.s[p][0] /= problem.cone[p].a;
      solution.load           = load;
      solution.factorisations = matrix.n_factorisations;
    }

    BoundSolution
    Solver::solve()
    {
      start();
      for (unsigned int iteration = 0;; ++iteration)
        {
          evaluate();
          if (has_diverged() || has_ended(iteration))
            break;
          // Only one process computes the bounds.
          if (const int signal = stop_request_of_rank())
            throw Stopped(signal);
          if (!factorise())
            {
              solution.reason =
                "the matrix is singular: some velocities have no resistance";
              break;
            }
          // Stresses far from the optimum may answer the question, too.
          const bool may_answer = is_only_compared() &&
                                  load > options.question && equilibrium < 0.1;
          if (options.stresses &&
              (may_answer ||
               gap <
                 std::max(4. * allowed_gap(),
                          0.05 * std::abs(load) * !problem.can_be_scaled())))
            keep_stresses();
          if (may_answer && is_answered())
            break;
          advance(centred_direction());
        }
      if (solution.converged && !scaling.empty() && !is_only_compared())
        polish();
      collect();
      return solution;
    }
  } // namespace

  BoundSolution
  InteriorPoint::solve(const BoundProblem &problem, const Options &options)
  {
    return Solver(problem, options).solve();
  }
} // namespace geocone::GEOCONE_DIM
