// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/plane_bounds/bar_cells.h>
#include <geocone/plane_bounds/certificate.h>
#include <geocone/plane_bounds/point_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    /** Tolerated rounding error of equilibrium and incompressibility, and of the
     *  strength where stresses cannot be scaled for lack of cohesion, e.g. at the apex
     *  at a free surface. */
    constexpr double rounding = 1e-8;

    /** Residual of equilibrium, relative to the largest stress, above which it is
     *  reduced even if it is tolerated: checkers accept rounding errors only. */
    constexpr double improvable = 1e-12;

    double
    excess(const PointCone &cone, const Vector3d &s)
    {
      if (!cone.ellipse.is_circle())
        return cone.ellipse.on_disc(s.tail<2>(), cone.k).norm() - cone.k;
      return s.tail<2>().norm() - cone.a * s[0] - cone.k;
    }

    /** The violation of -e in K*, which a cut-off does not change but for a cylinder; of
     *  incompressible soil nothing here. */
    double
    violation(const PointCone &cone, const Vector3d &e)
    {
      return cone.is_incompressible() ? 0. : cone.a * e.tail<2>().norm() + e[0];
    }

    Tensor<1, dim>
    traction(const Vector3d &s, const Tensor<1, dim> &n)
    {
      const Mandel x = from_cone_axes(Mandel(s));
      return Tensor<1, dim>(
        {x[0] * n[0] + x[2] / sqrt2 * n[1], x[2] / sqrt2 * n[0] + x[1] * n[1]});
    }

    /** Tractions of the cells at the ends of the edges. */
    struct TractionsAtEnds
    {
      /** Sums of both sides, at each end of each edge. */
      std::vector<Tensor<1, dim>> sum;

      /** Tractions on weak interfaces of structures. */
      struct OfSide
      {
        unsigned int   edge, dof; ///< x dof of the soil
        Tensor<1, dim> traction;
      };
      std::vector<OfSide> of_sides;
    };

    TractionsAtEnds
    tractions_at_ends(const BoundScene &bound, const std::vector<Vector3d> &s)
    {
      const Triangles &triangles = bound.triangles;
      TractionsAtEnds  at_ends;
      at_ends.sum.resize(2 * triangles.edges.size());
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        {
          const auto g = triangles.gradients(c);
          for (unsigned int e = 0; e < 3; ++e)
            for (const unsigned int i : {(e + 1) % 3, (e + 2) % 3})
              {
                const unsigned int edge = triangles.edges_of_cell[c][e];
                const unsigned int end =
                  triangles.edges[edge].vertices[0] == triangles.cells[c][i]
                    ? 0
                    : 1;
                const Tensor<1, dim> t =
                  traction(s[3 * c + i], -1. * g[e] / g[e].norm());
                if (const int bar = bound.bars.number_of_edge(edge);
                    bar >= 0 && bound.bars.has_weak_interface(bar))
                  at_ends.of_sides.push_back(
                    {edge,
                     dof_at_end_of_cell(bound, c, edge, triangles.cells[c][i]),
                     t});
                else
                  at_ends.sum[2 * edge + end] += t;
              }
        }
      return at_ends;
    }

    /** Forces of the body on the obstacles, in all dofs. */
    VectorXd
    interface_forces(const BoundProblem          &problem,
                     const std::vector<Vector3d> &s)
    {
      return problem.B.forces(
        problem.volume,
        {s.begin(), s.begin() + problem.first_cut_point()},
        problem.n_dofs(),
        3 * problem.n_triangles);
    }

    /** Equilibrium of linear stresses with the loads of a lower problem. */
    struct Statics
    {
      double power = 0.; ///< of the reactions to prescribed velocities
      double error = 0.; ///< of equilibrium, relative to the largest stress
    };

    /**
     * Evaluates equilibrium from the fields alone: |div s + body force| times the
     * cell's size, jumps of tractions at both ends of all edges, including boundary
     * values, and the tractions where velocities are prescribed.
     */
    Statics
    statics(const BoundScene            &bound,
            const BoundProblem          &problem,
            const std::vector<Vector3d> &s,
            const double                 lambda)
    {
      const Triangles   &triangles = bound.triangles;
      const unsigned int n_cells   = triangles.cells.size();
      const double       L         = bound.units.length;
      const VectorXd     F         = problem.dead + lambda * problem.live;
      Statics            result;
      double             largest = std::numeric_limits<double>::min();
      for (const Vector3d &one : s)
        largest = std::max(largest, one.norm());
      for (unsigned int c = 0; c < n_cells; ++c)
        {
          const auto     g = triangles.gradients(c);
          Tensor<1, dim> divergence;
          for (unsigned int i = 0; i < 3; ++i)
            divergence += traction(s[3 * c + i], g[i]);
          for (unsigned int d = 0; d < dim; ++d)
            result.error =
              std::max(result.error,
                       std::abs(L * divergence[d] +
                                F[dim * c + d] / (3. * problem.volume[3 * c])) *
                         std::sqrt(triangles.area(c)) / L);
        }
      const auto     tractions     = tractions_at_ends(bound, s);
      const VectorXd at_interfaces = interface_forces(problem, s);
      const auto     half_length   = [&](const unsigned int e) {
        return triangles.edge_length(e) / (2. * L);
      };
      std::vector<bool> is_of_side(problem.n_dofs(), false);
      for (const auto &side : tractions.of_sides)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int dof  = side.dof + d;
            const double       half = half_length(side.edge);
            is_of_side[dof]         = true;
            result.error =
              std::max(result.error,
                       std::abs(side.traction[d] + at_interfaces[dof] / half));
          }
      for (unsigned int e = 0; e < triangles.edges.size(); ++e)
        {
          const double half = half_length(e);
          for (unsigned int end = 0; end < 2; ++end)
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int dof = dim * (n_cells + 2 * e + end) + d;
                const double       t         = tractions.sum[2 * e + end][d];
                const double left      = t * half + at_interfaces[dof] - F[dof];
                if (problem.is_prescribed[dof] && !problem.has_no_force[dof])
                  result.power += left * problem.prescribed[dof];
                else
                  result.error = std::max(result.error, std::abs(left) / half);
              }
        }
      for (unsigned int dof = dim * (n_cells + 2 * triangles.edges.size());
           dof < problem.first_cut_dof;
           ++dof)
        if (problem.is_prescribed[dof])
          result.power += at_interfaces[dof] * problem.prescribed[dof];
        else if (!is_of_side[dof])
          result.error =
            std::max(result.error, std::abs(at_interfaces[dof] - F[dof]));
      result.error /= largest;
      return result;
    }

    /** Makes cylinders incompressible: projects onto e_n = 0 in the metric of B'B, by
     *  the method of multipliers. A vertex whose edges lie nearly on two lines leaves some
     *  rates that hardly depend on their multipliers (Scott and Vogelius 1985), as bisected
     *  meshes have: the multipliers are found by conjugate gradients, which needs one
     *  iteration for each such vertex. */
    bool
    make_incompressible(const BoundProblem &problem, VectorXd &q)
    {
      constexpr double          penalty = 1e8, enough = 1e-13;
      constexpr unsigned int    most = 60;
      const unsigned int        n    = problem.n_points();
      PointMatrix               matrix(problem.is_prescribed, problem.B);
      PointMatrix::Blocks       blocks(n);
      std::vector<unsigned int> held;
      for (unsigned int p = 0; p < n; ++p)
        {
          blocks[p] = problem.volume[p] * Eigen::Matrix3d::Identity();
          if (problem.cone[p].is_incompressible())
            {
              blocks[p](0, 0) += problem.volume[p] * penalty;
              held.push_back(p);
            }
        }
      if (!matrix.factorise(blocks))
        return false;
      // Response to normal stresses at the points that are held.
      const auto response = [&](const VectorXd &normal) {
        std::vector<Vector3d> s(n, Vector3d::Zero());
        for (unsigned int i = 0; i < held.size(); ++i)
          s[held[i]][0] = normal[i];
        return matrix.solve(
          problem.B.forces(problem.volume, s, problem.n_dofs()));
      };
      double     largest      = 0.;
      const auto normal_rates = [&](const VectorXd &of) {
        const auto e = problem.B.rates(of);
        VectorXd   normal(held.size());
        for (unsigned int i = 0; i < held.size(); ++i)
          normal[i] = e[held[i]][0];
        largest = 1e-6 * of.lpNorm<Eigen::Infinity>();
        for (const Vector3d &one : e)
          largest = std::max(largest, one.norm());
        return normal;
      };
      VectorXd weight(held.size());
      for (unsigned int i = 0; i < held.size(); ++i)
        weight[i] = problem.volume[held[i]];
      const auto product = [&](const VectorXd &one, const VectorXd &other) {
        return weight.dot(one.cwiseProduct(other));
      };
      q -= response(penalty * normal_rates(q));
      VectorXd rates = normal_rates(q), direction = VectorXd::Zero(held.size());
      double   before = 0.;
      for (unsigned int i = 0;
           i < most && rates.lpNorm<Eigen::Infinity>() > enough * largest;
           ++i)
        {
          const double square = product(rates, rates);
          direction = rates + (before > 0. ? square / before : 0.) * direction;
          before    = square;
          const VectorXd change = response(direction);
          const double   slope  = product(direction, normal_rates(change));
          if (!(slope > 0.))
            break;
          q -= square / slope * change;
          rates = normal_rates(q);
        }
      return true;
    }

    /** Uniaxial extension in the dofs of the upper problem: the component along an axis
     *  is sign max(0, sign x - b), b the last place along the direction that must stay
     *  incompressible, or else the body's first one. @param sign 1 or -1 */
    VectorXd
    uniaxial_extension(const BoundScene   &bound,
                       const BoundProblem &problem,
                       const unsigned int  axis,
                       const double        sign)
    {
      const Triangles   &triangles  = bound.triangles;
      const unsigned int n_vertices = triangles.vertices.size();
      double             first      = std::numeric_limits<double>::max();
      double             last       = std::numeric_limits<double>::lowest();
      for (unsigned int c = 0; c < triangles.cells.size(); ++c)
        for (const unsigned int v : triangles.cells[c])
          {
            const double x = sign * triangles.vertices[v][axis];
            first          = std::min(first, x);
            if (problem.cone[3 * c].is_incompressible())
              last = std::max(last, x);
          }
      const double begin = std::max(first, last);
      VectorXd     w     = VectorXd::Zero(problem.n_dofs());
      for (unsigned int v = 0; v < n_vertices; ++v)
        w[dim * v + axis] =
          sign * std::max(0., sign * triangles.vertices[v][axis] - begin) /
          bound.units.length;
      for (unsigned int e = 0; e < triangles.edges.size(); ++e)
        {
          const auto &ends = triangles.edges[e].vertices;
          w[dim * (n_vertices + e) + axis] =
            (w[dim * ends[0] + axis] + w[dim * ends[1] + axis]) / 2.;
        }
      return w;
    }
  } // namespace

  double
  dissipation(const PointCone &cone, const Vector3d &rate)
  {
    if (cone.is_cut())
      {
        const double shear = std::max(0., rate.tail<2>().norm() + rate[0]);
        return -cone.cut_off * rate[0] +
               (cone.k - cone.a * cone.cut_off) * shear / (1. - cone.a);
      }
    if (!cone.ellipse.is_circle())
      return cone.k * cone.ellipse.dissipation(rate.tail<2>());
    return cone.is_cylinder() ? cone.k * rate.tail<2>().norm()
                              : -cone.k / cone.a * rate[0];
  }

  namespace
  {
    /** Removes the residuals of equilibrium in the metric of B'B, which is conditioned as
     *  an elastic stiffness; that of the cones, in which the solver does it, becomes
     *  singular at the optimum. It may exceed the strength by as much as the stresses
     *  missed equilibrium. */
    BoundSolution
    in_equilibrium(const BoundProblem &problem, BoundSolution solution)
    {
      PointMatrix         matrix(problem.is_prescribed, problem.B);
      PointMatrix::Blocks blocks(problem.n_points());
      for (unsigned int p = 0; p < problem.n_points(); ++p)
        blocks[p] = problem.volume[p] * Eigen::Matrix3d::Identity();
      if (!matrix.factorise(blocks))
        return solution;
      for (unsigned int i = 0; i < 3; ++i)
        {
          VectorXd r =
            problem.dead + solution.load * problem.live -
            problem.B.forces(problem.volume, solution.s, problem.n_dofs());
          for (unsigned int dof = 0; dof < problem.n_dofs(); ++dof)
            if (problem.is_prescribed[dof])
              r[dof] = 0.;
          const auto e = problem.B.rates(matrix.solve(r));
          for (unsigned int p = 0; p < problem.n_points(); ++p)
            solution.s[p] += e[p];
        }
      return solution;
    }

    /** Certifies stresses as they are, or scaled. */
    Bound
    checked(const BoundScene    &bound,
            const BoundProblem  &problem,
            const BoundSolution &solution)
    {
      Bound  result;
      double largest = std::numeric_limits<double>::min(), theta = 1.;
      bool   finite = true; // comparisons with what is no number are false
      result.s = solution.s;
      result.q = solution.q;
      for (unsigned int p = 0; p < problem.n_points(); ++p)
        {
          const PointCone &cone = problem.cone[p];
          if (p >= problem.first_cut_point())
            result.s[p] = result.s[problem.point_of_triangle(p)];
          else if (problem.B.is_removed(p))
            result.s[p].setZero(); // it has no part in anything
          if (!result.s[p].allFinite())
            {
              finite = false;
              result.s[p].setZero();
            }
          largest = std::max(largest, result.s[p].norm());
          if (const double f = excess(cone, result.s[p]); f > 0.)
            {
              result.violation = std::max(result.violation, f);
              const double k   = cone.k * cone.ellipse.reserve();
              theta            = std::min(theta, k / (k + f));
            }
        }
      result.violation /= largest;
      // Scaling does not apply to cones with apex at zero.
      const bool is_scaled = problem.dead.squaredNorm() == 0. && theta > 0.;
      if (!is_scaled)
        theta = 1.;
      const Statics found = statics(bound, problem, result.s, solution.load);
      result.error        = found.error;
      result.load =
        theta * (problem.has_factor() ? solution.load : found.power);
      for (Vector3d &one : result.s)
        one *= theta;
      if (!finite || !std::isfinite(result.load + result.error))
        result.rejection = "it is not a number";
      else if (!(result.error < rounding))
        result.rejection =
          format("its stresses miss equilibrium by %.1e of the largest one",
                 result.error);
      else if (!is_scaled && result.violation > rounding_strength)
        result.rejection =
          format("its stresses exceed the strength by %.1e of the largest one, "
                 "and a dead "
                 "load or soil without cohesion leaves nothing to scale",
                 result.violation);
      else
        result.certified = true;
      return result;
    }
  } // namespace

  Bound
  certify_lower(const BoundScene    &bound,
                const BoundProblem  &problem,
                const BoundSolution &solution)
  {
    const Bound result = checked(bound, problem, solution);
    if (result.error < improvable || !std::isfinite(result.load + result.error))
      return result;
    const Bound second =
      checked(bound, problem, in_equilibrium(problem, solution));
    return second.certified && second.error < result.error ? second : result;
  }

  namespace
  {
    /** The largest violation of all points. */
    double
    largest_violation(const BoundProblem &problem, const VectorXd &q)
    {
      const auto rates   = problem.B.rates(q);
      double     largest = 0.;
      for (unsigned int p = 0; p < problem.n_points(); ++p)
        largest = std::max(largest, violation(problem.cone[p], rates[p]));
      return largest;
    }

    /** Ratio of a field to the prescribed velocities that are not zero, or nothing if
     *  the field contradicts prescribed velocities. */
    std::optional<double>
    ratio_to_prescribed(const BoundProblem &problem, const VectorXd &w)
    {
      std::optional<double> ratio;
      for (unsigned int i = 0; i < problem.n_dofs(); ++i)
        if (problem.is_prescribed[i])
          {
            const double v = problem.prescribed[i];
            if (v == 0. ? !(std::abs(w[i]) < 1e-12)
                        : ratio && std::abs(w[i] / v - *ratio) >
                                     1e-9 * std::abs(*ratio))
              return std::nullopt;
            if (v != 0.)
              ratio = w[i] / v;
          }
      return ratio.value_or(0.);
    }

    /** Removes the violation by a uniaxial extension along one of the axes, if
     *  prescribed velocities and incompressible parts allow one.
     *  @return scale factor of the prescribed velocities */
    double
    repair_rates(const BoundScene   &bound,
                 const BoundProblem &problem,
                 const double        violation,
                 VectorXd           &q)
    {
      // Its strain is uniaxial: -w_n = |w_t| = 1/sqrt2.
      double a = 0.;
      for (unsigned int p = 0; p < 3 * problem.n_triangles; ++p)
        a = std::max(a, problem.cone[p].a);
      const double delta = 1.001 * violation * sqrt2 / (1. - a);
      for (const unsigned int axis : {1, 0})
        for (const double sign : {1., -1.})
          {
            const VectorXd w = uniaxial_extension(bound, problem, axis, sign);
            const auto     ratio = ratio_to_prescribed(problem, w);
            if (!ratio)
              continue;
            VectorXd repaired = q + delta * w;
            if (largest_violation(problem, repaired) > 0.)
              continue;
            q = std::move(repaired);
            return 1. + delta * *ratio;
          }
      return 1.;
    }
  } // namespace

  Bound
  certify_upper(const BoundScene    &bound,
                const BoundProblem  &problem,
                const BoundSolution &solution)
  {
    Bound result;
    result.q = solution.q;
    if (!solution.q.allFinite())
      {
        result.rejection = "it is not a number";
        return result;
      }
    if (problem.has_incompressible() && !make_incompressible(problem, result.q))
      result.rejection = "incompressible velocities were not found";
    // Cut-offs dissipate by the whole rates, dissipation().
    result.q.tail(problem.n_dofs() - problem.first_cut_dof).setZero();

    // Bodies may move rigidly: their rates are rounding errors.
    double     largest = 1e-6 * result.q.lpNorm<Eigen::Infinity>();
    const auto rates   = problem.B.rates(result.q);
    for (unsigned int p = 0; p < problem.n_points(); ++p)
      {
        largest = std::max(largest, rates[p].norm());
        if (problem.cone[p].is_incompressible())
          result.error = std::max(result.error, std::abs(rates[p][0]));
        result.violation =
          std::max(result.violation, violation(problem.cone[p], rates[p]));
      }

    double scale = 1.; // of the prescribed velocities
    if (result.violation > 0. && result.rejection.empty())
      scale = repair_rates(bound, problem, result.violation, result.q);
    const auto repaired = problem.B.rates(result.q);
    double     power    = -problem.dead.dot(result.q);
    for (unsigned int p = 0; p < problem.n_points(); ++p)
      power += problem.volume[p] * dissipation(problem.cone[p], repaired[p]);
    const double left = largest_violation(problem, result.q);
    result.violation /= largest;
    result.error /= largest;
    const double work =
      problem.has_factor() ? problem.live.dot(result.q) : scale;
    result.load = power / work;
    if (!result.rejection.empty())
      return result;
    if (!std::isfinite(result.load) ||
        !(work > least_work * result.q.lpNorm<Eigen::Infinity>()))
      result.rejection = "its velocities do no work";
    else if (!(result.error < rounding))
      result.rejection =
        format("its normal rates are %.1e of the largest one where phi = 0",
               result.error);
    else if (left > 0.)
      result.rejection =
        format("its strain rates miss the cone by %.1e of the largest one, and "
               "no field that obeys the boundary conditions is known to repair "
               "them",
               left / largest);
    else
      result.certified = true;
    return result;
  }

  std::vector<double>
  gap_of_cells(const BoundProblem &problem,
               const Bound        &upper,
               const Bound        &lower)
  {
    const auto          e = problem.B.rates(upper.q);
    std::vector<double> gap(problem.n_triangles, 0.);
    for (unsigned int c = 0; c < problem.n_triangles; ++c)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int p = 3 * c + i;
          gap[c] += problem.volume[p] * dissipation(problem.cone[p], e[p]);
          for (unsigned int j = 0; j < 3; ++j)
            gap[c] -= problem.volume[p] / 4. * (i == j ? 2. : 1.) *
                      lower.s[p].dot(e[3 * c + j]);
        }
    // Integrals of Bernstein's functions with those of linear reactions.
    constexpr double share[3][2] = {
      {1. / 4., 1. / 12.}, {1. / 6., 1. / 6.}, {1. / 12., 1. / 4.}};
    for (unsigned int c = problem.n_triangles;
         3 * c < problem.first_bar_point();
         ++c)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int p = 3 * c + i;
          double &of_own       = gap[problem.owner[c - problem.n_triangles]];
          of_own += problem.volume[p] * dissipation(problem.cone[p], e[p]);
          for (unsigned int j = 0; j < 2; ++j)
            of_own -= 3. * problem.volume[p] * share[i][j] *
                      lower.s[3 * c + j].dot(e[p]);
        }
    return gap;
  }
} // namespace geocone::GEOCONE_DIM
