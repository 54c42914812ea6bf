// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/bar_rows.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Axial force and moment of an edge of a lower bound, coefficients in Bernstein's
     *  basis of degrees two and three, in scaled units. */
    struct ForcesOfEdge
    {
      std::array<double, 3> normal = {};
      std::array<double, 4> moment = {};
    };

    /** Whether the axial force and the moment of a chain have points in common. */
    bool
    is_joint(const BoundScene &bound,
             const BarChain   &chain,
             const BoundSide   side)
    {
      return !strength_parts(*chain.structure, bound.units, side).empty();
    }

    /** Points of a chain in both problems. */
    class PointsOfChain
    {
    public:
      PointsOfChain(const BoundScene  &bound,
                    const BarChain    &chain,
                    const unsigned int first_upper,
                    const unsigned int first_lower)
        : chain(chain)
        , joint_upper(is_joint(bound, chain, BoundSide::upper))
        , joint_lower(is_joint(bound, chain, BoundSide::lower))
        , first_upper(first_upper)
        , first_lower(first_lower)
      {
        constexpr unsigned int n_upper = n_strength_parts(BoundSide::upper);
        constexpr unsigned int n_lower = n_strength_parts(BoundSide::lower);
        const bool             bends   = chain.structure->is_plate();
        per_edge_upper                 = joint_upper ? 2 * n_upper : 6;
        per_vertex     = joint_upper ? 2 * n_upper : bends ? 3 : 0;
        per_edge_lower = joint_lower ? 4 * n_lower : bends ? 9 : 3;
      }

      /** First point of an edge in the upper bound: of both ends, and, without
       *  interaction, of the curvature and of both jumps. */
      unsigned int
      upper_of_edge(const unsigned int i) const
      {
        return first_upper + per_edge_upper * i;
      }

      /** First point of a vertex of a plate in the upper bound: of both edges beside it,
       *  or of the rotation. */
      unsigned int
      upper_of_vertex(const unsigned int i) const
      {
        return upper_of_edge(chain.edges.size()) + per_vertex * i;
      }

      /** First point of an edge in the lower bound. */
      unsigned int
      lower_of_edge(const unsigned int i) const
      {
        return first_lower + per_edge_lower * i;
      }

      unsigned int
      end_upper() const
      {
        return upper_of_vertex(chain.vertices.size());
      }
      unsigned int
      end_lower() const
      {
        return lower_of_edge(chain.edges.size());
      }

      const BarChain &chain;
      const bool      joint_upper, joint_lower;

    private:
      const unsigned int first_upper, first_lower;
      unsigned int       per_edge_upper, per_vertex, per_edge_lower;
    };

    /** Calls functions for the cells of structures of both bounds, in order. */
    template <typename OfChain, typename OfTie>
    void
    for_bars(const BoundScene &bound,
             unsigned int      first_upper,
             unsigned int      first_lower,
             const OfChain    &of_chain,
             const OfTie      &of_tie)
    {
      for (const BarChain &chain : bound.bars.chains)
        {
          const PointsOfChain points(bound, chain, first_upper, first_lower);
          of_chain(points);
          first_upper = points.end_upper();
          first_lower = points.end_lower();
        }
      for (const PlasticBars::Tie &tie : bound.bars.ties)
        {
          of_tie(tie, first_upper, first_lower);
          first_upper += 3;
          first_lower += 3;
        }
    }

    /** Axial force and moment of the edge i of a chain in the lower bound. */
    ForcesOfEdge
    forces_of_edge(const BoundScene    &bound,
                   const PointsOfChain &points,
                   const unsigned int   i,
                   const Bound         &lower)
    {
      const Structure   &structure = *points.chain.structure;
      const unsigned int first     = points.lower_of_edge(i);
      ForcesOfEdge       forces;
      if (points.joint_lower)
        {
          const auto parts =
            strength_parts(structure, bound.units, BoundSide::lower);
          std::array<double, 4> cubic = {};
          unsigned int          point = first;
          for (unsigned int j = 0; j < 4; ++j)
            for (const StrengthPart &part : parts)
              {
                const double s =
                  part.interval().force(lower.s[point++]) / part.size();
                cubic[j] += part.axial * s;
                forces.moment[j] += part.moment * s;
              }
          forces.normal = {
            {cubic[0],
             (3. * (cubic[1] + cubic[2]) - cubic[0] - cubic[3]) / 4.,
             cubic[3]}};
          return forces;
        }
      const Interval axial  = axial_interval(structure,
                                            bound.units,
                                            BoundSide::lower,
                                            points.chain.ends_are_held),
                     moment = moment_interval(
                       structure, bound.units, BoundSide::lower);
      for (unsigned int j = 0; j < 3 && !axial.is_zero; ++j)
        forces.normal[j] = axial.force(lower.s[first + j]);
      for (unsigned int j = 0; j < 4 && structure.is_plate(); ++j)
        forces.moment[j] = moment.force(lower.s[first + 3 + j]);
      return forces;
    }

    /** Number of cells of the interfaces of structures. */
    unsigned int
    n_interface_cells(const BoundScene &bound, const BoundSide side)
    {
      unsigned int n = 0;
      for (unsigned int k = 0; k < bound.bars.edges.size(); ++k)
        for (const int cell : bound.bars.edges[k].cells)
          n += cell >= 0 &&
               (side == BoundSide::upper || bound.bars.has_weak_interface(k));
      return n;
    }

    /** First point of structures, with their interfaces, in both problems. */
    unsigned int
    first_point_of_bars(const BoundScene &bound)
    {
      unsigned int n = bound.triangles.cells.size();
      for (const Interface &interface : bound.interfaces)
        n += interface.faces.size();
      return 3 * n;
    }

    /** Traction of a triangle at a vertex, normal and tangential to a side with the
     *  inward normal N, as of an interface. */
    Eigen::Vector3d
    traction_at(const BoundScene     &bound,
                const Bound          &lower,
                const unsigned int    cell,
                const unsigned int    vertex,
                const Tensor<1, dim> &N)
    {
      const Mandel         s = from_cone_axes(Mandel(
        lower.s[3 * cell + position_in(bound.triangles.cells[cell], vertex)]));
      const Tensor<1, dim> t({-(s[0] * N[0] + s[2] / sqrt2 * N[1]),
                              -(s[2] / sqrt2 * N[0] + s[1] * N[1])});
      return {t * N, t[1] * N[0] - t[0] * N[1], 0.};
    }

    /** Parts of the gap of plates and geogrids: dissipation of the upper bound less the
     *  power of the forces of the lower one with its rates. */
    class GapOfBars
    {
    public:
      GapOfBars(const BoundScene   &bound,
                const BoundProblem &problem,
                const Bound        &upper,
                const Bound        &lower)
        : bound(bound)
        , problem(problem)
        , q(upper.q)
        , e(problem.B.rates(upper.q))
        , lower(lower)
      {}

      void
      add_chain(const PointsOfChain &points, std::vector<double> &gap) const
      {
        const BarChain    &chain = points.chain;
        const unsigned int n     = chain.edges.size();
        for (unsigned int i = 0; i < n; ++i)
          {
            const Step step(bound, chain, i);
            gap[owner_of(bound, step)] += points.joint_lower
                                            ? of_joint_edge(points, step, i)
                                            : of_edge(points, i);
          }
        for (unsigned int i = 0;
             chain.structure->is_plate() && i < chain.vertices.size();
             ++i)
          {
            const Step step(bound, chain, std::min(i, n - 1));
            gap[owner_of(bound, step)] += points.joint_lower
                                            ? of_joint_vertex(points, i)
                                            : of_vertex(points, i);
          }
      }

    private:
      double
      dissipated(const unsigned int point) const
      {
        return problem.volume[point] *
               dissipation(problem.cone[point], e[point]);
      }

      double
      dissipated(const unsigned int first, const unsigned int end) const
      {
        double sum = 0.;
        for (unsigned int p = first; p < end; ++p)
          sum += dissipated(p);
        return sum;
      }

      // Volumes have the sizes of the rates, which are of order one.
      double
      power(const unsigned int point, const unsigned int force) const
      {
        return problem.volume[point] * lower.s[force].dot(e[point]);
      }

      double
      of_edge(const PointsOfChain &points, const unsigned int i) const
      {
        const unsigned int u = points.upper_of_edge(i),
                           l = points.lower_of_edge(i);
        double own           = dissipated(u) + dissipated(u + 1);
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int end = 0; end < 2; ++end)
            own -= 2. * share_of_end[j][end] * power(u + end, l + j);
        for (unsigned int end = 0; end < 2; ++end)
          own += dissipated(u + 3 + end) - power(u + 3 + end, l + 2 * end);
        if (!points.chain.structure->is_plate())
          return own;
        own += dissipated(u + 2);
        for (unsigned int j = 0; j < 4; ++j)
          own -= power(u + 2, l + 3 + j) / 4.;
        return own;
      }

      /** The moment is that of the edge that begins at the vertex or, at the last one,
       *  ends there. */
      double
      of_vertex(const PointsOfChain &points, const unsigned int i) const
      {
        const unsigned int u = points.upper_of_vertex(i);
        const unsigned int n = points.chain.edges.size();
        return dissipated(u) - power(u,
                                     i < n ? points.lower_of_edge(i) + 3
                                           : points.end_lower() - 3);
      }

      double
      of_joint_edge(const PointsOfChain &points,
                    const Step          &step,
                    const unsigned int   i) const
      {
        const double jumps = points.joint_upper
                               ? 0.
                               : power_of_jump(points, step, i, 0) +
                                   power_of_jump(points, step, i, 1);
        return dissipated(points.upper_of_edge(i),
                          points.upper_of_edge(i + 1)) -
               power_of_edge(points, step, i) - jumps;
      }

      double
      of_joint_vertex(const PointsOfChain &points, const unsigned int i) const
      {
        const BarChain    &chain  = points.chain;
        const unsigned int n      = chain.edges.size();
        const auto         moment = [&](const unsigned int edge) {
          return forces_of_edge(bound, points, edge, lower).moment;
        };
        double own =
          dissipated(points.upper_of_vertex(i), points.upper_of_vertex(i + 1)) -
          hinge_rate(bound, chain, i).of(q) *
            (i < n ? moment(i)[0] : moment(n - 1)[3]);
        const auto steps = steps_at(bound, chain, i);
        for (unsigned int side = 0; side < 2 && points.joint_upper; ++side)
          if (steps[side])
            own -= power_of_jump(
              points, *steps[side], (i + n - 1 + side) % n, 1 - side);
        return own;
      }

      /** Power of the axial force and the moment with the rates of an edge. */
      double
      power_of_edge(const PointsOfChain &points,
                    const Step          &step,
                    const unsigned int   i) const
      {
        const ForcesOfEdge forces = forces_of_edge(bound, points, i, lower);
        double             sum    = 0.;
        for (unsigned int end = 0; end < 2; ++end)
          {
            const double rate = axial_rate(bound, step, end).of(q);
            for (unsigned int j = 0; j < 3; ++j)
              sum += share_of_end[j][end] * forces.normal[j] * rate;
          }
        if (points.chain.structure->is_plate())
          for (const double moment : forces.moment)
            sum += moment / 4. * curvature_rate(bound, step).of(q);
        return step.length * sum;
      }

      /** Power of the axial force with the jump at an end of the edge i. */
      double
      power_of_jump(const PointsOfChain &points,
                    const Step          &step,
                    const unsigned int   i,
                    const unsigned int   end) const
      {
        return forces_of_edge(bound, points, i, lower).normal[2 * end] *
               jump_rate(bound, step, end).of(q);
      }

      const BoundScene                  &bound;
      const BoundProblem                &problem;
      const Eigen::VectorXd             &q;
      const std::vector<Eigen::Vector3d> e;
      const Bound                       &lower;
    };
  } // namespace

  void
  add_gap_of_bars(const BoundScene    &bound,
                  const BoundProblem  &problem,
                  const Bound         &upper,
                  const Bound         &lower,
                  std::vector<double> &gap)
  {
    if (bound.bars.empty())
      return;
    const Triangles   &triangles  = bound.triangles;
    const auto         e          = problem.B.rates(upper.q);
    const unsigned int first      = first_point_of_bars(bound);
    unsigned int       p          = first;
    const auto         dissipated = [&](const unsigned int point) {
      return problem.volume[point] * dissipation(problem.cone[point], e[point]);
    };
    for (const BarEdge &edge : bound.bars.edges)
      for (const int cell : edge.cells)
        if (cell >= 0)
          {
            const auto          &ends = triangles.edges[edge.edge].vertices;
            const Tensor<1, dim> N    = normal_into(triangles, cell, edge.edge);
            const double         length =
              triangles.edge_length(edge.edge) / bound.units.length;
            for (unsigned int i = 0; i < 3; ++i, ++p)
              {
                gap[cell] += dissipated(p);
                for (unsigned int j = 0; j < 2; ++j)
                  gap[cell] -=
                    length * share_of_end[i][j] *
                    traction_at(bound, lower, cell, ends[j], N).dot(e[p]);
              }
          }
    const GapOfBars of_bars(bound, problem, upper, lower);
    for_bars(
      bound,
      p,
      first + 3 * n_interface_cells(bound, BoundSide::lower),
      [&](const PointsOfChain &points) { of_bars.add_chain(points, gap); },
      [&](const PlasticBars::Tie &tie,
          const unsigned int      u,
          const unsigned int      l) {
        // The volume has the size of the rate, which is of order one.
        gap[owner_of(bound, tie)] +=
          dissipated(u) - problem.volume[u] * lower.s[l].dot(e[u]);
      });
  }

  namespace
  {
    /** Value at 0 <= s <= 1 of a polynomial in Bernstein's basis. */
    template <std::size_t n>
    double
    value_of(std::array<double, n> coefficients, const double s)
    {
      for (unsigned int order = n - 1; order > 0; --order)
        for (unsigned int i = 0; i < order; ++i)
          coefficients[i] += s * (coefficients[i + 1] - coefficients[i]);
      return coefficients[0];
    }
    unsigned int
    dof_of_vertex(const BoundScene &bound, const unsigned int vertex)
    {
      return dof_of_node(
        bound, bound.bars.node_of_vertex(bound.bars.number_of_vertex(vertex)));
    }

    /** Appends both ends and the middle of an edge. @param arc at its beginning
     *  (m) */
    void
    add_points_of_edge(const BoundScene      &bound,
                       const PointsOfChain   &points,
                       const unsigned int     i,
                       const double           arc,
                       const Bound           &upper,
                       const Bound           &lower,
                       std::vector<BarPoint> &all)
    {
      const BarChain  &chain     = points.chain;
      const Structure &structure = *chain.structure;
      const Step       step(bound, chain, i);
      const double     L             = bound.units.length * step.length,
                   force             = bound.units.stress * bound.units.length;
      const ForcesOfEdge    forces   = forces_of_edge(bound, points, i, lower);
      const double          rates[2] = {axial_rate(bound, step, 0).of(upper.q),
                                        axial_rate(bound, step, 1).of(upper.q)};
      std::array<double, 3> shear;
      for (unsigned int j = 0; j < 3; ++j)
        shear[j] = 3. / step.length * (forces.moment[j + 1] - forces.moment[j]);
      const std::array<unsigned int, 3> dofs = {
        {dof_of_vertex(bound, step.vertices[0]),
         dof_of_node(bound, bound.bars.node_of_edge(step.number)),
         dof_of_vertex(bound, step.vertices[1])}};
      for (unsigned int k = 0; k < 3; ++k)
        {
          const double s = k / 2.;
          BarPoint     point;
          point.structure = &structure;
          point.arc       = arc + s * L;
          point.x = bound.triangles.vertices[step.vertices[0]] + s * L * step.t;
          point.normal = force * value_of(forces.normal, s);
          point.moment =
            force * bound.units.length * value_of(forces.moment, s);
          point.shear = force * value_of(shear, s);
          for (unsigned int d = 0; d < dim; ++d)
            point.velocity[d] =
              value_of(std::array<double, 3>{{upper.q[dofs[0] + d],
                                              upper.q[dofs[1] + d],
                                              upper.q[dofs[2] + d]}},
                       s);
          point.rate = (1. - s) * rates[0] + s * rates[1];
          if (k != 1)
            point.jump = jump_rate(bound, step, k / 2).of(upper.q);
          if (structure.is_plate() && k != 1)
            point.hinge = hinge_rate(bound, chain, i + k / 2).of(upper.q);
          all.push_back(point);
        }
    }
  } // namespace

  std::vector<BarPoint>
  points_of_bars(const BoundScene &bound,
                 const Bound      &upper,
                 const Bound      &lower)
  {
    std::vector<BarPoint> all;
    if (bound.bars.empty())
      return all;
    const unsigned int first = first_point_of_bars(bound);
    for_bars(
      bound,
      first + 3 * n_interface_cells(bound, BoundSide::upper),
      first + 3 * n_interface_cells(bound, BoundSide::lower),
      [&](const PointsOfChain &points) {
        double arc = 0.;
        for (unsigned int i = 0; i < points.chain.edges.size(); ++i)
          {
            add_points_of_edge(bound, points, i, arc, upper, lower, all);
            arc += bound.units.length * Step(bound, points.chain, i).length;
          }
      },
      [&](
        const PlasticBars::Tie &tie, const unsigned int, const unsigned int l) {
        const Interval axial =
          axial_interval(*tie.structure, bound.units, BoundSide::lower);
        for (unsigned int end = 0; end < 2; ++end)
          {
            BarPoint point;
            point.structure = tie.structure;
            point.x         = tie.structure->points[end];
            point.arc       = end * tie.structure->points[0].distance(point.x);
            point.normal    = axial.is_zero
                                ? 0.
                                : bound.units.stress * bound.units.length *
                                 axial.force(lower.s[l]);
            for (unsigned int d = 0; tie.vertices[end] >= 0 && d < dim; ++d)
              point.velocity[d] =
                upper.q[dof_of_vertex(bound, tie.vertices[end]) + d];
            point.rate = upper_rate_of_tie(bound, tie).of(upper.q);
            all.push_back(point);
          }
      });
    return all;
  }
} // namespace geocone::GEOCONE_DIM
