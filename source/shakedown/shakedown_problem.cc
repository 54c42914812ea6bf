// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/shakedown/shakedown_problem.h>

#include <algorithm>
#include <array>

namespace geocone::GEOCONE_DIM
{
  using Eigen::Vector3d;
  using Eigen::VectorXd;

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

  LinearField
  of_state(const VaryingLoads             &loads,
           const std::vector<LinearField> &fields,
           const unsigned int              state,
           const int                       minus)
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

  void
  tie_states(const BoundProblem             &problem,
             const VaryingLoads             &loads,
             const std::vector<LinearField> &fields,
             CertifiedSide                  &side)
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
            const double excess   = s.tail<2>().norm() - cone.a * s[0] - cone.k;
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
} // namespace geocone::GEOCONE_DIM
