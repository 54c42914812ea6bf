// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/plane_bounds/bar_problem.h>
#include <geocone/plane_bounds/bound_loads.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using dealii::Tensor;

  namespace
  {
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
  first_dof_of_bars(const BoundScene &bound, const BoundSide side)
  {
    const Triangles   &triangles = bound.triangles;
    const unsigned int n_nodes =
      side == BoundSide::upper
        ? triangles.vertices.size() + triangles.edges.size()
        : triangles.cells.size() + 2 * triangles.edges.size();
    return dim * n_nodes + n_dofs_of_interfaces(bound);
  }

  PointCone
  interface_cone(const BoundScene  &bound,
                 const BoundSide    side,
                 const BarEdge     &edge,
                 const unsigned int cell,
                 const unsigned int vertex)
  {
    const auto        &corners = bound.triangles.cells[cell];
    const unsigned int i =
      std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    const PointCone soil    = bound.cone_at(side, cell, i);
    const double    cos_phi = std::sqrt(1. - soil.a * soil.a);
    return {edge.interface_strength * soil.a / cos_phi,
            edge.interface_strength * soil.k / (sqrt2 * cos_phi)};
  }

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
    add_lower_bars(bound, problem, cells);
    cells.exclude_unused(first, end);
  }
} // namespace geocone::GEOCONE_DIM
