// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/bar_problem.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
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
              const double   length =
                triangles.edge_length(edge.edge) / bound.units.length;
              const Tensor<1, dim> N = normal_into(triangles, cell, edge.edge);
              const PointCone      first = interface_cone(
                                bound, BoundSide::upper, edge, cell, ends[0]),
                              last = interface_cone(
                                bound, BoundSide::upper, edge, cell, ends[1]);
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
  } // namespace

  void
  add_upper_bars(const BoundScene   &bound,
                 const BoundProblem &problem,
                 BarCells           &cells)
  {
    add_upper_interfaces(bound, cells);
    for (const BarChain &chain : bound.bars.chains)
      if (const auto parts =
            strength_parts(*chain.structure, bound.units, BoundSide::upper);
          parts.empty())
        add_upper_chain(bound, chain, problem, cells);
      else
        add_upper_plate(bound, chain, parts, cells);
    for (const PlasticBars::Tie &tie : bound.bars.ties)
      {
        cells.add(axial_interval(*tie.structure, bound.units, BoundSide::upper),
                  upper_rate_of_tie(bound, tie),
                  1.);
        cells.end_cell(owner_of(bound, tie));
      }
  }
} // namespace geocone::GEOCONE_DIM
