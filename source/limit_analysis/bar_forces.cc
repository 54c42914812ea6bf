// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/bar_rows.h>

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

    /** Calls functions for the cells of structures of both bounds, in order. */
    template <typename OfEdge, typename OfVertex, typename OfTie>
    void
    for_bars(const BoundScene &bound,
             unsigned int      first_upper,
             unsigned int      first_lower,
             const OfEdge     &of_edge,
             const OfVertex   &of_vertex,
             const OfTie      &of_tie)
    {
      for (const BarChain &chain : bound.bars.chains)
        {
          const bool         bends = chain.structure->is_plate();
          const unsigned int begin = first_lower, size = bends ? 9 : 3;
          for (unsigned int i = 0; i < chain.edges.size(); ++i)
            {
              of_edge(chain, i, first_upper, first_lower);
              first_upper += 6;
              first_lower += size;
            }
          for (unsigned int i = 0; bends && i < chain.vertices.size(); ++i)
            {
              // The moment of the edge that begins or, at the last one, ends there.
              of_vertex(chain,
                        i,
                        first_upper,
                        i + 1 < chain.vertices.size() ? begin + size * i + 3
                                                      : first_lower - 3);
              first_upper += 3;
            }
        }
      for (const PlasticBars::Tie &tie : bound.bars.ties)
        {
          of_tie(tie, first_upper, first_lower);
          first_upper += 3;
          first_lower += 3;
        }
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
    // Volumes have the sizes of the rates, which are of order one.
    const auto power = [&](const unsigned int point, const unsigned int force) {
      return problem.volume[point] * lower.s[force].dot(e[point]);
    };
    for (const BarEdge &edge : bound.bars.edges)
      for (const int cell : edge.cells)
        if (cell >= 0)
          {
            const auto          &ends = triangles.edges[edge.edge].vertices;
            const Tensor<1, dim> N    = normal_into(triangles, cell, edge.edge);
            const double         length = triangles.vertices[ends[0]].distance(
                                    triangles.vertices[ends[1]]) /
                                  bound.units.length;
            for (unsigned int i = 0; i < 3; ++i, ++p)
              {
                gap[cell] += dissipated(p);
                for (unsigned int j = 0; j < 2; ++j)
                  gap[cell] -=
                    length * share_of_end[i][j] *
                    traction_at(bound, lower, cell, ends[j], N).dot(e[p]);
              }
          }
    for_bars(
      bound,
      p,
      first + 3 * n_interface_cells(bound, BoundSide::lower),
      [&](const BarChain    &chain,
          const unsigned int i,
          const unsigned int u,
          const unsigned int l) {
        const Step step(bound, chain, i);
        double    &own = gap[owner_of(bound, step)];
        own += dissipated(u) + dissipated(u + 1);
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int end = 0; end < 2; ++end)
            own -= 2. * share_of_end[j][end] * power(u + end, l + j);
        for (unsigned int end = 0; end < 2; ++end)
          own += dissipated(u + 3 + end) - power(u + 3 + end, l + 2 * end);
        if (!chain.structure->is_plate())
          return;
        own += dissipated(u + 2);
        for (unsigned int j = 0; j < 4; ++j)
          own -= power(u + 2, l + 3 + j) / 4.;
      },
      [&](const BarChain    &chain,
          const unsigned int i,
          const unsigned int u,
          const unsigned int l) {
        const Step step(
          bound, chain, std::min<unsigned int>(i, chain.edges.size() - 1));
        gap[owner_of(bound, step)] += dissipated(u) - power(u, l);
      },
      [&](const PlasticBars::Tie &tie,
          const unsigned int      u,
          const unsigned int      l) {
        gap[owner_of(bound, tie)] += dissipated(u) - power(u, l);
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

    /** Axial force and moment of an edge of a lower bound, from its first point of
     *  structures on. */
    ForcesOfEdge
    forces_of_edge(const BoundScene  &bound,
                   const BarChain    &chain,
                   const Bound       &lower,
                   const unsigned int first)
    {
      const Interval axial  = axial_interval(*chain.structure,
                                            bound.units,
                                            BoundSide::lower,
                                            chain.ends_are_held),
                     moment = moment_interval(
                       *chain.structure, bound.units, BoundSide::lower);
      ForcesOfEdge forces;
      for (unsigned int j = 0; j < 3 && !axial.is_zero; ++j)
        forces.normal[j] = axial.force(lower.s[first + j]);
      for (unsigned int j = 0; j < 4 && chain.structure->is_plate(); ++j)
        forces.moment[j] = moment.force(lower.s[first + 3 + j]);
      return forces;
    }

    /** Appends both ends and the middle of an edge. @param arc at its beginning (m)
     *  @param first point of the edge in the lower bound */
    void
    add_points_of_edge(const BoundScene      &bound,
                       const BarChain        &chain,
                       const unsigned int     i,
                       const double           arc,
                       const Bound           &upper,
                       const Bound           &lower,
                       const unsigned int     first,
                       std::vector<BarPoint> &all)
    {
      const Structure &structure = *chain.structure;
      const Step       step(bound, chain, i);
      const double     L           = bound.units.length * step.length,
                   force           = bound.units.stress * bound.units.length;
      const ForcesOfEdge    forces = forces_of_edge(bound, chain, lower, first);
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
    double             arc   = 0.;
    for_bars(
      bound,
      first + 3 * n_interface_cells(bound, BoundSide::upper),
      first + 3 * n_interface_cells(bound, BoundSide::lower),
      [&](const BarChain    &chain,
          const unsigned int i,
          const unsigned int,
          const unsigned int l) {
        arc = i == 0 ? 0. : arc;
        add_points_of_edge(bound, chain, i, arc, upper, lower, l, all);
        arc += bound.units.length * Step(bound, chain, i).length;
      },
      [](const BarChain &,
         const unsigned int,
         const unsigned int,
         const unsigned int) {},
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
