// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/solid_bounds/solid_certificate.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {

    Tensor<1, dim>
    traction_of(const Mandel &s, const Tensor<1, dim> &n)
    {
      const Eigen::Matrix3d m = SemidefiniteCone::matrix(s);
      Tensor<1, dim>        t;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          t[i] += m(i, j) * n[j];
      return t;
    }

    /** Returns a load at a load factor, and notes whether a part of it is dead. */
    Tensor<1, dim>
    total(const SolidScene::Load &load, const double lambda, StressCheck &check)
    {
      check.is_dead = check.is_dead || load.dead.norm() > 0.;
      return load.dead + lambda * load.live;
    }

    /** Compares the stresses of cells with the strength, and their divergence with the
     *  body forces. */
    void
    check_cells(const SolidScene          &bound,
                const unsigned int         order,
                const std::vector<Mandel> &stress,
                const double               lambda,
                StressCheck               &check)
    {
      const Tetrahedra  &tetrahedra = *bound.tetrahedra;
      const double       L          = bound.units.length;
      const unsigned int n_nodes    = simplex_nodes::n_in_cell(order);
      for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
        {
          const SpatialStrength &one = bound.strengths[tetrahedra.material[c]];
          const auto             k   = strength_at_nodes(bound, order, c);
          const Mandel *const    s   = &stress[n_nodes * c];
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const Eigen::Matrix3d m    = SemidefiniteCone::matrix(s[i]);
              const double          used = one.utilisation(k[i], m);
              check.add(used, k[i] > 0. ? k[i] : m.norm(), m.norm());
              // Without strength a part of the stresses is not nearer to its cone.
              check.is_dead = check.is_dead || (k[i] == 0. && used > 1.);
            }
          const auto           g = tetrahedra.gradients(c);
          const Tensor<1, dim> b = total(bound.body_force(c), lambda, check);
          for (unsigned int i = 0; i < (order == 1 ? 1 : 4); ++i)
            {
              Tensor<1, dim> divergence;
              for (unsigned int j = 0; j < 4; ++j)
                divergence +=
                  order *
                  traction_of(s[order == 1 ? j : simplex_nodes::node(i, j)],
                              L * g[j]);
              check.add_error((divergence + b).norm() *
                              std::cbrt(tetrahedra.volume(c)) / L);
            }
        }
    }
  } // namespace

  SolidBound
  certify_lower(const SolidScene          &bound,
                const unsigned int         order,
                const std::vector<Mandel> &stress,
                const double               lambda)
  {
    const Tetrahedra  &tetrahedra = *bound.tetrahedra;
    const double       L          = bound.units.length;
    const unsigned int n_nodes    = simplex_nodes::n_in_cell(order),
                       n_facet    = simplex_nodes::n_on_facet(order);
    SolidBound result;
    result.stress = stress;
    StressCheck check;
    check_cells(bound, order, stress, lambda, check);
    double power = 0.; // of the reactions to prescribed velocities
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      {
        const auto           &facet = tetrahedra.facets[f];
        const FacetCondition &held  = bound.facet_conditions[f];
        const Tensor<1, dim>  n     = tetrahedra.normal(f);
        const double          A     = tetrahedra.area(f) / (L * L);
        const auto            first = nodes_in_cell(tetrahedra, order, f, 0);
        const auto            given = bound.tractions(f);
        for (unsigned int i = 0; i < n_facet; ++i)
          {
            Tensor<1, dim> left =
              traction_of(stress[n_nodes * facet.cells[0] + first[i]], n);
            if (facet.cells[1] != Tetrahedra::none)
              left -=
                traction_of(stress[n_nodes * facet.cells[1] +
                                   nodes_in_cell(tetrahedra, order, f, 1)[i]],
                            n);
            else if (i < 3)
              left -= total(given[i], lambda, check);
            else
              for (const unsigned int end :
                   simplex_nodes::edges_of_facet[i - 3])
                left -= total(given[end], lambda, check) / 2.;
            if (held.kind == FacetCondition::Kind::interface)
              {
                const Mandel &s = stress[n_nodes * facet.cells[0] + first[i]];
                bound.interfaces[held.obstacle].check(
                  left, n, SemidefiniteCone::matrix(s).norm(), check);
                power += A / n_facet * left * held.velocity;
                continue;
              }
            const Tensor<1, dim> reaction = held.held_part(left);
            power += A / n_facet * reaction * held.velocity;
            check.add_error((left - reaction).norm());
          }
      }
    result.lambda = bound.factor == LoadFactor::velocity ? power : lambda;
    check.judge(result, result.lambda);
    return result;
  }

  namespace
  {
    /** Dissipation and power of loads of velocities, as far as they have been added. */
    struct Flow
    {
      SolidBound    result;
      VelocityCheck check;
      double        power = 0.; ///< dissipation less the power of dead loads
      double        work  = 0.; ///< power of live loads
    };

    void
    add_cell(const SolidScene  &bound,
             const unsigned int order,
             const unsigned int c,
             Flow              &sum)
    {
      const Tetrahedra           &tetrahedra = *bound.tetrahedra;
      const double                L          = bound.units.length;
      const unsigned int          n_nodes    = simplex_nodes::n_in_cell(order);
      const auto                  g          = tetrahedra.gradients(c);
      const double                V = tetrahedra.volume(c) / (L * L * L);
      const Tensor<1, dim> *const v = &sum.result.velocity[n_nodes * c];
      const auto                  k = strength_of_rates(bound, order, c);
      double &dissipation           = sum.result.dissipation_of_cell[c];
      for (unsigned int i = 0; i < k.size(); ++i)
        {
          Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
          for (unsigned int j = 0; j < 4; ++j)
            {
              const Tensor<1, dim> &v_j =
                v[order == 1 ? j : simplex_nodes::node(i, j)];
              for (unsigned int a = 0; a < dim; ++a)
                for (unsigned int b = 0; b < dim; ++b)
                  gradient(a, b) += order * v_j[a] * L * g[j][b];
            }
          const Eigen::Matrix3d e = (gradient + gradient.transpose()) / 2.;
          const SpatialStrength::Flow flow =
            bound.strengths[tetrahedra.material[c]].flow(k[i], e);
          dissipation += V / k.size() * flow.dissipation;
          sum.check.add_rate(flow, e.norm());
        }
      sum.power += dissipation;
      const SolidScene::Load load = bound.body_force(c);
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          sum.power -= V / n_nodes * load.dead * v[i];
          sum.work += V / n_nodes * load.live * v[i];
        }
    }

    /** Velocities at the nodes of a facet, of the cell on a side. */
    std::vector<Tensor<1, dim>>
    velocities_at(const SolidScene  &bound,
                  const unsigned int order,
                  const unsigned int f,
                  const unsigned int side,
                  const SolidBound  &result)
    {
      const unsigned int first = simplex_nodes::n_in_cell(order) *
                                 bound.tetrahedra->facets[f].cells[side];
      std::vector<Tensor<1, dim>> all;
      for (const unsigned int i :
           nodes_in_cell(*bound.tetrahedra, order, f, side))
        all.push_back(result.velocity[first + i]);
      return all;
    }

    void
    add_tractions(const SolidScene                  &bound,
                  const unsigned int                 order,
                  const unsigned int                 f,
                  const std::vector<Tensor<1, dim>> &v,
                  Flow                              &sum)
    {
      const double L = bound.units.length,
                   A = bound.tetrahedra->area(f) / (L * L);
      std::array<Tensor<1, dim>, 3> dead, live;
      for (unsigned int i = 0; i < 3; ++i)
        {
          dead[i] = bound.tractions(f)[i].dead;
          live[i] = bound.tractions(f)[i].live;
        }
      const auto f_dead = forces_of_traction(order, dead),
                 f_live = forces_of_traction(order, live);
      for (unsigned int i = 0; i < v.size(); ++i)
        {
          sum.power -= A * f_dead[i] * v[i];
          sum.work += A * f_live[i] * v[i];
        }
    }

    void
    add_facet(const SolidScene  &bound,
              const unsigned int order,
              const unsigned int f,
              Flow              &sum)
    {
      const Tetrahedra &tetrahedra = *bound.tetrahedra;
      const double L = bound.units.length, A = tetrahedra.area(f) / (L * L);
      const FacetCondition &held = bound.facet_conditions[f];
      const bool is_inner = tetrahedra.facets[f].cells[1] != Tetrahedra::none;
      const auto outer    = velocities_at(bound, order, f, 0, sum.result);
      if (!is_inner)
        add_tractions(bound, order, f, outer, sum);
      if (!is_inner && held.kind == FacetCondition::Kind::free)
        return;
      const auto inner =
        is_inner ? velocities_at(bound, order, f, 1, sum.result)
                 : std::vector<Tensor<1, dim>>(outer.size(), held.velocity);
      const auto             axes = axes_of_facet(tetrahedra, f);
      const SpatialStrength &one =
        bound.strengths[tetrahedra.material[cell_of_jump(bound, f)]];
      const auto k           = strength_of_jumps(bound, order, f);
      const auto cracks      = strength_of_cracks(bound, order, f);
      double    &dissipation = sum.result.dissipation_of_facet[f];
      for (unsigned int i = 0; i < outer.size(); ++i)
        {
          const Tensor<1, dim> u = inner[i] - outer[i];
          // Along a plane of symmetry, or a smooth one, soil slides freely.
          const double slip = held.kind == FacetCondition::Kind::plane
                                ? 0.
                                : std::hypot(u * axes[1], u * axes[2]);
          const SpatialStrength::Flow flow =
            held.kind == FacetCondition::Kind::interface ? bound
                                                             .interfaces
                                                               [held.obstacle]
                                                             .flow(
                                                               u * axes[0],
                                                               bound
                                                                   .interfaces
                                                                     [held
                                                                        .obstacle]
                                                                   .is_smooth()
                                                                 ? 0.
                                                                 : slip,
                                                               cracks[i])
                                                         : one.flow_of_jump(
                                                             k[i],
                                                             u * axes[0],
                                                             slip);
          dissipation += A / outer.size() * flow.dissipation;
          sum.check.add_jump(flow);
        }
      sum.power += dissipation;
    }
  } // namespace

  SolidBound
  certify_upper(const SolidScene                  &bound,
                const unsigned int                 order,
                const std::vector<Tensor<1, dim>> &velocity)
  {
    const Tetrahedra &tetrahedra = *bound.tetrahedra;
    Flow              sum;
    sum.result.velocity = velocity;
    sum.result.dissipation_of_cell.assign(tetrahedra.cells.size(), 0.);
    sum.result.dissipation_of_facet.assign(tetrahedra.facets.size(), 0.);
    for (unsigned int c = 0; c < tetrahedra.cells.size(); ++c)
      add_cell(bound, order, c, sum);
    for (unsigned int f = 0; f < tetrahedra.facets.size(); ++f)
      add_facet(bound, order, f, sum);
    // A body that moves by prescribed velocities has no other measure of its jumps.
    for (const Tensor<1, dim> &v : velocity)
      take_larger(sum.check.fastest, v.norm());
    // Nor has a body that moves rigidly another one of its rates.
    take_larger(sum.check.largest_rate, sum.check.fastest);
    sum.result.work = bound.factor == LoadFactor::velocity ? 1. : sum.work;
    sum.check.judge(sum.result, sum.power, sum.result.work);
    return sum.result;
  }

  namespace
  {
    /** Returns whether a vertex of the body or an obstacle has friction alone. */
    bool
    has_no_cohesion(const SolidScene &bound)
    {
      for (const InterfaceStrength &one : bound.interfaces)
        if (one.adhesion == 0. || one.tension == 0.)
          return true;
      for (unsigned int c = 0; c < bound.tetrahedra->cells.size(); ++c)
        for (const double k : bound.strength_at_vertices(c))
          if (k == 0.)
            return true;
      return false;
    }

    void
    add_solution(SolidBound          &side,
                 const ConicSolution &solution,
                 const ConicProblem  &problem)
    {
      side.factorisations = solution.factorisations;
      side.n_unknowns     = problem.n_unknowns();
      side.converged      = solution.converged;
      side.reason         = solution.reason;
      side.grows          = solution.grows;
    }
  } // namespace

  SolidBound
  certified_upper(const SolidScene  &bound,
                  const unsigned int order,
                  const double       tolerance)
  {
    ConicProblem        problem = upper_problem(bound, order);
    SolidBound          side;
    const ConicSolution solution =
      solve_for_velocities(problem, tolerance, [&](const Eigen::VectorXd &q) {
        std::vector<Tensor<1, dim>> velocity(simplex_nodes::n_in_cell(order) *
                                             bound.tetrahedra->cells.size());
        for (unsigned int i = 0; i < velocity.size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            velocity[i][d] = q[dim * i + d];
        side = certify_upper(bound, order, velocity);
        return side;
      });
    add_solution(side, solution, problem);
    return side;
  }

  SolidBound
  certified_lower(const SolidScene  &bound,
                  const unsigned int order,
                  const double       tolerance)
  {
    ConicProblem problem = lower_problem(bound, order);
    ConicOptions options;
    options.tolerance            = tolerance;
    options.flow_tolerance       = tolerance;
    if (has_no_cohesion(bound))
      {
        // Stresses cannot be scaled back, but kept inside by more than rounding.
        options.stresses        = true;
        options.strength_margin = 1e-8;
      }
    const ConicSolution solution = solve(problem, options);
    const auto          stress =
      stresses_of_cells<Mandel>(problem,
                                bound.strengths,
                                bound.tetrahedra->material,
                                simplex_nodes::n_in_cell(order),
                                stress_free_nodes(bound, order));
    SolidBound side = certify_lower(bound, order, stress, solution.load);
    // Bodies that are nearly rigid beside an interface are hardly polished.
    constexpr double improvable = 1e-11; // checkers accept rounding errors only
    if (side.error > improvable && std::isfinite(side.load))
      if (SolidBound again = certify_lower(
            bound,
            order,
            in_equilibrium(bound, order, problem, solution.load, stress),
            solution.load);
          again.error < side.error && again.certified >= side.certified)
        side = std::move(again);
    side.dual_power = dual_power_of_cells(bound, order, stress, solution.q);
    add_solution(side, solution, problem);
    return side;
  }
} // namespace geocone::GEOCONE_DIM
