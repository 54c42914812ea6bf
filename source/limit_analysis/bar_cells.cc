// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/limit_analysis/bar_rows.h>
#include <geocone/limit_analysis/bound_loads.h>
#include <geocone/limit_analysis/interface_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** First dof of structures. */
    unsigned int
    first_dof_of_bars(const BoundScene &bound, const BoundSide side)
    {
      const Triangles   &triangles = bound.triangles;
      const unsigned int n_nodes =
        side == BoundSide::upper
          ? triangles.vertices.size() + triangles.edges.size()
          : triangles.cells.size() + 2 * triangles.edges.size();
      return dim * n_nodes + n_dofs_of_interfaces(bound);
    }

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

  namespace
  {
    /** Appends cells of structures to a problem. */
    class BarCells
    {
    public:
      BarCells(BoundProblem &problem)
        : problem(problem)
        , is_used(problem.n_dofs(), false)
      {}

      /** Adds a force that works with a rate, times a volume. */
      void
      add(const Interval &interval, const Functional &rate, const double volume)
      {
        if (interval.is_zero || rate.entries.empty())
          return skip();
        // Rates of order one, as those of the soil times its volume.
        double norm = 0.;
        for (const auto &entry : rate.entries)
          norm += entry.second * entry.second;
        const double V = volume * std::sqrt(norm);
        StrainMatrix B = StrainMatrix::Zero(3, rate.entries.size());
        std::vector<unsigned int> dofs;
        for (const auto &[dof, factor] : rate.entries)
          {
            B(interval.component, dofs.size()) =
              interval.sign * factor * volume / V;
            problem.dead[dof] -= volume * interval.shift * factor;
            dofs.push_back(dof);
          }
        add(interval.cone, B, dofs, V);
      }

      /** Adds cells of an axial force and a moment that interact.
       *  @param owner triangle */
      void
      add(const std::vector<StrengthPart> &parts,
          const Functional                &axial,
          const Functional                &moment,
          const double                     volume,
          const unsigned int               owner)
      {
        for (const StrengthPart &part : parts)
          {
            Functional rate;
            rate.add(axial, part.axial / part.size());
            rate.add(moment, part.moment / part.size());
            add(part.interval(), rate, volume);
            if (n_points % 3 == 0)
              end_cell(owner);
          }
      }

      /** Adds a point, unless its rate is zero whatever the velocities are. */
      void
      add(const PointCone                 &cone,
          const StrainMatrix              &B,
          const std::vector<unsigned int> &dofs,
          const double                     volume)
      {
        bool            is_free = false;
        Eigen::Vector3d given   = Eigen::Vector3d::Zero();
        for (unsigned int j = 0; j < dofs.size(); ++j)
          {
            is_free = is_free || !problem.is_prescribed[dofs[j]];
            given += B.col(j) * problem.prescribed[dofs[j]];
          }
        if (!is_free && given.norm() < 1e-12)
          return skip();
        for (const unsigned int dof : dofs)
          is_used[dof] = true;
        problem.volume.push_back(volume);
        problem.cone.push_back(cone);
        problem.B.add(B, dofs);
        ++n_points;
      }

      /** Adds a point without force. */
      void
      skip()
      {
        problem.volume.push_back(1.);
        problem.cone.push_back(inactive_cone);
        problem.B.add(StrainMatrix(3, 0), {});
        ++n_points;
      }

      /** Excludes dofs in which no force works. */
      void
      exclude_unused(const unsigned int first, const unsigned int end)
      {
        for (unsigned int dof = first; dof < end; ++dof)
          if (!is_used[dof] && !problem.is_prescribed[dof])
            problem.is_prescribed[dof] = problem.has_no_force[dof] = true;
      }

      /** Ends a cell. @param owner triangle */
      void
      end_cell(const unsigned int owner)
      {
        while (n_points % 3 > 0)
          skip();
        problem.owner.push_back(owner);
        ++problem.n_bar_cells;
      }

    private:
      BoundProblem     &problem;
      std::vector<bool> is_used;
      unsigned int      n_points = 0;
    };

  } // namespace

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
    /** The functional over the length of an edge. */
    Functional
    over_length(Functional rate, const Step &step)
    {
      for (auto &[dof, factor] : rate.entries)
        factor /= step.length;
      return rate;
    }

    /** Coulomb's cone of an interface at an end of an edge: tan(phi) and c of the soil
     *  beside it, times the strength of the interface. */
    PointCone
    interface_cone(const BoundScene  &bound,
                   const BarEdge     &edge,
                   const unsigned int cell,
                   const unsigned int vertex)
    {
      const PointCone soil    = bound.cone_at(bound.triangles.material[cell],
                                           bound.triangles.vertices[vertex]);
      const double    cos_phi = std::sqrt(1. - soil.a * soil.a);
      return {edge.interface_strength * soil.a / cos_phi,
              edge.interface_strength * soil.k / (sqrt2 * cos_phi)};
    }

    /** Velocity of the soil beside an edge relative to the structure, coefficients in
     *  Bernstein's basis. */
    std::array<PassingVelocity, 3>
    passing_velocities(const BoundScene  &bound,
                       const unsigned int number,
                       const unsigned int cell)
    {
      const Triangles   &triangles = bound.triangles;
      const PlasticBars &bars      = bound.bars;
      const unsigned int edge      = bars.edges[number].edge;
      const auto        &ends      = triangles.edges[edge].vertices;
      const auto         node      = [&](const unsigned int i) {
        return dof_of_node(bound, bars.node_of_cell(triangles, cell, i));
      };
      const std::array<unsigned int, 2> soil = {
        {node(position_in(triangles.cells[cell], ends[0])),
         node(position_in(triangles.cells[cell], ends[1]))}};
      const unsigned int middle =
        node(3 + position_in(triangles.edges_of_cell[cell], edge));
      std::array<PassingVelocity, 3> all;
      const auto                     add =
        [&](const unsigned int i, const unsigned int dof, const double factor) {
          for (unsigned int d = 0; d < dim; ++d)
            all[i].add(dof + d, factor * Point<dim>::unit_vector(d));
        };
      for (unsigned int end = 0; end < 2; ++end)
        {
          const unsigned int bar = dof_of_node(
            bound, bars.node_of_vertex(bars.number_of_vertex(ends[end])));
          if (bar != soil[end]) // else bonded
            {
              add(2 * end, soil[end], 1.);
              add(2 * end, bar, -1.);
              if (const auto jump = dof_of_jump(bound, number, end))
                all[2 * end].add(*jump, -1. * along_mesh(triangles, edge));
            }
        }
      add(1, middle, 2.);
      add(1, soil[0], -0.5);
      add(1, soil[1], -0.5);
      add(1, dof_of_node(bound, bars.node_of_edge(number)), -1.);
      return all;
    }

    constexpr Interface::Face coulomb = {0., 0., true, true};

    /** Adds the interfaces on both sides of the structures to the upper problem. The
     *  soil's tensile strength is not applied there, which makes the dissipation
     *  larger. */
    void
    add_upper_interfaces(const BoundScene &bound, BarCells &cells)
    {
      const Triangles &triangles = bound.triangles;
      for (unsigned int k = 0; k < bound.bars.edges.size(); ++k)
        for (const int cell : bound.bars.edges[k].cells)
          if (cell >= 0)
            {
              const BarEdge &edge   = bound.bars.edges[k];
              const auto    &ends   = triangles.edges[edge.edge].vertices;
              const double   length = triangles.vertices[ends[0]].distance(
                                      triangles.vertices[ends[1]]) /
                                    bound.units.length;
              const Tensor<1, dim> N = normal_into(triangles, cell, edge.edge);
              const PointCone      first =
                                interface_cone(bound, edge, cell, ends[0]),
                              last = interface_cone(bound, edge, cell, ends[1]);
              const auto passing   = passing_velocities(bound, k, cell);
              for (unsigned int i = 0; i < 3; ++i)
                {
                  // The integral of a linear k times this Bernstein function.
                  const double k_i = 3. * (share_of_end[i][0] * first.k +
                                           share_of_end[i][1] * last.k);
                  cells.add({first.a, k_i},
                            passing[i].strains(coulomb, N),
                            passing[i].dofs,
                            length / 3.);
                }
              cells.end_cell(cell);
            }
    }

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

  namespace
  {
    /** Rate of the length of an anchor or strut. @param lower dofs of vertices are along
     *  their frames */
    template <typename Dof>
    Functional
    rate_of_tie(const PlasticBars::Tie &tie, const Dof &add_velocity)
    {
      Functional rate;
      for (unsigned int end = 0; end < 2; ++end)
        if (tie.vertices[end] >= 0)
          add_velocity(
            tie.vertices[end], (end == 0 ? -1. : 1.) * tie.along, rate);
      return rate;
    }

  } // namespace

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

  namespace
  {
    /** Whether the velocities of both ends of a chain are prescribed along it. */
    bool
    is_held_at_both_ends(const BoundScene   &bound,
                         const BarChain     &chain,
                         const BoundProblem &problem)
    {
      for (const bool at_last : {false, true})
        {
          const Step step(bound, chain, at_last ? chain.edges.size() - 1 : 0);
          const unsigned int dof =
            dof_of_node(bound,
                        bound.bars.node_of_vertex(
                          bound.bars.number_of_vertex(step.vertices[at_last])));
          for (unsigned int d = 0; d < dim; ++d)
            if (std::abs(step.t[d]) > 1e-9 && !problem.is_prescribed[dof + d])
              return false;
        }
      return true;
    }

    /** Triangle of a vertex of a chain. */
    unsigned int
    owner_of(const BoundScene  &bound,
             const BarChain    &chain,
             const unsigned int i)
    {
      return owner_of(
        bound,
        Step(bound, chain, std::min<unsigned int>(i, chain.edges.size() - 1)));
    }

    /** Adds a plate whose axial force and moment interact: edges, and then vertices. At a
     *  vertex half of the rotation is that of each edge: a sum of dissipations is not
     *  less than the power of the forces on both sides of it. */
    void
    add_upper_plate(const BoundScene                &bound,
                    const BarChain                  &chain,
                    const std::vector<StrengthPart> &parts,
                    BarCells                        &cells)
    {
      for (unsigned int i = 0; i < chain.edges.size(); ++i)
        {
          const Step step(bound, chain, i);
          for (unsigned int end = 0; end < 2; ++end)
            cells.add(parts,
                      axial_rate(bound, step, end),
                      curvature_rate(bound, step),
                      step.length / 2.,
                      owner_of(bound, step));
        }
      for (unsigned int i = 0; i < chain.vertices.size(); ++i)
        {
          const auto steps = steps_at(bound, chain, i);
          Functional rotation;
          rotation.add(hinge_rate(bound, chain, i),
                       steps[0] && steps[1] ? 0.5 : 1.);
          for (unsigned int side = 0; side < 2; ++side)
            cells.add(parts,
                      steps[side] ? jump_rate(bound, *steps[side], 1 - side)
                                  : Functional(),
                      steps[side] ? rotation : Functional(),
                      1.,
                      owner_of(bound, chain, i));
        }
    }

    /** Adds axial strains and curvatures of all edges, and then the hinges. */
    void
    add_upper_chain(const BoundScene   &bound,
                    const BarChain     &chain,
                    const BoundProblem &problem,
                    BarCells           &cells)
    {
      Interval axial =
        axial_interval(*chain.structure, bound.units, BoundSide::upper);
      // Rates of one sign whose sum is given: none, along a straight chain; else
      // the bound is strict all the same.
      if (axial.is_one_sided() && is_held_at_both_ends(bound, chain, problem))
        axial = Interval(-std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::infinity());
      const Interval moment =
        moment_interval(*chain.structure, bound.units, BoundSide::upper);
      const bool bends = chain.structure->is_plate();
      for (unsigned int i = 0; i < chain.edges.size(); ++i)
        {
          const Step step(bound, chain, i);
          for (unsigned int end = 0; end < 2; ++end)
            cells.add(axial, axial_rate(bound, step, end), step.length / 2.);
          if (bends)
            cells.add(moment, curvature_rate(bound, step), step.length);
          cells.end_cell(owner_of(bound, step));
          for (unsigned int end = 0; end < 2; ++end)
            cells.add(axial, jump_rate(bound, step, end), 1.);
          cells.end_cell(owner_of(bound, step));
        }
      for (unsigned int i = 0; bends && i < chain.vertices.size(); ++i)
        {
          cells.add(moment, hinge_rate(bound, chain, i), 1.);
          cells.end_cell(owner_of(bound, chain, i));
        }
    }

    void
    add_upper_bars(const BoundScene   &bound,
                   const BoundProblem &problem,
                   BarCells           &cells)
    {
      for (const BarChain &chain : bound.bars.chains)
        if (const auto parts =
              strength_parts(*chain.structure, bound.units, BoundSide::upper);
            parts.empty())
          add_upper_chain(bound, chain, problem, cells);
        else
          add_upper_plate(bound, chain, parts, cells);
      for (const PlasticBars::Tie &tie : bound.bars.ties)
        {
          cells.add(
            axial_interval(*tie.structure, bound.units, BoundSide::upper),
            upper_rate_of_tie(bound, tie),
            1.);
          cells.end_cell(owner_of(bound, tie));
        }
    }

    /** Number of conditions on the degree of axial forces in the lower bound. */
    unsigned int
    n_cubic_dofs(const BarChain &chain)
    {
      return chain.structure->interacts() ? chain.edges.size() : 0;
    }

    /** Dofs of the lower bound and the state of the vertices of structures. */
    class LowerBars
    {
    public:
      LowerBars(const BoundScene &bound, const BoundProblem &problem)
        : bound(bound)
        , bars(bound.bars)
        , first(first_dof_of_bars(bound, BoundSide::lower))
        , frame(bars.vertices.size())
        , n_edges(bars.vertices.size(), 0)
        , is_tied(bars.vertices.size(), false)
        , problem(problem)
      {
        unsigned int next = first + bars.n_more_lower_dofs();
        for (const BarChain &chain : bars.chains)
          {
            first_cubic.push_back(next);
            next += n_cubic_dofs(chain);
          }
        for (const BarChain &chain : bars.chains)
          for (unsigned int i = 0; i < chain.edges.size(); ++i)
            {
              const Step step(bound, chain, i);
              for (const unsigned int v : step.vertices)
                {
                  const unsigned int k = bars.number_of_vertex(v);
                  if (n_edges[k]++ == 0)
                    frame[k] = step.t;
                }
            }
        for (unsigned int k = 0; k < frame.size(); ++k)
          if (is_held(k, 0) || is_held(k, 1))
            frame[k] = Point<dim>::unit_vector(0);
        for (const PlasticBars::Tie &tie : bars.ties)
          for (const int v : tie.vertices)
            if (v >= 0)
              is_tied[bars.number_of_vertex(v)] = true;
      }

      /** Adds the force f on a vertex. */
      void
      add_at_vertex(const unsigned int    vertex,
                    const Tensor<1, dim> &f,
                    Functional           &rate) const
      {
        const unsigned int    k     = bars.number_of_vertex(vertex);
        const Tensor<1, dim> &t     = frame[k];
        const double          along = f * t, across = t[0] * f[1] - t[1] * f[0];
        // Forces along a straight chain have no component across it but by rounding.
        if (std::abs(along) > 1e-9 * f.norm())
          rate.add(first + bars.dof_of_vertex(k), along);
        if (std::abs(across) > 1e-9 * f.norm())
          rate.add(first + bars.dof_of_vertex(k) + 1, across);
      }

      /** Adds the force f on the structure at an end of an edge. */
      void
      add_at_end(const Step           &step,
                 const unsigned int    end,
                 const Tensor<1, dim> &f,
                 Functional           &rate) const
      {
        rate.add(dim * (bound.triangles.cells.size() +
                        2 * bars.edges[step.number].edge + step.ends[end]),
                 f);
      }

      void
      add_rotation(const unsigned int chain,
                   const unsigned int i,
                   const double       factor,
                   Functional        &rate) const
      {
        rate.add(first + bars.dof_of_rotation(chain, i), factor);
      }

      bool
      has_no_force(const unsigned int dof) const
      {
        return problem.has_no_force[dof];
      }

      /** Whether the axial force is zero at an end of a chain. */
      bool
      is_free_end(const BarChain &chain, const unsigned int i) const
      {
        if (i > 0 && i + 1 < chain.vertices.size())
          return false;
        const unsigned int k = bars.number_of_vertex(chain.vertices[i]);
        if (n_edges[k] > 1 || is_tied[k])
          return false;
        const Step step(bound, chain, i == 0 ? 0 : i - 1);
        for (unsigned int d = 0; d < dim; ++d)
          if (std::abs(step.t[d]) > 1e-9 && !is_held(k, d))
            return true;
        return false;
      }

      /** Virtual power of the coefficient j of the axial force of an edge. */
      Functional
      axial(const BarChain    &chain,
            const unsigned int i,
            const unsigned int j) const
      {
        const Step step(bound, chain, i);
        Functional rate;
        if (j < 2)
          add_at_end(step, 0, (j == 0 ? 1. : -1.) * step.t, rate);
        if (j > 0)
          add_at_end(step, 1, (j == 1 ? 1. : -1.) * step.t, rate);
        if (j == 0)
          add_at_vertex(step.vertices[0], -1. * step.t, rate);
        if (j == 2)
          add_at_vertex(step.vertices[1], step.t, rate);
        return rate;
      }

      /** Virtual power of the coefficient j of the axial force of an edge in the basis of
       *  degree three, with the condition that its degree is two. */
      Functional
      cubic_axial(const unsigned int c,
                  const unsigned int i,
                  const unsigned int j) const
      {
        constexpr double third[4] = {1., -3., 3., -1.};
        const Step       step(bound, bars.chains[c], i);
        Functional       rate;
        add_at_end(step, j / 2, (j % 2 == 0 ? 1.5 : -1.5) * step.t, rate);
        if (j == 0)
          add_at_vertex(step.vertices[0], -1. * step.t, rate);
        if (j == 3)
          add_at_vertex(step.vertices[1], step.t, rate);
        rate.add(first_cubic[c] + i, third[j]);
        return rate;
      }

      /** Virtual power of the coefficient j of the moment of an edge of a plate. */
      Functional
      moment(const unsigned int c,
             const unsigned int i,
             const unsigned int j) const
      {
        const BarChain  &chain = bars.chains[c];
        const Step       step(bound, chain, i);
        const double     by           = 3. / step.length;
        constexpr double second[2][4] = {{1., -2., 1., 0.}, {0., 1., -2., 1.}};
        Functional       rate;
        for (unsigned int end = 0; end < 2; ++end)
          if (second[end][j] != 0.)
            add_at_end(step, end, by * second[end][j] * step.n, rate);
        if (j < 2) // shear force at the beginning
          add_at_vertex(step.vertices[0], (j == 1 ? by : -by) * step.n, rate);
        else // and at the end
          add_at_vertex(step.vertices[1], (j == 2 ? by : -by) * step.n, rate);
        if (j == 0)
          add_rotation(c, i, -1., rate);
        if (j == 3)
          add_rotation(c, i + 1, 1., rate);
        return rate;
      }

      const BoundScene  &bound;
      const PlasticBars &bars;
      const unsigned int first;

    private:
      bool
      is_held(const unsigned int k, const unsigned int d) const
      {
        return problem.is_prescribed[first + bars.dof_of_vertex(k) + d];
      }

      std::vector<unsigned int>   first_cubic; ///< dof of each chain
      std::vector<Tensor<1, dim>> frame;       ///< first axis of each vertex
      std::vector<unsigned int>   n_edges;     ///< at each vertex
      std::vector<bool>           is_tied;
      const BoundProblem         &problem;
    };

    /** Adds the tractions on interfaces that are weaker than the soil. */
    void
    add_lower_interfaces(const LowerBars &lower, BarCells &cells)
    {
      const BoundScene &bound     = lower.bound;
      const Triangles  &triangles = bound.triangles;
      for (unsigned int k = 0; k < bound.bars.edges.size(); ++k)
        if (bound.bars.has_weak_interface(k))
          for (const int cell : bound.bars.edges[k].cells)
            if (cell >= 0)
              {
                const BarEdge &edge   = bound.bars.edges[k];
                const auto    &ends   = triangles.edges[edge.edge].vertices;
                const double   length = triangles.vertices[ends[0]].distance(
                                        triangles.vertices[ends[1]]) /
                                      bound.units.length;
                for (unsigned int end = 0; end < 2; ++end)
                  {
                    const unsigned int soil =
                      dof_at_end_of_cell(bound, cell, edge.edge, ends[end]);
                    if (lower.has_no_force(soil))
                      {
                        cells.skip(); // soil at its apex
                        continue;
                      }
                    PassingVelocity    passing;
                    const unsigned int bar =
                      dim * (triangles.cells.size() + 2 * edge.edge + end);
                    for (unsigned int d = 0; d < dim; ++d)
                      {
                        passing.add(soil + d, Point<dim>::unit_vector(d));
                        passing.add(bar + d, -1. * Point<dim>::unit_vector(d));
                      }
                    cells.add(
                      interface_cone(bound, edge, cell, ends[end]),
                      passing.strains(coulomb,
                                      normal_into(triangles, cell, edge.edge)),
                      passing.dofs,
                      length / 2.);
                  }
                cells.end_cell(cell);
              }
    }

    void
    add_lower_bars(const LowerBars &lower, BarCells &cells)
    {
      const BoundScene &bound = lower.bound;
      for (unsigned int c = 0; c < bound.bars.chains.size(); ++c)
        {
          const BarChain &chain = bound.bars.chains[c];
          const Interval  axial = axial_interval(*chain.structure,
                                                bound.units,
                                                BoundSide::lower,
                                                chain.ends_are_held),
                         moment = moment_interval(
                           *chain.structure, bound.units, BoundSide::lower);
          const auto [least, most] = chain.structure->axial_strength();
          const auto parts =
            strength_parts(*chain.structure, bound.units, BoundSide::lower);
          for (unsigned int i = 0; i < chain.edges.size(); ++i)
            {
              const Step step(bound, chain, i);
              for (unsigned int j = 0; j < 4 && !parts.empty(); ++j)
                cells.add(parts,
                          over_length(lower.cubic_axial(c, i, j), step),
                          over_length(lower.moment(c, i, j), step),
                          step.length,
                          owner_of(bound, step));
              if (!parts.empty())
                continue;
              for (unsigned int j = 0; j < 3; ++j)
                if (j != 1 && (least == 0. || most == 0.) &&
                    lower.is_free_end(chain, j == 0 ? i : i + 1))
                  cells.skip(); // zero, at the end of the interval
                else
                  cells.add(axial,
                            over_length(lower.axial(chain, i, j), step),
                            step.length);
              cells.end_cell(owner_of(bound, step));
              if (!chain.structure->is_plate())
                continue;
              for (unsigned int j = 0; j < 4; ++j)
                {
                  cells.add(moment,
                            over_length(lower.moment(c, i, j), step),
                            step.length);
                  if (j > 1)
                    cells.end_cell(owner_of(bound, step));
                }
            }
        }
      for (const PlasticBars::Tie &tie : bound.bars.ties)
        {
          cells.add(
            axial_interval(*tie.structure, bound.units, BoundSide::lower),
            rate_of_tie(
              tie,
              [&](const unsigned int    v,
                  const Tensor<1, dim> &f,
                  Functional &rate) { lower.add_at_vertex(v, f, rate); }),
            1.);
          cells.end_cell(owner_of(bound, tie));
        }
    }
    /** Prescribes velocities of the vertices of structures on sides with prescribed
     *  velocities. @param dof_of number of the vertex -> its x dof */
    template <typename DofOfVertex>
    void
    hold_vertices(const BoundScene  &bound,
                  const DofOfVertex &dof_of,
                  BoundProblem      &problem)
    {
      const Triangles &triangles = bound.triangles;
      for (const auto &condition : bound.scene.dirichlet.list)
        for (const auto &held : triangles.held_edges(*condition))
          for (const unsigned int v : triangles.edges[held.edge].vertices)
            if (const int k = bound.bars.number_of_vertex(v); k >= 0)
              for_prescribed(*condition,
                             triangles.vertices[v],
                             -1. * normal_into(triangles, held.cell, held.edge),
                             bound.units.velocity,
                             [&](const unsigned int d, const double value) {
                               problem.is_prescribed[dof_of(k) + d] = true;
                               problem.prescribed[dof_of(k) + d]    = value;
                             });
    }
  } // namespace

  unsigned int
  n_dofs_of_bars(const BoundScene &bound, const BoundSide side)
  {
    if (bound.bars.empty())
      return 0;
    if (side == BoundSide::upper)
      return bound.bars.n_more_upper_dofs();
    unsigned int n = bound.bars.n_more_lower_dofs();
    for (const BarChain &chain : bound.bars.chains)
      n += n_cubic_dofs(chain);
    return n;
  }

  unsigned int
  n_lower_columns(const BoundScene &bound)
  {
    return std::any_of(
             bound.bars.chains.begin(),
             bound.bars.chains.end(),
             [](const BarChain &chain) { return n_cubic_dofs(chain) > 0; })
             ? 10
             : 6;
  }

  unsigned int
  dof_of_node(const BoundScene &bound, const unsigned int node)
  {
    const unsigned int n_nodes =
      bound.triangles.vertices.size() + bound.triangles.edges.size();
    return node < n_nodes ? dim * node
                          : first_dof_of_bars(bound, BoundSide::upper) +
                              dim * (node - n_nodes);
  }

  unsigned int
  dof_at_end_of_cell(const BoundScene  &bound,
                     const unsigned int cell,
                     const unsigned int edge,
                     const unsigned int vertex)
  {
    const unsigned int end =
      bound.triangles.edges[edge].vertices[0] == vertex ? 0 : 1;
    if (const int k = bound.bars.number_of_edge(edge);
        k >= 0 && bound.bars.has_weak_interface(k))
      return first_dof_of_bars(bound, BoundSide::lower) +
             bound.bars.dof_of_side(k, bound.bars.side_of(k, cell), end);
    return dim * (bound.triangles.cells.size() + 2 * edge + end);
  }

  void
  add_bars(const BoundScene &bound, const BoundSide side, BoundProblem &problem)
  {
    const PlasticBars &bars = bound.bars;
    if (bars.empty())
      return;
    const unsigned int first = first_dof_of_bars(bound, side),
                       end   = first + n_dofs_of_bars(bound, side);
    BarCells cells(problem);
    if (side == BoundSide::upper)
      {
        hold_vertices(
          bound,
          [&](const unsigned int k) {
            return dof_of_node(bound, bars.node_of_vertex(k));
          },
          problem);
        add_upper_interfaces(bound, cells);
        add_upper_bars(bound, problem, cells);
        return;
      }
    hold_vertices(
      bound,
      [&](const unsigned int k) { return first + bars.dof_of_vertex(k); },
      problem);
    for (unsigned int c = 0; c < bars.chains.size(); ++c)
      for (const bool at_last : {false, true})
        if (bars.chains[c].structure->is_plate() &&
            bars.chains[c].structure->is_clamped(at_last))
          problem
            .is_prescribed[first +
                           bars.dof_of_rotation(
                             c, at_last ? bars.chains[c].edges.size() : 0)] =
            true;
    const LowerBars lower(bound, problem);
    add_lower_interfaces(lower, cells);
    add_lower_bars(lower, cells);
    cells.exclude_unused(first, end);
  }
} // namespace geocone::GEOCONE_DIM
