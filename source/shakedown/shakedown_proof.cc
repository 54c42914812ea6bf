// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/shakedown/shakedown_proof.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using Eigen::Vector3d;

  namespace
  {
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

    /** Upper bound by dissipation and work, which is known up to an error. */
    double
    bound_with_error(const double power, const double work, const double error)
    {
      if (power < 0.)
        return power / (work + error);
      return error < work ? power / (work - error)
                          : std::numeric_limits<double>::infinity();
    }
  } // namespace

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
        const LinearField missed = difference(one.compatible, one.equilibrated);
        LinearField       strains(rates[0].size(), Vector3d::Zero());
        for (unsigned int k = 1; k < rates.size(); ++k)
          if (const double factor = loads.states()[k][i] - loads.states()[0][i];
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
        add(missed, factor / 2., difference(one.compatible, one.equilibrated));
      }
    const double error = std::sqrt(solver.product_of_stresses(missed, missed));
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
        best = std::min(
          best,
          bound_with_error(sum.power, sum.work, error * std::sqrt(sum.square)));
      }
    return best;
  }

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
} // namespace geocone::GEOCONE_DIM
