// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/stop_request.h>
#include <geocone/limit_analysis/conic_solver.h>

#include <algorithm>
#include <cmath>

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
      void
      start();
      void
      evaluate();
      bool
      has_ended(const unsigned int iteration);
      bool
      factorise();
      /** Completes the direction whose right-hand sides the groups have.
       *  @return the largest steps of X and Z */
      std::array<double, 2>
      direction();
      void
      step();
      void
      polish();

      VectorXd
      only_free(VectorXd F) const
      {
        for (unsigned int i = 0; i < F.size(); ++i)
          if (problem.is_prescribed[i])
            F[i] = 0.;
        return F;
      }

      ConicProblem       &problem;
      const ConicOptions &options;
      BlockMatrix         matrix;
      double              degree = 0.;

      VectorXd q, dq, kept_q, x_2, r_d;
      double   lambda = 0., d_lambda = 0., kept_lambda = 0., r_g = 0.;
      double   mu = 0., gap = 0., load = 0., flow = 0., equilibrium = 0.,
             most = 0., last_step = 1.;
      bool is_scaled = false;

      ConicSolution solution;
    };

    void
    ConicSolver::start()
    {
      double volume = 0., n = 0.;
      for (const auto &group : problem.groups)
        {
          for (const double V : group->volume)
            volume += V;
          n += group->n_points();
          degree += group->degree();
        }
      matrix.clear();
      for (unsigned int i = 0; i < problem.groups.size(); ++i)
        {
          problem.groups[i]->begin(volume / n);
          problem.groups[i]->add_elastic_blocks(matrix, i, 100.);
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
            group->add_elastic_forces(q, 100., F);
          q -= matrix.solve(F);
        }
      double square = 0.;
      volume        = 0.;
      for (const auto &group : problem.groups)
        {
          const auto [e, V] = group->rate_square(q);
          square += e;
          volume += V;
        }
      for (const auto &group : problem.groups)
        group->start(q, std::sqrt(square / volume));
    }

    void
    ConicSolver::evaluate()
    {
      VectorXd all     = VectorXd::Zero(problem.n_dofs());
      double   product = 0., miss = 0., size = 0.;
      gap = most = 0.;
      for (const auto &group : problem.groups)
        {
          const auto sums = group->evaluate(q, options.flow_margin);
          product += sums.product;
          gap += sums.gap;
          miss += sums.flow_residual;
          size += sums.size;
          most = std::max(most, sums.largest_stress_ratio);
          group->add_forces(all);
        }
      r_d  = only_free(all - lambda * problem.live - problem.dead);
      r_g  = problem.has_factor() ? 1. - problem.live.dot(q) : 0.;
      mu   = product / degree;
      flow = std::sqrt(miss / size);
      load = problem.has_factor()
               ? lambda
               : (all - problem.dead).dot(problem.prescribed);
      equilibrium =
        r_d.norm() / std::max({all.norm(), problem.dead.norm(), 1e-300});
    }

    bool
    ConicSolver::has_ended(const unsigned int iteration)
    {
      if (!std::isfinite(gap + load + flow + equilibrium))
        {
          solution.reason = "the iterates are not finite";
          for (const auto &group : problem.groups)
            group->restore();
          q      = kept_q;
          lambda = kept_lambda;
          evaluate();
          return true;
        }
      solution.grows = most > 1e10;
      if (solution.grows)
        {
          solution.reason = "the stresses grow beyond all bounds";
          return true;
        }
      solution.converged = gap < options.tolerance * std::abs(load) &&
                           flow < options.flow_tolerance &&
                           std::abs(r_g) < options.tolerance &&
                           equilibrium < options.equilibrium_tolerance;
      if (solution.converged)
        return true;
      if (iteration < options.max_iterations)
        return false;
      solution.reason =
        format("the gap is %.1e of the load, the residuals are %.1e "
               "(equilibrium) and %.1e (flow) after %u iterations",
               gap / std::max(std::abs(load), 1e-300),
               equilibrium,
               flow,
               iteration);
      return true;
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

    std::array<double, 2>
    ConicSolver::direction()
    {
      VectorXd given = VectorXd::Zero(problem.n_dofs());
      for (const auto &group : problem.groups)
        group->add_given_forces(given);
      dq = matrix.solve(-r_d - given);
      if (problem.has_factor())
        {
          d_lambda = (r_g - problem.live.dot(dq)) / problem.live.dot(x_2);
          dq += d_lambda * x_2;
        }
      std::array<double, 2> steps = {{1. / 0.99, 1. / 0.99}};
      for (const auto &group : problem.groups)
        {
          const auto own = group->complete(dq);
          for (unsigned int i = 0; i < 2; ++i)
            steps[i] = std::min(steps[i], own[i]);
        }
      return steps;
    }

    void
    ConicSolver::step()
    {
      if (problem.has_factor())
        x_2 = matrix.solve(problem.live);
      for (const auto &group : problem.groups)
        group->predict();
      std::array<double, 2> steps  = direction();
      double                affine = 0.;
      for (const auto &group : problem.groups)
        affine +=
          group->product_after(std::min(1., steps[0]), std::min(1., steps[1]));
      // Stronger centring after a short step, as further short steps would follow.
      const double centre =
        std::max(std::pow(std::max(affine / degree, 0.) / mu, 3),
                 last_step < 0.15 ? 0.8 : 0.);
      for (const auto &group : problem.groups)
        group->correct(centre * mu);
      steps            = direction();
      const double b_x = std::min(1., 0.99 * steps[0]),
                   b_z = std::min(1., 0.99 * steps[1]);
      last_step        = std::min(b_x, b_z);
      kept_q           = q;
      kept_lambda      = lambda;
      for (const auto &group : problem.groups)
        {
          group->keep();
          group->advance(b_x, b_z);
        }
      lambda += b_x * d_lambda;
      q += b_z * dq;
    }

    void
    ConicSolver::polish()
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          const VectorXd x = matrix.solve(-r_d);
          for (const auto &group : problem.groups)
            group->polish(x);
          evaluate();
        }
    }

    ConicSolution
    ConicSolver::solve()
    {
      start();
      for (unsigned int iteration = 0;; ++iteration)
        {
          evaluate();
          if (has_ended(iteration))
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
          step();
        }
      if (solution.converged && is_scaled)
        polish();
      solution.q              = q;
      solution.load           = load;
      solution.factorisations = matrix.n_factorisations;
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
} // namespace geocone
