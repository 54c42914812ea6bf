// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/constants.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/resources.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/limit_analysis/interval_bounds.h>
#include <geocone/plane_bounds/bound_loads.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using Eigen::VectorXd;
  using Kind = ParameterInterval::Kind;

  namespace
  {
    const UsedWhere used_intervals[] = {{"Analysis/Parameter intervals",
                                         "Analysis/Kind",
                                         {"limit load", "strength reduction"}}};

    constexpr unsigned int most_loads = 4; ///< 16 corners

    /** Adds the change of a load by its multiple to both load vectors of a problem. */
    class VaryingLoad
    {
    public:
      VaryingLoad(const BoundScene        &bound,
                  const BoundSide          side,
                  const unsigned int       n_dofs,
                  const ParameterInterval &interval)
        : F(VectorXd::Zero(n_dofs))
      {
        const Triangles &triangles = bound.triangles;
        const bool       is_weight = interval.kind == Kind::unit_weight;
        const LoadFactor of =
          is_weight ? LoadFactor::weight : LoadFactor::tractions;
        is_live = bound.factor == of || bound.factor == LoadFactor::all;
        if (!is_weight)
          add_tractions(
            bound, side, *bound.scene.tractions.list[interval.index], F);
        else
          for (unsigned int c = 0; c < triangles.cells.size(); ++c)
            if (triangles.material[c] == interval.index)
              add_force_of_cell(bound, side, c, weight_of_cell(bound, c), F);
      }

      void
      change(BoundProblem &problem, const double multiple) const
      {
        (is_live ? problem.live : problem.dead) += (multiple - 1.) * F;
      }

      VectorXd F; ///< of the given load
      bool     is_live;
    };

    std::vector<VaryingLoad>
    varying_loads(const BoundScene                     &bound,
                  const BoundSide                       side,
                  const unsigned int                    n_dofs,
                  const std::vector<ParameterInterval> &intervals)
    {
      std::vector<VaryingLoad> loads;
      for (const ParameterInterval &one : intervals)
        if (one.is_load())
          loads.emplace_back(bound, side, n_dofs, one);
      return loads;
    }

    /** Dissipation of each material by a mechanism; that of interfaces is last.
     *  @param problem with the yield cones */
    std::vector<double>
    dissipation_of_materials(const BoundScene   &bound,
                             const BoundProblem &problem,
                             const VectorXd     &q)
    {
      std::vector<double> D(bound.cones.size() + 1, 0.);
      const auto          e = problem.B.rates(q);
      for (unsigned int p = 0; p < problem.first_cut_point(); ++p)
        if (!problem.B.is_removed(p))
          D[p < 3 * problem.n_triangles ? bound.triangles.material[p / 3]
                                        : bound.cones.size()] +=
            problem.volume[p] * dissipation(problem.cone[p], e[p]);
      return D;
    }

    /** Multiple of the prescribed velocities in certified ones. */
    double
    scale_of_prescribed(const BoundProblem &problem, const VectorXd &q)
    {
      Eigen::Index i = 0;
      problem.prescribed.cwiseAbs().maxCoeff(&i);
      return q[i] / problem.prescribed[i];
    }
  } // namespace

  /** A bound on the load factor, in scaled units. */
  struct IntervalBounds::Side
  {
    SafetySearch::Attempt attempt;
    Ranges                at;
    unsigned int          n_solutions = 0;
  };

  /** Part of the box with its upper bound. */
  class IntervalBounds::Box
  {
  public:
    /** @param is_high whether each load is at its upper limit, a guess */
    Box(const IntervalBounds &owner,
        const Ranges         &ranges,
        std::vector<bool>     is_high)
      : owner(&owner)
      , ranges(ranges)
      , is_high(std::move(is_high))
    {}

    /** Computes the bound. A mechanism bounds all loads of the box; it is the one of the
     *  corner where its load is largest, if the next mechanisms agree on the corner. */
    void
    solve(const BoundScene &given,
          const double      F,
          const double      tolerance,
          Side             &sum)
    {
      const BoundScene bound = owner->with_strengths(
                         given, BoundSide::upper, ranges, F),
                       plain = owner->with_strengths(
                         given, BoundSide::upper, ranges, F, true);
      const BoundProblem problem = upper_problem(bound);
      const auto         loads   = varying_loads(
        bound, BoundSide::upper, problem.n_dofs(), owner->intervals);
      const BoundProblem     plain_problem = upper_problem(plain);
      constexpr unsigned int most          = 3;
      for (unsigned int i = 0; i < most; ++i)
        {
          BoundProblem at_corner = problem;
          for (unsigned int j = 0; j < loads.size(); ++j)
            loads[j].change(at_corner, multiple(j, is_high[j]));
          const CertifiedSide side =
            certified_upper(bound, at_corner, tolerance, {});
          sum.attempt.factorisations += side.solution.factorisations;
          ++sum.n_solutions;
          if (!side.bound.certified)
            {
              grows     = grows || side.solution.grows;
              rejection = side.bound.rejection;
              return;
            }
          const std::vector<bool> before = is_high;
          take(bound, problem, plain_problem, loads, side.bound.q);
          if (is_high == before)
            return;
        }
    }

    /** Position of the interval whose division lowers the bound most, if any. */
    std::optional<unsigned int>
    costliest() const
    {
      const auto most = std::max_element(cost.begin(), cost.end());
      if (most == cost.end() || !(*most > 0.))
        return std::nullopt;
      return most - cost.begin();
    }

    std::array<Box, 2>
    halves(const unsigned int i) const
    {
      std::array<Box, 2> parts = {
        {{*owner, ranges, is_high}, {*owner, ranges, is_high}}};
      parts[0].ranges[i][1] = parts[1].ranges[i][0] =
        (ranges[i][0] + ranges[i][1]) / 2.;
      return parts;
    }

    /** Takes the bound of a box that contains this one if it is less. */
    void
    take(const Box &outer)
    {
      if (!(outer.load < load))
        return;
      load   = outer.load;
      corner = outer.corner;
    }

    /** Parameters of the bound: loads are at their corner. */
    Ranges
    place() const
    {
      Ranges       at = ranges;
      unsigned int j  = 0;
      for (unsigned int i = 0; i < at.size(); ++i)
        if (owner->intervals[i].is_load())
          at[i].fill(ranges[i][corner[j++]]);
        else if (owner->intervals[i].kind != Kind::friction_angle)
          at[i][0] = at[i][1];
      return at;
    }

    double load = std::numeric_limits<double>::infinity(); ///< upper bound
    double plain_load = load; ///< of the same mechanism for the largest angles,
                              ///< at the corner that it was solved for
    bool        grows     = false;
    std::string rejection = "no mechanism bounds all loads of the box";

  private:
    double
    multiple(const unsigned int load, const bool is_high) const
    {
      unsigned int j = 0;
      for (unsigned int i = 0; i < ranges.size(); ++i)
        if (owner->intervals[i].is_load() && j++ == load)
          return ranges[i][is_high];
      return 1.;
    }

    /** Bounds all loads of the box by a mechanism, and keeps the bound if it is the least
     *  so far. */
    void
    take(const BoundScene               &bound,
         const BoundProblem             &problem,
         const BoundProblem             &plain,
         const std::vector<VaryingLoad> &loads,
         const VectorXd                 &q)
    {
      const auto D   = dissipation_of_materials(bound, problem, q),
                 D_p = dissipation_of_materials(bound, plain, q);
      double power = -problem.dead.dot(q), plain_power = power,
             work = problem.has_factor() ? problem.live.dot(q)
                                         : scale_of_prescribed(problem, q);
      for (unsigned int m = 0; m < D.size(); ++m)
        {
          power += D[m];
          plain_power += D_p[m];
        }
      // The load of a mechanism is largest where loads that drive it are least.
      std::vector<bool>   worst;
      std::vector<double> parts;
      for (unsigned int j = 0; j < loads.size(); ++j)
        {
          parts.push_back(loads[j].F.dot(q));
          worst.push_back(parts[j] < 0. &&
                          multiple(j, true) > multiple(j, false));
        }
      // Load of the mechanism at a corner, with a live load of its own.
      const auto load_at =
        [&](double P, const std::vector<bool> &at, const bool is_opposite) {
          double W = work;
          for (unsigned int j = 0; j < loads.size(); ++j)
            if (loads[j].is_live)
              W += (multiple(j, at[j] != is_opposite) - 1.) * parts[j];
            else
              P -= (multiple(j, at[j]) - 1.) * parts[j];
          return std::make_pair(P, W);
        };
      const auto largest = [&](const double without) {
        const auto [P, W] = load_at(without, worst, false);
        return !(W > least_work * q.lpNorm<Eigen::Infinity>())
                 ? std::numeric_limits<double>::infinity()
               : P < 0. ? P / load_at(without, worst, true).second
                        : P / W;
      };
      const double found = largest(power);
      if (cost.empty() || found < load)
        {
          load       = found;
          const auto [P, W] = load_at(plain_power, is_high, false);
          plain_load        = P / W;
          corner     = worst;
          cost.assign(ranges.size(), 0.);
          unsigned int j = 0;
          for (unsigned int i = 0; i < ranges.size(); ++i)
            if (const auto &own = owner->intervals[i];
                own.kind == Kind::friction_angle)
              cost[i] = D[own.index] - D_p[own.index];
            else if (own.is_load())
              {
                if (worst[j] != is_high[j])
                  cost[i] = std::abs(parts[j]) * (ranges[i][1] - ranges[i][0]);
                ++j;
              }
        }
      is_high = worst;
    }

    const IntervalBounds *owner;
    Ranges                ranges;
    std::vector<bool>     is_high; ///< of each load, at the next solution
    std::vector<bool>     corner;  ///< of the bound, likewise
    std::vector<double>   cost; ///< part of the bound by each interval's width
  };

  void
  IntervalBounds::declare(dealii::ParameterAcceptor &section)
  {
    section.add_parameter(
      "Parameter intervals",
      text,
      "Intervals of parameters, for all of which the load or factor of safety "
      "is bounded at once on the last mesh: NAME/PARAMETER: LEAST .. LARGEST; "
      "..., e.g. clay/Cohesion: 18e3 .. 22e3; fill/Unit weight: 18e3 .. 20e3. "
      "PARAMETER is Cohesion, Friction angle, Tensile strength, Unit weight or "
      "Density of a material, or Traction factor (a multiple) of a traction.");
  }

  void
  IntervalBounds::check_loads(const BoundScene &bound) const
  {
    const BoundProblem problem = upper_problem(bound);
    const auto         loads =
      varying_loads(bound, BoundSide::upper, problem.n_dofs(), intervals);
    require(loads.size() <= most_loads,
            interval_parameter,
            text,
            format("at most %u unit weights and tractions", most_loads),
            "each doubles the number of lower bounds");
    VectorXd     live   = problem.live;
    unsigned int n_live = 0;
    for (const VaryingLoad &one : loads)
      if (one.is_live)
        {
          ++n_live;
          live -= one.F;
        }
    const bool is_only_scaled =
      n_live == 1 && live.norm() < 1e-9 * problem.live.norm();
    const bool has_dead = problem.dead.norm() > 0.;
    require(
      n_live == 0 || is_only_scaled || !has_dead,
      interval_parameter,
      text,
      "intervals of loads with the load factor only where there is no other "
      "load, or they are all of these loads",
      "let the factor multiply the other loads: 'Analysis/Load factor of'");
  }

  void
  IntervalBounds::prepare(const BoundScene &bound)
  {
    intervals.clear();
    if (!is_asked())
      return;
    const Scene &scene = bound.scene;
    require(!bound.is_axisymmetric(),
            interval_parameter,
            text,
            "none around an axis",
            "compute the least and the largest values in a run each");
    require(scene.structures.list.empty(),
            interval_parameter,
            text,
            "none with structures",
            "leave it out: compute the least and the largest values");
    intervals = parameter_intervals(text, scene);
    check_loads(bound);
  }

  IntervalBounds::Ranges
  IntervalBounds::all_ranges() const
  {
    Ranges ranges;
    for (const ParameterInterval &one : intervals)
      ranges.push_back(one.range);
    return ranges;
  }

  BoundScene
  IntervalBounds::with_strengths(BoundScene      bound,
                                 const BoundSide side,
                                 const Ranges   &ranges,
                                 const double    F,
                                 const bool      is_plain) const
  {
    const bool   is_upper = side == BoundSide::upper;
    const double unit     = sqrt2 / bound.units.stress;
    bound.steeper.assign(bound.cones.size(), 0.);
    for (unsigned int m = 0; m < bound.cones.size(); ++m)
      {
        PointCone   &cone    = bound.cones[m];
        const double cos_phi = std::sqrt(1. - cone.a * cone.a);
        double       tan_1 = cone.a / cos_phi, tan_2 = tan_1;
        for (unsigned int i = 0; i < ranges.size(); ++i)
          {
            const double value = ranges[i][is_upper];
            if (intervals[i].is_load() || intervals[i].index != m)
              continue;
            if (intervals[i].kind == Kind::cohesion)
              cone.k = value * cos_phi * unit;
            else if (intervals[i].kind == Kind::tensile_strength)
              cone.cut_off = value * unit;
            else
              {
                tan_1 = std::tan(radians(ranges[i][0]));
                tan_2 = std::tan(radians(ranges[i][1]));
              }
          }
        const double by     = bound.scene.materials[m].is_reduced() ? F : 1.;
        double       larger = 1.;
        if (is_upper && !is_plain && tan_2 > tan_1)
          {
            // Either cohesion contains all strengths.
            const double more = cone.cut_off * (tan_2 - tan_1) / by * cos_phi;
            if (cone.is_cut() && more * tan_1 <= cone.k * (tan_2 - tan_1))
              cone.k += more;
            else
              larger = tan_2 / tan_1;
          }
        if (!is_upper && tan_2 > tan_1)
          bound.steeper[m] = std::sin(std::atan(tan_2 / by));
        bound.change(
          m, (is_upper ? tan_2 : tan_1) / by, larger / cos_phi / by, 1. / by);
      }
    return bound;
  }

  IntervalBounds::Side
  IntervalBounds::lower(const BoundScene &given,
                        const double      F,
                        const double      tolerance) const
  {
    const BoundScene bound =
      with_strengths(given, BoundSide::lower, all_ranges(), F);
    const BoundProblem problem = lower_problem(bound);
    const auto         loads =
      varying_loads(bound, BoundSide::lower, problem.n_dofs(), intervals);
    Side least;
    least.attempt.load      = std::numeric_limits<double>::infinity();
    least.attempt.certified = true;
    for (unsigned int corner = 0; corner < 1u << loads.size(); ++corner)
      {
        BoundProblem at_corner = problem;
        Ranges       at        = all_ranges();
        for (unsigned int i = 0, j = 0; i < intervals.size(); ++i)
          if (intervals[i].kind == Kind::cohesion ||
              intervals[i].kind == Kind::tensile_strength)
            at[i][1] = at[i][0];
          else if (intervals[i].is_load())
            {
              at[i].fill(at[i][corner >> j & 1]);
              loads[j++].change(at_corner, at[i][0]);
            }
        const CertifiedSide side =
          certified_lower(bound, at_corner, tolerance, {});
        ++least.n_solutions;
        least.attempt.factorisations += side.solution.factorisations;
        least.attempt.grows = least.attempt.grows || side.solution.grows;
        if (!side.bound.certified)
          {
            least.attempt.certified = false;
            least.attempt.rejection = side.bound.rejection;
            least.at.clear();
            return least;
          }
        if (side.bound.load < least.attempt.load)
          {
            least.attempt.load = side.bound.load;
            least.at           = at;
          }
      }
    return least;
  }

  IntervalBounds::Side
  IntervalBounds::upper(const BoundScene &given,
                        const double      F,
                        const double      tolerance,
                        const double      gap) const
  {
    constexpr unsigned int most = 40; // solutions
    Side                   sum;
    std::vector<Box>       boxes;
    const auto             n_loads =
      std::count_if(intervals.begin(), intervals.end(), [](const auto &one) {
        return one.is_load();
      });
    boxes.emplace_back(*this, all_ranges(), std::vector<bool>(n_loads, false));
    boxes.back().solve(given, F, tolerance, sum);
    const auto is_less = [](const Box &x, const Box &y) {
      return x.load < y.load;
    };
    while (true)
      {
        const auto top = std::max_element(boxes.begin(), boxes.end(), is_less);
        double     plain = -std::numeric_limits<double>::infinity();
        for (const Box &box : boxes)
          if (std::isfinite(box.load))
            plain = std::max(plain, box.plain_load);
        const auto divided = top->costliest();
        if (!divided || sum.n_solutions >= most ||
            top->load - plain <= gap * std::abs(top->load))
          {
            sum.attempt.load      = top->load;
            sum.attempt.certified = std::isfinite(top->load);
            sum.attempt.grows     = top->grows;
            sum.attempt.rejection = top->rejection;
            if (sum.attempt.certified)
              sum.at = top->place();
            return sum;
          }
        std::array<Box, 2> parts = top->halves(*divided);
        for (Box &part : parts)
          {
            part.solve(given, F, tolerance, sum);
            part.take(*top);
          }
        *top = parts[0];
        boxes.push_back(parts[1]);
      }
  }

  namespace
  {
    /** Bounds of the load factor for the whole box, with the strength divided by F. */
    class ReducedBox : public SafetySearch::Solver
    {
    public:
      using One =
        std::function<SafetySearch::Attempt(double, SafetySearch::Side)>;

      ReducedBox(const One                                     &bound,
                 const std::function<void(SafetySearch::Side)> &keep)
        : bound(bound)
        , keep_last(keep)
      {}

      std::array<SafetySearch::Attempt, 2>
      both(const double F) override
      {
        return {{bound(F, SafetySearch::lower), bound(F, SafetySearch::upper)}};
      }
      SafetySearch::Attempt
      one(const double F, const SafetySearch::Side side) override
      {
        return bound(F, side);
      }
      void
      keep(const SafetySearch::Side side) override
      {
        keep_last(side);
      }

    private:
      const One                                     bound;
      const std::function<void(SafetySearch::Side)> keep_last;
    };
  } // namespace

  IntervalBounds::Answer
  IntervalBounds::of_load(const BoundScene &given,
                          const double      tolerance,
                          const double      gap,
                          const double      unit) const
  {
    std::array<Side, 2> sides;
    run_both([&]() { sides[0] = upper(given, 1., tolerance, gap); },
             [&]() { sides[1] = lower(given, 1., tolerance); });
    Answer answer;
    answer.upper    = sides[0].attempt.certified
                        ? std::optional(unit * sides[0].attempt.load)
                        : std::nullopt;
    answer.lower    = sides[1].attempt.certified
                        ? std::optional(unit * sides[1].attempt.load)
                        : std::nullopt;
    answer.at_upper = sides[0].at;
    answer.at_lower = sides[1].at;
    for (unsigned int i = 0; i < 2; ++i)
      {
        answer.n_solutions[i] = sides[i].n_solutions;
        answer.reason[i]      = sides[i].attempt.rejection;
      }
    return answer;
  }

  IntervalBounds::Answer
  IntervalBounds::of_safety(const BoundScene           &given,
                            const double                tolerance,
                            const double                gap,
                            const std::array<double, 2> start,
                            const SafetySearch         &search) const
  {
    Answer              answer;
    std::array<Side, 2> last; // by BoundSide
    ReducedBox          solver(
      [&](const double F, const SafetySearch::Side side) {
        const bool is_lower = side == SafetySearch::lower;
        last[is_lower]      = is_lower ? lower(given, F, tolerance)
                                                : upper(given, F, tolerance, gap);
        answer.n_solutions[is_lower] += last[is_lower].n_solutions;
        return last[is_lower].attempt;
      },
      [&](const SafetySearch::Side side) {
        const bool is_lower = side == SafetySearch::lower;
        (is_lower ? answer.at_lower : answer.at_upper) = last[is_lower].at;
      });
    const auto prove = [&](const SafetySearch::Side side) {
      const bool            is_lower = side == SafetySearch::lower;
      std::optional<double> found;
      try
        {
          found = SafetySearch(search).proven(solver, side, start[!is_lower]);
          if (!found)
            answer.reason[is_lower] = last[is_lower].attempt.rejection;
        }
      catch (const StepFailure &failure)
        {
          answer.reason[is_lower] = failure.what();
        }
      (is_lower ? answer.lower : answer.upper) = found;
    };
    run_both([&]() { prove(SafetySearch::upper); },
             [&]() { prove(SafetySearch::lower); });
    return answer;
  }

  Json
  IntervalBounds::topic_of(const Answer &answer) const
  {
    const auto known = [](const std::optional<double> &value) {
      return value ? Json(*value) : Json();
    };
    const auto place = [&](const Ranges &at) {
      Json json = Json::object();
      for (unsigned int i = 0; i < at.size(); ++i)
        {
          const auto &[least, most] = at[i];
          const double unit         = intervals[i].unit;
          json[intervals[i].name]   = least == most
                                        ? Json(unit * least)
                                        : Json({unit * least, unit * most});
        }
      return json;
    };
    return {{"lower", known(answer.lower)},
            {"upper", known(answer.upper)},
            {"certified", answer.lower && answer.upper},
            {"intervals", place(all_ranges())},
            {"lower_at", place(answer.at_lower)},
            {"upper_at", place(answer.at_upper)},
            {"solutions_lower", answer.n_solutions[1]},
            {"solutions_upper", answer.n_solutions[0]}};
  }

  std::string
  IntervalBounds::text_of(const Answer      &answer,
                          const std::string &bounded,
                          const std::string &unit,
                          const bool         is_associated) const
  {
    const auto shown = [](const std::optional<double> &value) {
      return value ? format("%.6g", *value) : std::string("?");
    };
    std::string text =
      is_associated
        ? "for all parameters of the intervals: " + shown(answer.lower) +
            " <= " + bounded + " <= " + shown(answer.upper) + unit
        : "for all parameters of the intervals and any dilatancy: " + bounded +
            " <= " + shown(answer.upper) + unit +
            "; were flow associated: " + shown(answer.lower) + " <= " + bounded;
    for (const auto &[side, at] :
         {std::pair("lower", answer.at_lower), {"upper", answer.at_upper}})
      for (unsigned int i = 0; i < at.size(); ++i)
        text += (i == 0 ? std::string("\n  the ") + side + " bound is that of "
                        : ", ") +
                intervals[i].name + " = " +
                format("%g", intervals[i].unit * at[i][0]) +
                (at[i][0] == at[i][1]
                   ? ""
                   : format(" .. %g", intervals[i].unit * at[i][1]));
    return text;
  }

  std::vector<std::string>
  IntervalBounds::warnings_of(const Answer      &answer,
                              const std::string &bounded) const
  {
    std::vector<std::string> all;
    for (const auto &[side, i] : {std::pair("upper", 0), {"lower", 1}})
      if (!(i == 0 ? answer.upper : answer.lower))
        all.push_back(std::string("the ") + side + " bound of " + bounded +
                      " for all parameters of the intervals is not certified "
                      "on the last mesh: " +
                      (answer.reason[i].empty() ? "it is zero or has no limit"
                                                : answer.reason[i]) +
                      "; narrow the intervals, or change 'Analysis/Maximum "
                      "cells' to end on another mesh");
    return all;
  }
} // namespace geocone::GEOCONE_DIM
