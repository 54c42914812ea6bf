// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/bounds/plane_strength.h>
#include <geocone/plane_bounds/bound_solution.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    /** Returns the factor of the live loads that makes them of order one. It is one unless
     *  they are far above or below the strength, where rates would be too small or too
     *  large for the solver. */
    double
    scale_of_loads(const BoundProblem &plane)
    {
      const double norm = plane.live.norm();
      return norm > 1e3 || (norm > 0. && norm < 1e-5) ? 1. / norm : 1.;
    }

    /** Solves a plane problem. Ellipses become discs in the variables (s_n, y) with
     *  s_t = k d + A y: rates are A' B q, and the centres are dead loads.
     *  @tparam columns number of dofs of a point */
    template <int columns>
    BoundSolution
    solve_with_columns(const BoundProblem &plane, ConicOptions options)
    {
      using Cones     = PointGroupOf<PlaneCone, columns>;
      using Cylinders = PointGroupOf<PlaneCylinder, columns>;
      ConicProblem problem;
      problem.is_prescribed = plane.is_prescribed;
      problem.prescribed    = plane.prescribed;
      problem.dead          = plane.dead;
      const double scale    = scale_of_loads(plane);
      problem.live          = scale * plane.live;
      options.question /= scale;
      std::vector<PlaneCone> laws;
      for (const PointCone &cone : plane.cone)
        if (!cone.is_cylinder())
          laws.push_back({{}, cone.a});
      auto cones = std::make_unique<Cones>(laws);
      auto cylinders =
        std::make_unique<Cylinders>(std::vector<PlaneCylinder>(1));
      for (unsigned int p = 0; p < plane.n_points(); ++p)
        {
          const PointCone        &cone = plane.cone[p];
          const unsigned int     *dofs = plane.B.dofs_of(p);
          const double            V    = plane.volume[p];
          typename Cones::Strains B    = plane.B.matrix<columns>(p);
          if (const StrengthEllipse &ellipse = cone.ellipse;
              !ellipse.is_circle())
            {
              const Eigen::Matrix<double, 1, columns> centre =
                V * cone.k * ellipse.centre().transpose() *
                B.template bottomRows<2>();
              for (int j = 0; j < columns; ++j)
                {
                  problem.dead[dofs[j]] -= centre[j];
                  B.template bottomRows<2>().col(j) =
                    ellipse.rates(B.template bottomRows<2>().col(j));
                }
            }
          if (cone.is_cylinder())
            cylinders->add(B, dofs, V, 0, cone.k);
          else
            {
              B.row(0) /= cone.a;
              cones->add(B, dofs, V, cones->n_points(), cone.k);
            }
        }

      std::vector<const PointGroup *> group_of = {cones.get(), cylinders.get()};
      if (cones->n_points() > 0)
        problem.groups.push_back(std::move(cones));
      if (cylinders->n_points() > 0)
        problem.groups.push_back(std::move(cylinders));

      BoundSolution solution = {geocone::solve(problem, options), {}};
      solution.load *= scale;
      solution.q *= scale;
      std::array<unsigned int, 2> place = {{0, 0}};
      for (const PointCone &cone : plane.cone)
        {
          const bool is_cylinder = cone.is_cylinder();
          solution.s.push_back(
            group_of[is_cylinder]->stress(place[is_cylinder]++));
          Eigen::Vector3d &s = solution.s.back();
          if (!is_cylinder)
            s[0] /= cone.a;
          else if (!cone.ellipse.is_circle())
            s.tail<2>() = cone.ellipse.stress(s.tail<2>(), cone.k);
        }
      return solution;
    }
  } // namespace

  BoundSolution
  solve(const BoundProblem &plane, const ConicOptions &options)
  {
    BoundSolution solution;
    plane.B.with_n_columns([&](const auto size) {
      solution = solve_with_columns<decltype(size)::value>(plane, options);
    });
    return solution;
  }
} // namespace geocone::GEOCONE_DIM
