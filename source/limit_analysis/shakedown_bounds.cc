// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/resources.h>
#include <geocone/limit_analysis/bar_cells.h>
#include <geocone/limit_analysis/shakedown_bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    /** Adds a multiple of a field to another one. */
    void
    add(LinearField &to, const double factor, const LinearField &field)
    {
      for (unsigned int p = 0; p < to.size(); ++p)
        to[p] += factor * field[p];
    }

    /** Averages a field at the vertices over the triangles of a material, by their areas.
     *  Errors of derivatives alternate between triangles; the mean is more accurate. */
    LinearField
    averaged(const Triangles &triangles, const LinearField &field)
    {
      std::map<std::array<unsigned int, 2>, std::pair<double, Vector3d>> sums;
      const auto sum_at = [&](const unsigned int p) -> auto &
      {
        return sums
          .try_emplace(
            {{triangles.cells[p / 3][p % 3], triangles.material[p / 3]}},
            0.,
            Vector3d::Zero())
          .first->second;
      };
      for (unsigned int p = 0; p < field.size(); ++p)
        {
          const double area = triangles.area(p / 3);
          auto        &sum  = sum_at(p);
          sum.first += area;
          sum.second += area * field[p];
        }
      LinearField mean(field.size());
      for (unsigned int p = 0; p < field.size(); ++p)
        mean[p] = sum_at(p).second / sum_at(p).first;
      return mean;
    }

    /** Mean of both elastic stresses, which misses the exact ones by half of their
     *  distance in the energy norm (Prager and Synge 1947). */
    LinearField
    mean_of_both(const ElasticStresses &stresses)
    {
      LinearField s(stresses.compatible);
      for (unsigned int p = 0; p < s.size(); ++p)
        s[p] = (s[p] + stresses.equilibrated[p]) / 2.;
      return s;
    }

    LinearField
    difference(const LinearField &a, const LinearField &b)
    {
      LinearField all(a);
      add(all, -1., b);
      return all;
    }

    /** Problem of a side with dead loads only. */
    BoundProblem
    with_dead_loads(const BoundScene   &bound,
                    const VaryingLoads &loads,
                    const BoundSide     side)
    {
      BoundProblem problem =
        side == BoundSide::upper ? upper_problem(bound) : lower_problem(bound);
      problem.live.setZero(); // all tractions
      loads.add_constant(bound, side, problem.dead);
      return problem;
    }

    std::vector<VectorXd>
    load_vectors(const BoundScene   &bound,
                 const VaryingLoads &loads,
                 const BoundSide     side,
                 const unsigned int  n_dofs)
    {
      std::vector<VectorXd> all(loads.n_loads(), VectorXd::Zero(n_dofs));
      for (unsigned int i = 0; i < all.size(); ++i)
        loads.add(bound, side, i, all[i]);
      return all;
    }

    /** Combination of the fields of all loads.
     *  @param minus state whose combination is subtracted, or -1 */
    LinearField
    of_state(const VaryingLoads             &loads,
             const std::vector<LinearField> &fields,
             const unsigned int              state,
             const int                       minus = -1)
    {
      LinearField sum(fields[0].size(), Vector3d::Zero());
      for (unsigned int i = 0; i < fields.size(); ++i)
        {
          double factor = loads.states()[state][i];
          if (minus >= 0)
            factor -= loads.states()[minus][i];
          if (factor != 0.)
            add(sum, factor, fields[i]);
        }
      return sum;
    }

    /**
     * Problem of all states of the loads. The points of the first state keep the dofs of
     * the mesh; those of each further state are additional cells. Their stresses differ
     * from those of the state before by the load factor times the difference of the
     * elastic stresses, which is equilibrium of further dofs w of each point. The rates
     * are e_1 = B q - w_2, e_k = w_k - w_{k+1}: those of all states add up to B q.
     * @param fields elastic stresses of all loads
     * @param forces vectors of all loads
     */
    BoundProblem
    of_all_states(const BoundProblem             &first,
                  const VaryingLoads             &loads,
                  const std::vector<LinearField> &fields,
                  const std::vector<VectorXd>    &forces,
                  const BoundSide                 side)
    {
      const unsigned int n = first.n_points(), n_states = loads.states().size(),
                         n_dofs = first.n_dofs(),
                         n_all  = n_dofs + 3 * n * (n_states - 1);
      BoundProblem problem      = first;
      for (unsigned int i = 0; i < fields.size(); ++i)
        problem.live += loads.states()[0][i] * forces[i];
      problem.is_prescribed.resize(n_all, false);
      problem.has_no_force.resize(n_all, false);
      for (VectorXd *one : {&problem.prescribed, &problem.dead, &problem.live})
        one->conservativeResizeLike(VectorXd::Zero(n_all));
      // Certificates of lower bounds know no dofs beyond these.
      problem.first_cut_dof = side == BoundSide::lower ? n_dofs : n_all;

      const auto tie = [&](const unsigned int k, const unsigned int p) {
        const unsigned int dof = n_dofs + 3 * (n * (k - 1) + p);
        return std::array<unsigned int, 3>{{dof, dof + 1, dof + 2}};
      };
      first.B.with_n_columns([&](const auto size) {
        constexpr int columns = decltype(size)::value;
        problem.B             = PointStrains(columns + 3);
        for (unsigned int k = 0; k < n_states; ++k)
          for (unsigned int p = 0; p < n; ++p)
            {
              StrainMatrix              B = StrainMatrix::Zero(3, columns + 6);
              std::vector<unsigned int> dofs(first.B.dofs_of(p),
                                             first.B.dofs_of(p) + columns);
              if (k == 0)
                B.leftCols<columns>() = first.B.template matrix<columns>(p);
              else
                B.middleCols<3>(columns).setIdentity();
              const auto own  = tie(std::max(k, 1U), p),
                         next = tie(std::min(k + 1, n_states - 1), p);
              dofs.insert(dofs.end(), own.begin(), own.end());
              dofs.insert(dofs.end(), next.begin(), next.end());
              if (k + 1 < n_states)
                B.rightCols<3>() = -Eigen::Matrix3d::Identity();
              problem.B.add(B, dofs);
            }
      });
      for (unsigned int k = 1; k < n_states; ++k)
        {
          const LinearField change = of_state(loads, fields, k, k - 1);
          for (unsigned int p = 0; p < n; ++p)
            {
              problem.volume.push_back(first.volume[p]);
              problem.cone.push_back(first.cone[p]);
              if (p % 3 == 0)
                problem.owner.push_back(p / 3);
              Vector3d mean = change[p]; // a tie of stresses, or the exact work
              if (side == BoundSide::upper)
                mean = (change[p] + change[p - p % 3] + change[p - p % 3 + 1] +
                        change[p - p % 3 + 2]) /
                       4.;
              const auto dofs = tie(k, p);
              for (unsigned int i = 0; i < 3; ++i)
                problem.live[dofs[i]] = first.volume[p] * mean[i];
              if (first.cone[p].is_cylinder()) // its rates vanish in all states
                {
                  problem.is_prescribed[dofs[0]] = true;
                  problem.live[dofs[0]]          = 0.;
                }
            }
        }
      return problem;
    }

    /** Stresses of all states from those of the first one. They are scaled into their
     *  cones where no dead load prevents it, and replace those of the solver, which tie
     *  the states up to rounding. */
    void
    tie_states(const BoundProblem             &problem,
               const VaryingLoads             &loads,
               const std::vector<LinearField> &fields,
               CertifiedBounds::Side          &side)
    {
      Bound             &bound = side.bound;
      const unsigned int n     = 3 * problem.n_triangles;
      double             theta = 1., most = 0.;
      for (unsigned int k = 0; k < loads.states().size(); ++k)
        {
          LinearField change;
          if (k > 0)
            change = of_state(loads, fields, k, k - 1);
          for (unsigned int p = 0; p < n; ++p)
            {
              Vector3d &s = bound.s[n * k + p];
              if (k > 0)
                s = bound.s[n * (k - 1) + p] + bound.load * change[p];
              const PointCone &cone = problem.cone[p];
              const double excess = s.tail<2>().norm() - cone.a * s[0] - cone.k;
              if (excess > 0.)
                theta = std::min(theta, cone.k / (cone.k + excess));
              most = std::max(most, excess / s.norm());
            }
        }
      if (problem.dead.squaredNorm() == 0.)
        {
          bound.load *= theta;
          for (Vector3d &s : bound.s)
            s *= theta;
        }
      else if (most > rounding_strength && bound.certified)
        {
          bound.certified = false;
          bound.rejection = "its stresses exceed the strength in other states, "
                            "and a dead load leaves nothing to scale";
        }
    }

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

    /** Radius of the smallest circle around points of the plane, by increments. */
    double
    enclosing_radius(const std::vector<Eigen::Vector2d> &points)
    {
      Eigen::Vector2d centre     = points[0];
      double          radius     = 0.;
      const auto      is_outside = [&](const Eigen::Vector2d &x) {
        return (x - centre).norm() > radius * (1. + 1e-12);
      };
      const auto through = [&](const Eigen::Vector2d &a,
                               const Eigen::Vector2d &b) {
        centre = (a + b) / 2.;
        radius = (a - b).norm() / 2.;
      };
      for (unsigned int i = 1; i < points.size(); ++i)
        {
          if (!is_outside(points[i]))
            continue;
          through(points[i], points[i]);
          for (unsigned int j = 0; j < i; ++j)
            {
              if (!is_outside(points[j]))
                continue;
              through(points[i], points[j]);
              for (unsigned int l = 0; l < j; ++l)
                {
                  if (!is_outside(points[l]))
                    continue;
                  Eigen::Matrix2d sides;
                  sides.row(0) = (points[j] - points[i]).transpose();
                  sides.row(1) = (points[l] - points[i]).transpose();
                  const Eigen::Vector2d arm =
                    sides.inverse() * sides.rowwise().squaredNorm() / 2.;
                  if (!arm.allFinite())
                    continue; // on a line: two of the points suffice
                  centre = points[i] + arm;
                  radius = arm.norm();
                }
            }
        }
      return radius;
    }

    /** Alternating plasticity at a point, where strains of all states add up to zero. */
    struct AlternatingPoint
    {
      double       factor = std::numeric_limits<double>::infinity();
      unsigned int point  = 0;
      std::array<unsigned int, 2> states = {
        {0, 0}}; ///< whose stresses differ most
    };

    /** Finds the point with the least factor: no residual stress makes the stresses of
     *  all states admissible under a larger one. Where phi > 0 a pressure does. */
    AlternatingPoint
    alternating_point(const BoundProblem             &problem,
                      const std::vector<LinearField> &elastic)
    {
      AlternatingPoint             found;
      std::vector<Eigen::Vector2d> points(elastic.size());
      for (unsigned int p = 0; p < 3 * problem.n_triangles; ++p)
        {
          if (!problem.cone[p].is_cylinder())
            continue;
          for (unsigned int k = 0; k < elastic.size(); ++k)
            points[k] = elastic[k][p].tail<2>();
          const double radius = enclosing_radius(points);
          if (!(problem.cone[p].k < found.factor * radius))
            continue;
          found.factor = problem.cone[p].k / radius;
          found.point  = p;
        }
      double largest = 0.;
      for (unsigned int a = 0; a < elastic.size(); ++a)
        for (unsigned int b = 0; b < a; ++b)
          if (const double distance =
                (elastic[a][found.point] - elastic[b][found.point])
                  .tail<2>()
                  .norm();
              distance > largest)
            {
              largest      = distance;
              found.states = {{a, b}};
            }
      return found;
    }

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

    /** Upper bound by dissipation and work, which is known up to an error. */
    double
    bound_with_error(const double power, const double work, const double error)
    {
      if (power < 0.)
        return power / (work + error);
      return error < work ? power / (work - error)
                          : std::numeric_limits<double>::infinity();
    }

    /** Upper bound by the work of the means of both elastic stresses, and its error. The
     *  error of a load does no work on compatible strains. */
    double
    proven_upper(const BoundProblem                 &above,
                 const VaryingLoads                 &loads,
                 const ElasticSolver                &solver,
                 const std::vector<ElasticStresses> &stresses,
                 const std::vector<LinearField>     &rates,
                 const Bound                        &upper)
    {
      double       work = above.live.dot(upper.q), error = 0.;
      const double power = upper.load * work;
      for (unsigned int i = 0; i < stresses.size(); ++i)
        {
          const ElasticStresses &one = stresses[i];
          const LinearField      missed =
            difference(one.compatible, one.equilibrated);
          LinearField strains(rates[0].size(), Vector3d::Zero());
          for (unsigned int k = 1; k < rates.size(); ++k)
            if (const double factor =
                  loads.states()[k][i] - loads.states()[0][i];
                factor != 0.)
              add(strains, factor, rates[k]);
          work +=
            solver.work(difference(mean_of_both(one), one.averaged), strains);
          add(strains, -1., solver.compatible_part(strains));
          error += std::sqrt(solver.product_of_stresses(missed, missed) *
                             solver.product_of_strains(strains, strains)) /
                   2.;
        }
      return bound_with_error(power, work, error);
    }

    /** Upper bound by alternating strains of two states in the triangles where their
     *  stresses differ most relative to the strength. More triangles have a smaller error
     *  of the work, fewer of them a larger work. */
    double
    proven_alternating(const BoundScene                   &bound,
                       const BoundProblem                 &problem,
                       const VaryingLoads                 &loads,
                       const ElasticSolver                &solver,
                       const std::vector<ElasticStresses> &stresses,
                       const AlternatingPoint             &at)
    {
      const unsigned int n = 3 * problem.n_triangles;
      LinearField        change(n, Vector3d::Zero()), missed(change);
      for (unsigned int i = 0; i < stresses.size(); ++i)
        {
          const ElasticStresses &one = stresses[i];
          const double           factor =
            loads.states()[at.states[0]][i] - loads.states()[at.states[1]][i];
          add(change, factor, mean_of_both(one));
          add(
            missed, factor / 2., difference(one.compatible, one.equilibrated));
        }
      const double error =
        std::sqrt(solver.product_of_stresses(missed, missed));
      struct Cell
      {
        double work, power, square; ///< of unit strains along the change
      };
      std::vector<Cell> cells;
      for (unsigned int p = 0; p < n; p += 3)
        if (problem.cone[p].is_cylinder())
          {
            const double area = 3. * problem.volume[p],
                         k    = (problem.cone[p].k + problem.cone[p + 1].k +
                              problem.cone[p + 2].k) /
                             3.;
            const Vector3d s = (change[p] + change[p + 1] + change[p + 2]) / 3.;
            cells.push_back(
              {area * s.tail<2>().norm(),
               2. * area * k,
               area *
                 bound.scene.materials[bound.triangles.material[p / 3]]
                   .elasticity()
                   .two_G /
                 bound.units.stress});
          }
      std::sort(cells.begin(), cells.end(), [](const Cell &a, const Cell &b) {
        return a.work * b.power > b.work * a.power;
      });
      double best = std::numeric_limits<double>::infinity();
      Cell   sum  = {0., 0., 0.};
      for (const Cell &cell : cells)
        {
          sum.work += cell.work;
          sum.power += cell.power;
          sum.square += cell.square;
          best =
            std::min(best,
                     bound_with_error(
                       sum.power, sum.work, error * std::sqrt(sum.square)));
        }
      return best;
    }

    /** Kind of the mechanism: plastic strains of all states and their sum. */
    void
    describe_mechanism(const BoundProblem             &above,
                       const std::vector<LinearField> &rates,
                       ShakedownBounds                &found)
    {
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
              of_state[k] += above.volume[p] * shear;
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

    /** Elastic stresses of all loads, by both methods. */
    std::vector<ElasticStresses>
    elastic_stresses(const Triangles             &triangles,
                     const ElasticSolver         &upper,
                     const ElasticSolver         &lower,
                     const std::vector<VectorXd> &upper_forces,
                     const std::vector<VectorXd> &lower_forces)
    {
      std::vector<ElasticStresses> all(upper_forces.size());
      for (unsigned int i = 0; i < all.size(); ++i)
        {
          all[i].compatible   = upper.stresses(upper_forces[i]);
          all[i].equilibrated = lower.stresses(lower_forces[i]);
          all[i].averaged     = averaged(triangles, all[i].compatible);
        }
      return all;
    }

    /** Largest work of the differences of both elastic stresses on compatible strains,
     *  relative to that of the stresses. It vanishes if both carry the same loads, and
     *  does not where tractions are not linear between the vertices. */
    double
    difference_of_loads(const ElasticSolver                &solver,
                        const std::vector<ElasticStresses> &stresses)
    {
      double largest = 0.;
      for (const ElasticStresses &one : stresses)
        {
          const auto  &s      = one.compatible;
          const double all    = solver.product_of_stresses(s, s),
                       missed = solver.product_of_stresses(
                         s, difference(one.equilibrated, s));
          if (all > 0.)
            largest = std::max(largest, std::abs(missed) / all);
        }
      return largest;
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
      describe_mechanism(above, rates, found);
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
    constexpr double   no_question = std::numeric_limits<double>::quiet_NaN();
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
