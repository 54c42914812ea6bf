// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/gradients.h>
#include <geocone/plane_bounds/bound_loads.h>
#include <geocone/reliability/sampled_body.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using Eigen::VectorXd;

  namespace
  {
    double
    factor_at(const std::vector<double> &factors, const unsigned int cell)
    {
      return factors.empty() ? 1. : factors[cell];
    }

    /** Multiplies cohesion and tan(phi) of a cone. */
    PointCone
    multiplied(PointCone cone, const double cohesion, const double tan_phi)
    {
      const double before = std::sqrt(1. - cone.a * cone.a),
                   slope  = tan_phi * cone.a / before,
                   after  = 1. / std::sqrt(1. + slope * slope);
      cone.a              = slope * after;
      cone.k *= cohesion * after / before;
      return cone;
    }
  } // namespace

  SampledBody::SampledBody(BoundScene                mean_,
                           std::vector<unsigned int> parent_,
                           const unsigned int        n_first)
    : mean(std::move(mean_))
    , parent(std::move(parent_))
    , n_first(n_first)
  {
    for (const auto &[side, kind] :
         {std::pair<Side &, BoundSide>(above, BoundSide::upper),
          {below, BoundSide::lower}})
      {
        side.problem =
          kind == BoundSide::upper ? upper_problem(mean) : lower_problem(mean);
        side.other_loads = side.problem.live;
        for (unsigned int c = 0; c < parent.size(); ++c)
          add_force_of_cell(
            mean, kind, c, -weight_of_cell(mean, c), side.other_loads);
      }
  }

  BoundProblem
  SampledBody::of_sample(const Side          &side,
                         const BoundSide      kind,
                         const RandomFactors &factors) const
  {
    BoundProblem problem = side.problem;
    for (unsigned int p = 0; p < 3 * problem.n_triangles; ++p)
      if (!problem.B.is_removed(p))
        problem.cone[p] = multiplied(problem.cone[p],
                                     factor_at(factors.cohesion, parent[p / 3]),
                                     factor_at(factors.tan_phi, parent[p / 3]));
    if (factors.unit_weight.empty())
      return problem;
    problem.live = side.other_loads;
    for (unsigned int c = 0; c < parent.size(); ++c)
      add_force_of_cell(mean,
                        kind,
                        c,
                        factors.unit_weight[parent[c]] *
                          weight_of_cell(mean, c),
                        problem.live);
    return problem;
  }

  Mechanism
  SampledBody::mechanism_of(const VectorXd &q) const
  {
    const BoundProblem &problem = above.problem;
    Mechanism           mechanism;
    mechanism.dissipation.assign(n_first, 0.);
    const auto rates = problem.B.rates(q);
    for (unsigned int p = 0; p < problem.n_points(); ++p)
      {
        const double power =
          problem.volume[p] * dissipation(problem.cone[p], rates[p]);
        const unsigned int c = p / 3;
        (c < parent.size() ? mechanism.dissipation[parent[c]]
                           : mechanism.other_dissipation) += power;
      }
    mechanism.other_loads = above.other_loads.dot(q);
    mechanism.weight      = work_of_weight(q);
    return mechanism;
  }

  std::vector<double>
  SampledBody::work_of_weight(const VectorXd &q) const
  {
    std::vector<double> work(n_first, 0.);
    // A unit force in one cell changes few entries.
    const Triangles   &triangles = mean.triangles;
    const unsigned int first     = dim * triangles.vertices.size();
    for (unsigned int c = 0; c < parent.size(); ++c)
      {
        const dealii::Tensor<1, dim> weight = weight_of_cell(mean, c);
        const double                 area =
          triangles.area(c) / (mean.units.length * mean.units.length);
        for (const unsigned int edge : triangles.edges_of_cell[c])
          for (unsigned int d = 0; d < dim; ++d)
            work[parent[c]] +=
              weight[d] * area / 3. * q[first + dim * edge + d];
      }
    return work;
  }

  std::optional<Mechanism>
  SampledBody::mechanism_of(const RandomFactors &factors,
                            const Bound         &upper) const
  {
    if (!upper.certified || !factors.tan_phi.empty())
      return std::nullopt;
    return mechanism_of(upper.q);
  }

  std::optional<StressField>
  SampledBody::stresses_of(const RandomFactors &factors,
                           const Bound         &lower) const
  {
    const BoundProblem &problem = below.problem;
    if (!lower.certified || !(lower.load > 0.) || !factors.tan_phi.empty() ||
        !factors.unit_weight.empty() || !problem.can_be_scaled() ||
        problem.first_cut_point() < problem.n_points())
      return std::nullopt;
    StressField field;
    field.required.assign(n_first, 0.);
    for (unsigned int p = 0; p < problem.n_points(); ++p)
      {
        if (problem.B.is_removed(p))
          continue;
        const PointCone   &cone = problem.cone[p];
        const unsigned int c    = p / 3;
        double            &most =
          c < parent.size() ? field.required[parent[c]] : field.of_others;
        most = std::max(most,
                        (lower.s[p].tail<2>().norm() - cone.a * lower.s[p][0]) /
                          (cone.k * lower.load));
      }
    return field;
  }

  double
  Mechanism::bound(const RandomFactors &factors) const
  {
    double dissipated = other_dissipation, work = other_loads;
    for (unsigned int c = 0; c < weight.size(); ++c)
      {
        dissipated += factor_at(factors.cohesion, c) * dissipation[c];
        work += factor_at(factors.unit_weight, c) * weight[c];
      }
    return work > 0. ? dissipated / work
                     : std::numeric_limits<double>::infinity();
  }

  double
  StressField::bound(const RandomFactors &factors) const
  {
    double most = of_others;
    for (unsigned int c = 0; c < required.size(); ++c)
      most = std::max(most, required[c] / factor_at(factors.cohesion, c));
    return most > 0. ? (1. - rounding_strength) / most : 0.;
  }

  SampleVerdict
  SampledBody::judge(const RandomFactors &factors,
                     const double         tolerance,
                     const BoundSide      side) const
  {
    using Kind = SampleVerdict::Kind;
    // A fifth of the distance from 1 is enough to extrapolate; most solutions end with it,
    // and the others may end nearer to the optimum.
    constexpr BoundQuestion question = {1., 0.2};
    constexpr double        sharper  = 0.1;
    const bool              is_lower = side == BoundSide::lower;
    const BoundProblem      problem =
      of_sample(is_lower ? below : above, side, factors);
    const CertifiedSide found =
      is_lower ? certified_lower(mean, problem, sharper * tolerance, question)
               : certified_upper(mean, problem, sharper * tolerance, question);
    SampleVerdict verdict;
    verdict.factorisations = found.solution.factorisations;
    if (found.bound.certified)
      (is_lower ? verdict.lower : verdict.upper) = found.bound.load;
    if (!is_lower)
      verdict.mechanism = mechanism_of(factors, found.bound);
    if (verdict.upper < 1.)
      verdict.kind = Kind::fails;
    else if (verdict.lower >= 1.)
      {
        verdict.kind     = Kind::stands;
        verdict.stresses = stresses_of(factors, found.bound);
      }
    else
      {
        verdict.refinement_indicator =
          is_lower ? found.power : power_of_cells(problem, found.bound);
        for (unsigned int c = 0; c < parent.size(); ++c)
          verdict.refinement_indicator[c] *= std::sqrt(mean.triangles.area(c));
      }
    return verdict;
  }

  std::vector<double>
  SampledBody::power_of_cells(const BoundProblem &problem,
                              const Bound        &upper) const
  {
    std::vector<double> power(parent.size(), 0.);
    const auto          rates = problem.B.rates(upper.q);
    for (unsigned int p = 0; p < problem.n_points(); ++p)
      {
        const unsigned int c = p / 3;
        power[c < parent.size() ? c : problem.owner[c - parent.size()]] +=
          problem.volume[p] * dissipation(problem.cone[p], rates[p]);
      }
    return power;
  }

  RandomFactors
  SampledBody::elasticity(const BoundProblem  &problem,
                          const RandomFactors &factors,
                          const CertifiedSide &upper) const
  {
    RandomFactors elasticity;
    elasticity.cohesion.assign(n_first, 0.);
    elasticity.tan_phi.assign(n_first, 0.);
    elasticity.unit_weight = work_of_weight(upper.bound.q);
    const auto rates       = problem.B.rates(upper.bound.q);
    double     power       = 0.;
    for (unsigned int p = 0; p < problem.n_points(); ++p)
      {
        const PointCone &cone = problem.cone[p];
        const double     V    = problem.volume[p];
        power += V * dissipation(cone, rates[p]);
        if (p >= 3 * parent.size() || cone.is_cut() || problem.B.is_removed(p))
          continue;
        const double y = V * dissipation({cone.a, 1.}, rates[p]);
        elasticity.cohesion[parent[p / 3]] += y * cone.k;
        elasticity.tan_phi[parent[p / 3]] +=
          y * by_log_tan_phi(cone, upper.solution.s[p][0]);
      }
    for (unsigned int c = 0; c < n_first; ++c)
      {
        elasticity.cohesion[c] /= power;
        elasticity.tan_phi[c] /= power;
        elasticity.unit_weight[c] *=
          -factor_at(factors.unit_weight, c) * upper.bound.load / power;
      }
    return elasticity;
  }

  LoadResponse
  SampledBody::respond(const RandomFactors &factors,
                       const double         tolerance) const
  {
    const BoundProblem problem = of_sample(above, BoundSide::upper, factors);
    const CertifiedSide upper   = certified_upper(mean, problem, tolerance, {}),
                        lower   = certified_lower(
                          mean,
                          of_sample(below, BoundSide::lower, factors),
                          tolerance,
                          {});
    return {std::sqrt(upper.bound.load * lower.bound.load),
            upper.bound.load / lower.bound.load - 1.,
            elasticity(problem, factors, upper),
            upper.solution.factorisations + lower.solution.factorisations,
            mechanism_of(factors, upper.bound),
            stresses_of(factors, lower.bound)};
  }

  VectorXd
  SampledBody::velocities(const RandomFactors &factors,
                          const double         tolerance) const
  {
    return certified_upper(
             mean, of_sample(above, BoundSide::upper, factors), tolerance, {})
      .bound.q;
  }
} // namespace geocone::GEOCONE_DIM
