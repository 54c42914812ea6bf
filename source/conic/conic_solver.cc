// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/stop_request.h>
#include <geocone/conic/conic_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone
{
  using Eigen::VectorXd;

  bool
  ConicProblem::has_free_direction() const
  {
    return std::any_of(groups.begin(), groups.end(), [](const auto &group) {
      return group->has_free_direction();
    });
  }

  unsigned int
  ConicProblem::n_unknowns() const
  {
    return std::count(is_prescribed.begin(), is_prescribed.end(), false);
  }

  namespace
  {
    std::vector<BlockMatrix::Set>
    sets_of(const ConicProblem &problem)
    {
      std::vector<BlockMatrix::Set> sets;
      for (const auto &group : problem.groups)
        sets.push_back(group->set());
      return sets;
    }

    /** Load below all others, for inadmissible stresses. */
    constexpr double no_load = -std::numeric_limits<double>::infinity();

    /** An iterate and its direction. */
    class ConicSolver
    {
    public:
      ConicSolver(ConicProblem &problem, const ConicOptions &options)
        : problem(problem)
        , options(options)
        , matrix(problem.is_prescribed, sets_of(problem))
      {}

      ConicSolution
      solve();

    private:
      VectorXd
      only_free(VectorXd F) const
      {
        for (unsigned int i = 0; i < F.size(); ++i)
          if (problem.is_prescribed[i])
            F[i] = 0.;
        return F;
      }

      void
      start();

      /** Rate below which all are zero, as where bodies move rigidly. Lengths are of order
       *  one. */
      double
      least_rate() const
      {
        return 1e-6 * q.lpNorm<Eigen::Infinity>();
      }

      /** Residuals at the present iterate. */
      void
      evaluate();

      /** Direction of the velocities and the load, with the largest steps of X and Z.
       *  The groups have the directions of their points. */
      struct Direction
      {
        VectorXd              q;
        double                lambda = 0.;
        std::array<double, 2> steps;

        double
        shorter() const
        {
          return std::min(steps[0], steps[1]);
        }
      };

      /** Newton's direction for the right-hand sides of the groups. */
      Direction
      direction() const;

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
       * @param target of the eigenvalues of x o z
       * @return whether the direction was changed
       */
      bool
      correct_further(const double target, Direction &along) const;

      /** Moves the iterate along a direction, up to a hundredth before the boundary of
       *  the cones. */
      void
      advance(const Direction &along);

      /** @name A copy of the iterate */
      /** @{ */
      void
      keep();
      void
      restore();
      /** @} */

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

      /** Copies the best stresses and the velocities into the solution. */
      void
      collect();

      ConicProblem      &problem;
      const ConicOptions options;
      BlockMatrix        matrix;
      double             degree = 0., volume = 0.;

      VectorXd q, kept_q, x_2, r_d;
      double   lambda = 0., kept_lambda = 0., r_g = 0.;
      double   mu = 0., gap = 0., load = 0., flow = 0., equilibrium = 0.;
      double   last_step = 1.; ///< the shorter of the two
      bool     is_scaled = false, is_restored = false;

      bool   has_kept = false; ///< stresses of the best iterate, and their load
      double kept_load = 0., most_admissible = no_load;

      double       strength = 1., largest_stress = 0.;
      double       most         = 0.; ///< largest stress over strength
      unsigned int first_solved = options.max_iterations + 1;
      unsigned int n_without    = 0; ///< without progress
      double       smallest_gap = std::numeric_limits<double>::infinity(),
             least_equilibrium  = smallest_gap;

      ConicSolution solution;
    };

    void
    ConicSolver::start()
    {
      double n = 0.;
      for (const auto &group : problem.groups)
        {
          for (const double V : group->volume)
            volume += V;
          n += group->n_points();
          degree += group->degree();
          strength = std::max(strength, group->largest_strength());
        }
      // Constrained rates are a hundred times as stiff as all others.
      constexpr double stiffness = 99.;
      matrix.clear();
      for (unsigned int i = 0; i < problem.groups.size(); ++i)
        {
          problem.groups[i]->begin(volume / n, options.strength_margin);
          problem.groups[i]->add_elastic_blocks(matrix, i, stiffness);
        }
      if (!matrix.factorise())
        throw StepFailure(
          "the stiffness of the bound's velocities is singular\n  remedy:  "
          "hold the body against translation and rotation");
      q = problem.prescribed;
      if (problem.has_factor())
        {
          q += matrix.solve(problem.live);
          q /= problem.live.dot(q);
        }
      else
        {
          VectorXd F = VectorXd::Zero(problem.n_dofs());
          for (const auto &group : problem.groups)
            group->add_elastic_forces(q, stiffness, F);
          q -= matrix.solve(F);
        }
      double square = 0.;
      volume        = 0.;
      for (const auto &group : problem.groups)
        {
          const auto [z, V] = group->start_rates(q);
          square += z;
          volume += V;
        }
      for (const auto &group : problem.groups)
        group->start(std::max(std::sqrt(square / volume), least_rate()),
                     problem.least_start);
      keep();
    }

    void
    ConicSolver::evaluate()
    {
      VectorXd all     = VectorXd::Zero(problem.n_dofs());
      double   product = 0., miss = 0., size = 0.;
      gap = largest_stress = 0.;
      for (const auto &group : problem.groups)
        {
          const auto sums = group->evaluate(q, options.flow_margin);
          product += sums.product;
          gap += sums.gap;
          miss += sums.flow_residual;
          size += sums.size;
          largest_stress = std::max(largest_stress, sums.largest_stress);
          group->add_forces(all);
        }
      r_d  = only_free(all - lambda * problem.live - problem.dead);
      r_g  = problem.has_factor() ? 1. - problem.live.dot(q) : 0.;
      mu   = product / degree;
      const double least = least_rate();
      flow = std::sqrt(miss / std::max(size, volume * least * least));
      // Power of the reactions to prescribed velocities.
      load               = problem.has_factor()
                             ? lambda
                             : (all - problem.dead).dot(problem.prescribed);
      const double force = std::max({all.norm(), problem.dead.norm(), 1e-300});
      equilibrium        = r_d.norm() / force;
    }

    bool
    ConicSolver::factorise()
    {
      matrix.clear();
      for (unsigned int i = 0; i < problem.groups.size(); ++i)
        {
          problem.groups[i]->scale();
          problem.groups[i]->add_blocks(matrix, i);
        }
      is_scaled = true;
      return matrix.factorise();
    }

    ConicSolver::Direction
    ConicSolver::direction() const
    {
      VectorXd given = VectorXd::Zero(problem.n_dofs());
      for (const auto &group : problem.groups)
        group->add_given_forces(given);
      Direction along;
      along.q = matrix.solve(-r_d - given);
      if (problem.has_factor())
        {
          along.lambda =
            (r_g - problem.live.dot(along.q)) / problem.live.dot(x_2);
          along.q += along.lambda * x_2;
        }
      along.steps = {{1. / 0.99, 1. / 0.99}};
      for (const auto &group : problem.groups)
        {
          const auto own = group->complete(along.q);
          for (unsigned int i = 0; i < 2; ++i)
            along.steps[i] = std::min(along.steps[i], own[i]);
        }
      return along;
    }

    ConicSolver::Direction
    ConicSolver::centred_direction()
    {
      if (problem.has_factor())
        x_2 = matrix.solve(problem.live);
      for (const auto &group : problem.groups)
        group->predict();
      Direction along  = direction();
      double    affine = 0.;
      for (const auto &group : problem.groups)
        affine += group->product_after(std::min(1., along.steps[0]),
                                       std::min(1., along.steps[1]));
      // Stronger centring after a short step, as further short steps would follow.
      // Half of Mehrotra's target: the whole one takes fewer iterations, but ends
      // farther from the optimum.
      const double target =
        0.5 * mu *
        std::max(std::pow(std::max(affine / degree, 0.) / mu, 3),
                 last_step < 0.15 ? 0.8 : 0.);
      for (const auto &group : problem.groups)
        group->correct(target);
      along                                  = direction();
      constexpr unsigned int most_correctors = 2;
      for (unsigned int k = 0; k < most_correctors; ++k)
        if (!correct_further(target, along))
          break;
      return along;
    }

    bool
    ConicSolver::correct_further(const double target, Direction &along) const
    {
      // Steps that are long enough, and the attempted and the required increase.
      constexpr double enough = 0.5, longer = 0.1, gained = 0.01;
      if (along.shorter() > enough)
        return false;
      for (const auto &group : problem.groups)
        group->correct_further(target,
                               std::min(1., along.steps[0] + longer),
                               std::min(1., along.steps[1] + longer));
      Direction next = direction();
      if (next.shorter() < along.shorter() + gained)
        {
          for (const auto &group : problem.groups)
            group->take_back();
          return false;
        }
      along = std::move(next);
      return true;
    }

    void
    ConicSolver::advance(const Direction &along)
    {
      const double b_x = std::min(1., 0.99 * along.steps[0]),
                   b_z = std::min(1., 0.99 * along.steps[1]);
      last_step        = std::min(b_x, b_z);
      for (const auto &group : problem.groups)
        group->advance(b_x, b_z);
      lambda += b_x * along.lambda;
      q += b_z * along.q;
    }

    void
    ConicSolver::keep()
    {
      for (const auto &group : problem.groups)
        group->keep();
      kept_q      = q;
      kept_lambda = lambda;
    }

    void
    ConicSolver::restore()
    {
      for (const auto &group : problem.groups)
        group->restore();
      q      = kept_q;
      lambda = kept_lambda;
      evaluate();
    }

    void
    ConicSolver::polish()
    {
      for (double before = 1.; equilibrium < before / 2.;)
        {
          before           = equilibrium;
          const VectorXd x = matrix.solve(-r_d);
          for (const auto &group : problem.groups)
            group->polish(x);
          evaluate();
        }
    }

    double
    ConicSolver::admissible_load() const
    {
      if (!(equilibrium < 1e-10) || !std::isfinite(load))
        return no_load;
      double part = 1.;
      for (const auto &group : problem.groups)
        part = std::min(part, group->admissible_part());
      if (part == 1.)
        return load;
      // Stresses under dead loads or in cohesionless soil cannot be scaled back.
      return problem.dead.squaredNorm() == 0. && part > 0. ? part * load
                                                           : no_load;
    }

    void
    ConicSolver::keep_stresses()
    {
      keep();
      polish();
      // The latest stresses, while none are admissible.
      const double carried = admissible_load();
      if (carried > most_admissible ||
          (most_admissible == no_load && std::isfinite(load)))
        {
          most_admissible = carried;
          kept_load       = load;
          has_kept        = true;
          for (const auto &group : problem.groups)
            group->keep_stresses();
        }
      restore();
    }

    bool
    ConicSolver::has_diverged()
    {
      if (!std::isfinite(gap + load + flow + equilibrium))
        {
          solution.reason = "the iterates are not finite";
          solution.grows  = most > 1e5;
          is_restored     = true;
          restore();
          return true;
        }
      most           = largest_stress / strength;
      solution.grows = most > 1e12;
      if (solution.grows)
        solution.reason = "the stresses grow beyond all bounds";
      return solution.grows;
    }

    void
    ConicSolver::watch_stresses()
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
    ConicSolver::is_answered()
    {
      if (!is_only_compared())
        return false;
      // Kept stresses are admissible and in equilibrium; velocities still need their
      // repair.
      const bool is_admissible = flow < options.flow_tolerance &&
                                 std::abs(r_g) < options.tolerance,
                 is_below = is_admissible && load + gap < options.question;
      solution.converged =
        options.stresses
          ? most_admissible >= options.question
          : is_admissible &&
              load + gap < options.question * (1. - options.tolerance);
      if (solution.converged)
        return true;
      const bool is_above =
        equilibrium < options.equilibrium_tolerance && load > options.question;
      const double distance = options.stresses ? options.question - load
                                               : load + gap - options.question;
      if (!(options.stresses ? is_below : is_above) ||
          gap > options.located * distance)
        return false;
      solution.reason = "the optimum of this mesh does not answer the question";
      return true;
    }

    bool
    ConicSolver::has_ended(const unsigned int iteration)
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
    ConicSolver::collect()
    {
      solution.q = q;
      if (has_kept && (most_admissible > admissible_load() || is_restored))
        {
          for (const auto &group : problem.groups)
            group->restore_stresses();
          load = kept_load;
        }
      solution.load           = load;
      solution.factorisations = matrix.n_factorisations;
    }

    ConicSolution
    ConicSolver::solve()
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
          const bool may_answer =
            is_only_compared() && load > options.question && equilibrium < 0.1;
          if (options.stresses &&
              (may_answer || gap < std::max(4. * allowed_gap(),
                                            0.05 * std::abs(load) *
                                              (options.strength_margin > 0.))))
            keep_stresses();
          if (may_answer && is_answered())
            break;
          keep();
          advance(centred_direction());
        }
      if (solution.converged && is_scaled && !is_only_compared())
        polish();
      collect();
      return solution;
    }
  } // namespace

  bool
  constrain_rates(ConicProblem &problem, VectorXd &q)
  {
    constexpr double penalty = 1e8;
    BlockMatrix      matrix(problem.is_prescribed, sets_of(problem));
    matrix.clear();
    for (unsigned int i = 0; i < problem.groups.size(); ++i)
      problem.groups[i]->add_elastic_blocks(matrix, i, penalty);
    if (!matrix.factorise())
      return false;
    const VectorXd q_0 = q;
    for (unsigned int i = 0; i < 6; ++i)
      {
        VectorXd F = VectorXd::Zero(problem.n_dofs());
        for (const auto &group : problem.groups)
          {
            // B(q - q_0), and the constraint with its multiplier.
            group->add_elastic_forces(q - q_0, 0., F);
            group->add_constraint_forces(q, penalty, F);
          }
        q -= matrix.solve(F);
        for (const auto &group : problem.groups)
          group->add_multipliers(q, penalty);
      }
    return true;
  }

  ConicSolution
  solve(ConicProblem &problem, const ConicOptions &options)
  {
    return ConicSolver(problem, options).solve();
  }

  ConicSolution
  solve_for_velocities(
    ConicProblem                                                &problem,
    const double                                                 tolerance,
    const std::function<BoundVerdict(const Eigen::VectorXd &q)> &certify)
  {
    const bool   is_constrained = problem.has_free_direction();
    ConicOptions options;
    options.tolerance             = tolerance;
    options.equilibrium_tolerance = std::max(tolerance, 1e-7);
    options.flow_tolerance        = is_constrained ? 1e-6 : 1e-8;
    unsigned int factorisations   = 0;
    for (double margin = 10.;; margin *= 10.)
      {
        options.flow_margin    = margin * options.flow_tolerance;
        ConicSolution solution = solve(problem, options);
        if (is_constrained && solution.q.allFinite())
          {
            constrain_rates(problem, solution.q);
            ++solution.factorisations;
          }
        factorisations += solution.factorisations;
        solution.factorisations    = factorisations;
        const BoundVerdict verdict = certify(solution.q);
        if (verdict.certified || !(verdict.violation > 0.) ||
            !solution.converged || margin >= 1000.)
          return solution;
      }
  }
} // namespace geocone
