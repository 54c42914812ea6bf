// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/resources.h>
#include <geocone/plane_bounds/bar_cells.h>
#include <geocone/shakedown/shakedown_bounds.h>
#include <geocone/shakedown/shakedown_proof.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  using Eigen::Vector3d;

  namespace
  {
    /**
     * Factor with which the principal stresses out of the plane are within the strength
     * in all states, too. The residual stress along z is free in plane strain, the same
     * in all states; the elastic one is nu (s_xx + s_yy).
     * @param elastic stresses of all states with the factor 1
     */
    double
    factor_out_of_plane(const BoundScene               &bound,
                        const BoundProblem             &problem,
                        const std::vector<LinearField> &elastic,
                        const Bound                    &lower)
    {
      const unsigned int n      = 3 * problem.n_triangles;
      double             factor = 1.;
      for (unsigned int p = 0; p < n; ++p)
        {
          const Elasticity &law =
            bound.scene.materials[bound.triangles.material[p / 3]].elasticity();
          const double     nu   = law.lambda / (2. * law.lambda + law.two_G);
          const PointCone &cone = problem.cone[p];
          const double     a = cone.a, two_c = sqrt2 * cone.k;
          // Bounds of the residual stress, without the strength.
          double least = std::numeric_limits<double>::lowest(), most = -least;
          for (unsigned int k = 0; k < elastic.size(); ++k)
            {
              const Vector3d &s    = lower.s[n * k + p];
              const double    mean = -s[0] / sqrt2,
                           radius  = s.tail<2>().norm() / sqrt2,
                           along = -sqrt2 * nu * lower.load * elastic[k][p][0];
              least =
                std::max(least, (mean + radius) * (1. + a) / (1. - a) - along);
              most =
                std::min(most, (mean - radius) * (1. - a) / (1. + a) - along);
            }
          const double room = two_c * (1. / (1. - a) + 1. / (1. + a));
          if (least - most > room)
            factor = std::min(factor, room / (least - most));
        }
      return factor;
    }

    /** Factor at first yield without residual stresses. */
    double
    first_yield(const BoundProblem             &problem,
                const std::vector<LinearField> &elastic)
    {
      double factor = std::numeric_limits<double>::infinity();
      for (const LinearField &state : elastic)
        for (unsigned int p = 0; p < state.size(); ++p)
          if (const double f =
                state[p].tail<2>().norm() - problem.cone[p].a * state[p][0];
              f > 0.)
            factor = std::min(factor, problem.cone[p].k / f);
      return factor;
    }

    /** First state with the loads of each state, by their elastic stresses: a state may
     *  occur several times in a cycle. */
    std::vector<unsigned int>
    first_equal_states(const std::vector<LinearField> &elastic)
    {
      constexpr double rounding = 1e-9;
      double           largest  = 0.;
      for (const LinearField &state : elastic)
        for (const Vector3d &s : state)
          largest = std::max(largest, s.norm());
      std::vector<unsigned int> first;
      for (const LinearField &state : elastic)
        {
          unsigned int other = 0;
          while (!std::equal(state.begin(),
                             state.end(),
                             elastic[other].begin(),
                             [&](const Vector3d &s, const Vector3d &t) {
                               return (s - t).norm() <= rounding * largest;
                             }))
            ++other;
          first.push_back(other);
        }
      return first;
    }

    /** Kind of the mechanism: plastic strains of all states and their sum. */
    void
    describe_mechanism(const BoundProblem             &above,
                       const std::vector<LinearField> &rates,
                       const std::vector<LinearField> &elastic,
                       ShakedownBounds                &found)
    {
      const std::vector<unsigned int> first   = first_equal_states(elastic);
      const unsigned int  n_cells = above.n_triangles;
      std::vector<double> of_state(rates.size(), 0.);
      found.net.assign(n_cells, 0.);
      found.total.assign(n_cells, 0.);
      double net = 0., total = 0.;
      for (unsigned int p = 0; p < 3 * n_cells; ++p)
        {
          Vector3d sum = Vector3d::Zero();
          for (unsigned int k = 0; k < rates.size(); ++k)
            {
              const double shear = rates[k][p].tail<2>().norm();
              sum += rates[k][p];
              of_state[first[k]] += above.volume[p] * shear;
              found.total[p / 3] += shear / 3.;
              total += above.volume[p] * shear;
            }
          const double shear = sum.tail<2>().norm();
          found.net[p / 3] += shear / 3.;
          net += above.volume[p] * shear;
        }
      const auto most   = std::max_element(of_state.begin(), of_state.end());
      found.state       = most - of_state.begin();
      found.net_share   = total > 0. ? net / total : 0.;
      found.state_share = total > 0. ? *most / total : 0.;
    }

    /** Contributions of the triangles to the gap, of all states. */
    std::vector<double>
    gap_of_states(const BoundProblem             &above,
                  const std::vector<LinearField> &rates,
                  const Bound                    &lower)
    {
      const unsigned int  n = 3 * above.n_triangles;
      std::vector<double> gap(above.n_triangles, 0.);
      for (unsigned int k = 0; k < rates.size(); ++k)
        for (unsigned int p = 0; p < n; ++p)
          {
            const unsigned int first = p - p % 3;
            const auto        &e     = rates[k];
            const Vector3d     mean =
              (e[p] + e[first] + e[first + 1] + e[first + 2]) / 4.;
            gap[p / 3] += above.volume[p] * (dissipation(above.cone[p], e[p]) -
                                             lower.s[n * k + p].dot(mean));
          }
      return gap;
    }

    /** Adds the error of the elastic stresses to the refinement indicator, and finds the
     *  largest one of all loads. */
    void
    add_elastic_errors(const ElasticSolver                &solver,
                       const std::vector<ElasticStresses> &stresses,
                       ShakedownBounds                    &found)
    {
      std::vector<double> error(found.gap.size(), 0.);
      for (const ElasticStresses &one : stresses)
        {
          const LinearField centre = mean_of_both(one),
                            used   = difference(one.averaged, centre);
          const double all         = solver.product_of_stresses(centre, centre);
          if (!(all > 0.))
            continue;
          const std::vector<double> own =
            solver.energies(difference(one.compatible, one.equilibrated));
          double sum = 0.;
          for (unsigned int c = 0; c < error.size(); ++c)
            {
              error[c] += own[c] / all;
              sum += own[c] / all;
            }
          found.elastic_error =
            std::max(found.elastic_error,
                     std::sqrt(sum) / 2. +
                       std::sqrt(solver.product_of_stresses(used, used) / all));
        }
      constexpr double part = 0.3;
      const auto       sum  = [](const std::vector<double> &all) {
        return std::accumulate(all.begin(), all.end(), 0.);
      };
      const double of_gap = sum(found.refinement_indicator),
                   of_all = sum(error);
      if (std::isfinite(of_gap) && of_all > 0.)
        for (unsigned int c = 0; c < error.size(); ++c)
          found.refinement_indicator[c] += part * of_gap / of_all * error[c];
    }

    /** Everything that follows from both solutions. */
    void
    evaluate(const BoundScene                   &bound,
             const VaryingLoads                 &loads,
             const BoundProblem                 &above,
             const BoundProblem                 &below,
             const ElasticSolver                &solver,
             const std::vector<ElasticStresses> &stresses,
             const std::vector<LinearField>     &fields,
             ShakedownBounds                    &found)
    {
      const unsigned int       n = 3 * above.n_triangles;
      std::vector<LinearField> rates, elastic;
      const auto               all_rates = above.B.rates(found.upper.bound.q);
      for (unsigned int k = 0; k < loads.states().size(); ++k)
        {
          rates.emplace_back(all_rates.begin() + n * k,
                             all_rates.begin() + n * (k + 1));
          elastic.push_back(of_state(loads, fields, k));
        }
      tie_states(below, loads, fields, found.lower);
      found.out_of_plane =
        factor_out_of_plane(bound, below, elastic, found.lower.bound);
      if (below.dead.squaredNorm() == 0.)
        found.elastic_limit = first_yield(below, elastic);
      const AlternatingPoint at = alternating_point(below, elastic);
      found.alternating         = at.factor;
      // Both loads may miss the same part of a traction.
      found.load_difference =
        std::max(difference_of_loads(solver, stresses), loads.departure(bound));
      if (found.load_difference < rounding_of_work)
        found.proven = std::min(
          proven_upper(
            above, loads, solver, stresses, rates, found.upper.bound),
          proven_alternating(bound, below, loads, solver, stresses, at));
      describe_mechanism(above, rates, elastic, found);
      found.gap = gap_of_states(above, rates, found.lower.bound);
      found.refinement_indicator = uneven_gap(bound, found.gap, found.lower);
      add_elastic_errors(solver, stresses, found);
      found.residual = LinearField(found.lower.bound.s.begin(),
                                   found.lower.bound.s.begin() + n);
      add(found.residual, -found.lower.bound.load, elastic[0]);
    }
  } // namespace

  ShakedownBounds
  shakedown_bounds(const BoundScene   &bound,
                   const VaryingLoads &loads,
                   const double        tolerance)
  {
    constexpr BoundQuestion no_question = {};
    const BoundProblem upper = with_dead_loads(bound, loads, BoundSide::upper),
                       lower = with_dead_loads(bound, loads, BoundSide::lower);
    const ElasticSolver compatible(bound, upper, BoundSide::upper),
      in_equilibrium(bound, lower, BoundSide::lower);
    const auto upper_forces =
                 load_vectors(bound, loads, BoundSide::upper, upper.n_dofs()),
               lower_forces =
                 load_vectors(bound, loads, BoundSide::lower, lower.n_dofs());
    const auto stresses = elastic_stresses(
      bound.triangles, compatible, in_equilibrium, upper_forces, lower_forces);
    std::vector<LinearField> fields;
    for (const ElasticStresses &one : stresses)
      fields.push_back(one.averaged);
    const BoundProblem above = of_all_states(
                         upper, loads, fields, upper_forces, BoundSide::upper),
                       below = of_all_states(
                         lower, loads, fields, lower_forces, BoundSide::lower);
    ShakedownBounds found;
    run_both(
      [&]() {
        found.upper = certified_upper(bound, above, tolerance, no_question);
      },
      [&]() {
        found.lower = certified_lower(bound, below, tolerance, no_question);
      });
    evaluate(bound, loads, above, below, compatible, stresses, fields, found);
    return found;
  }

  SimplexTable<Triangles>
  table_of_shakedown(const BoundScene &bound, const ShakedownBounds &found)
  {
    using Index = unsigned int;
    SimplexTable table(bound.triangles);
    table.add("velocity", dim, [&](const Index p, const Index, const Index d) {
      return found.upper.bound
        .q[dof_of_node(bound,
                       bound.bars.node_of_cell(bound.triangles, p / 3, p % 3)) +
           d];
    });
    const char *const names[] = {
      "residual_stress_xx", "residual_stress_yy", "residual_stress_xy"};
    for (Index i = 0; i < 3; ++i)
      table.add(names[i], 1, [&, i](const Index p, const Index, const Index) {
        const Mandel s = from_cone_axes(Mandel(found.residual[p]));
        return bound.units.stress * (i == 2 ? s[2] / sqrt2 : s[i]);
      });
    table.add_of_cells("plastic_strain_of_cycle", found.total);
    table.add_of_cells("net_plastic_strain", found.net);
    table.add_parts_of_gap(found.gap);
    table.add_materials();
    return table;
  }
} // namespace geocone::GEOCONE_DIM
