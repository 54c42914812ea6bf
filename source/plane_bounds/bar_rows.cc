// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/bar_problem.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
    /** Axial and moment strengths in scaled units from which on a structure counts as
     *  unlimited (BoundedLoad::choose_units()). Valid for both bounds: rates that are zero
     *  instead of small do not lower the upper one, and smaller strengths do not raise the
     *  lower one. With free axial forces its equilibrium would be ill-conditioned. */
    constexpr double unlimited_force = 100., unlimited_moment = 400.;
  } // namespace

  Interval
  axial_interval(const Structure  &structure,
                 const BoundUnits &units,
                 const BoundSide   side,
                 const bool        ends_are_held)
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double     unit     = units.stress * units.length;
    auto [least, most]        = structure.axial_strength();
    least /= unit;
    most /= unit;
    const bool below = -least < unlimited_force, above = most < unlimited_force;
    if (side == BoundSide::upper)
      return {below ? least : -infinite, above ? most : infinite};
    if (below != above && !ends_are_held)
      return {least, most};
    return {below ? least : std::min(-unlimited_force, most - 1.),
            above ? most : std::max(unlimited_force, least + 1.)};
  }

  Interval
  moment_interval(const Structure  &structure,
                  const BoundUnits &units,
                  const BoundSide   side)
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    double           most     = structure.moment_capacity() /
                  (units.stress * units.length * units.length);
    if (most < infinite && most > unlimited_moment)
      most = side == BoundSide::upper ? infinite : unlimited_moment;
    return {-most, most};
  }

  std::vector<StrengthPart>
  strength_parts(const Structure  &structure,
                 const BoundUnits &units,
                 const BoundSide   side)
  {
    if (!structure.interacts())
      return {};
    const double unit     = units.stress * units.length;
    double       Np       = structure.axial_strength()[1] / unit,
           Mp             = structure.moment_capacity() / (unit * units.length);
    const unsigned int  n = n_strength_parts(side);
    std::vector<double> x; // N/Np and M/Mp of the corners
    std::vector<double> y;
    if (side == BoundSide::lower)
      for (unsigned int i = 0; i <= n; ++i)
        {
          x.push_back(-1. + 2. * i / n);
          y.push_back(1. - x[i] * x[i]);
        }
    else // of tangents, the first and last one at the ends
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double before = -1. + 2. * (std::max(i, 1u) - 1.) / (n - 1.),
                       after  = -1. + 2. * std::min(i, n - 1) / (n - 1.);
          x.push_back((before + after) / 2.);
          y.push_back(1. - before * after);
        }
    if (side == BoundSide::lower)
      {
        Np = std::min(Np, unlimited_force);
        Mp = std::min(Mp, unlimited_moment);
      }
    else if (Np >= unlimited_force || Mp > unlimited_moment)
      return {};
    std::vector<StrengthPart> parts;
    for (unsigned int i = 0; i < n; ++i)
      parts.push_back(
        {Np * (x[i + 1] - x[i]) / 2., Mp * (y[i + 1] - y[i]) / 2.});
    return parts;
  }

  Step::Step(const BoundScene  &bound,
             const BarChain    &chain,
             const unsigned int i)
  {
    const Triangles &triangles = bound.triangles;
    number                     = bound.bars.number_of_edge(chain.edges[i]);
    vertices                   = {{chain.vertices[i], chain.vertices[i + 1]}};
    const bool forward =
      triangles.edges[chain.edges[i]].vertices[0] == vertices[0];
    ends   = {{forward ? 0u : 1u, forward ? 1u : 0u}};
    t      = triangles.vertices[vertices[1]] - triangles.vertices[vertices[0]];
    length = t.norm() / bound.units.length;
    if (!chain.structure->is_plate()) // straight, whatever rounds its vertices
      t = chain.structure->points[1] - chain.structure->points[0];
    t /= t.norm();
    n = Tensor<1, dim>({-t[1], t[0]});
  }

  unsigned int
  owner_of(const BoundScene &bound, const Step &step)
  {
    return bound.bars.edges[step.number].cells[0];
  }

  unsigned int
  position_in(const std::array<unsigned int, 3> &of_cell,
              const unsigned int                 one)
  {
    return std::find(of_cell.begin(), of_cell.end(), one) - of_cell.begin();
  }

  Tensor<1, dim>
  normal_into(const Triangles   &triangles,
              const unsigned int cell,
              const unsigned int edge)
  {
    const Tensor<1, dim> g = triangles.gradients(
      cell)[position_in(triangles.edges_of_cell[cell], edge)];
    return g / g.norm();
  }

  std::optional<unsigned int>
  dof_of_jump(const BoundScene  &bound,
              const unsigned int number,
              const unsigned int end)
  {
    const int jump = bound.bars.edges[number].jumps[end];
    if (jump < 0)
      return std::nullopt;
    return first_dof_of_bars(bound, BoundSide::upper) +
           dim * bound.bars.n_more_nodes() + jump;
  }

  Tensor<1, dim>
  along_mesh(const Triangles &triangles, const unsigned int edge)
  {
    const auto          &ends = triangles.edges[edge].vertices;
    const Tensor<1, dim> t =
      triangles.vertices[ends[1]] - triangles.vertices[ends[0]];
    return t / t.norm();
  }

  namespace
  {
    /** Adds the rotation rate of an end of an edge, times a factor. */
    void
    add_slope(const BoundScene  &bound,
              const Step        &step,
              const unsigned int end,
              const double       factor,
              Functional        &rate)
    {
      const PlasticBars &bars = bound.bars;
      const unsigned int middle =
                           dof_of_node(bound, bars.node_of_edge(step.number)),
                         vertex = dof_of_node(
                           bound,
                           bars.node_of_vertex(
                             bars.number_of_vertex(step.vertices[end])));
      const double sign = end == 0 ? 1. : -1.;
      rate.add(middle, sign * factor * 2. / step.length * step.n);
      rate.add(vertex, -sign * factor * 2. / step.length * step.n);
    }

    /** 1 if an edge is in the direction of the edge of the mesh, else -1. */
    double
    direction_of(const Step &step)
    {
      return step.ends[0] == 0 ? 1. : -1.;
    }
  } // namespace

  Functional
  curvature_rate(const BoundScene &bound, const Step &step)
  {
    Functional rate;
    add_slope(bound, step, 1, 1. / step.length, rate);
    add_slope(bound, step, 0, -1. / step.length, rate);
    return rate;
  }

  std::array<std::optional<Step>, 2>
  steps_at(const BoundScene &bound, const BarChain &chain, const unsigned int i)
  {
    const unsigned int                 n = chain.edges.size();
    std::array<std::optional<Step>, 2> steps;
    if (chain.is_closed() && i == n)
      return steps;
    if (i > 0 || chain.is_closed())
      steps[0] = Step(bound, chain, (i + n - 1) % n);
    if (i < n)
      steps[1] = Step(bound, chain, i);
    return steps;
  }

  Functional
  axial_rate(const BoundScene &bound, const Step &step, const unsigned int end)
  {
    const PlasticBars &bars = bound.bars;
    const double       sign = end == 0 ? 1. : -1.;
    Functional         rate;
    rate.add(dof_of_node(bound, bars.node_of_edge(step.number)),
             sign * 2. / step.length * step.t);
    rate.add(
      dof_of_node(
        bound, bars.node_of_vertex(bars.number_of_vertex(step.vertices[end]))),
      -sign * 2. / step.length * step.t);
    if (const auto jump = dof_of_jump(bound, step.number, step.ends[end]))
      rate.add(*jump, -sign * 2. / step.length * direction_of(step));
    return rate;
  }

  Functional
  jump_rate(const BoundScene &bound, const Step &step, const unsigned int end)
  {
    Functional rate;
    if (const auto jump = dof_of_jump(bound, step.number, step.ends[end]))
      rate.add(*jump, (end == 0 ? 1. : -1.) * direction_of(step));
    return rate;
  }

  Functional
  hinge_rate(const BoundScene  &bound,
             const BarChain    &chain,
             const unsigned int i)
  {
    const unsigned int n = chain.edges.size();
    Functional         jump;
    const bool         closed   = chain.is_closed();
    const bool         at_first = i == 0, at_last = i == n;
    if ((closed && at_last) || (!closed && (at_first || at_last) &&
                                !chain.structure->is_clamped(at_last)))
      return jump;
    if (!at_first || closed)
      add_slope(bound, {bound, chain, at_first ? n - 1 : i - 1}, 1, -1., jump);
    if (!at_last)
      add_slope(bound, {bound, chain, i}, 0, 1., jump);
    return jump;
  }

  Functional
  upper_rate_of_tie(const BoundScene &bound, const PlasticBars::Tie &tie)
  {
    return rate_of_tie(
      tie,
      [&](const unsigned int v, const Tensor<1, dim> &f, Functional &rate) {
        rate.add(
          dof_of_node(
            bound, bound.bars.node_of_vertex(bound.bars.number_of_vertex(v))),
          f);
      });
  }

  unsigned int
  owner_of(const BoundScene &bound, const PlasticBars::Tie &tie)
  {
    const unsigned int v = std::max(tie.vertices[0], tie.vertices[1]);
    for (const BarEdge &edge : bound.bars.edges)
      for (const unsigned int end : bound.triangles.edges[edge.edge].vertices)
        if (end == v)
          return edge.cells[0];
    return 0;
  }
} // namespace geocone::GEOCONE_DIM
