// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/space/vertex_interpolation.h>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Value of the linear, bilinear or trilinear shape function of vertex @p v
     *  of the reference cell. */
    double
    vertex_function(const unsigned int v,
                    const Point<dim>  &unit,
                    const bool         simplicial)
    {
      if (simplicial)
        {
          double rest = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            rest -= unit[d];
          return v == 0 ? rest : unit[v - 1];
        }
      double value = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        value *= (v >> d) % 2 == 1 ? unit[d] : 1. - unit[d];
      return value;
    }
  } // namespace

  VertexInterpolation
  interpolation_from_vertices(const BackgroundMesh &mesh, const Space &space)
  {
    const double least = 1e-9; // smaller weights are rounding errors

    std::vector<std::vector<VertexInterpolation::Weight>> weights(
      space.n_local_nodes());
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        // The vertices are the first nodes of a cell.
        space.cell_nodes(cell, nodes);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            const unsigned int node = space.local_node(nodes[i]);
            if (!weights[node].empty())
              continue;
            if (i < cell->n_vertices())
              {
                weights[node] = {{node, 1.}};
                continue;
              }
            const Point<dim> unit = mesh.mapping().transform_real_to_unit_cell(
              cell, space.node_positions()[node]);
            for (unsigned int v = 0; v < cell->n_vertices(); ++v)
              if (const double w =
                    vertex_function(v, unit, mesh.is_simplicial());
                  std::abs(w) > least)
                weights[node].emplace_back(space.local_node(nodes[v]), w);
          }
      }
    VertexInterpolation result;
    result.first = {0};
    for (const auto &of_node : weights)
      {
        result.weights.insert(
          result.weights.end(), of_node.begin(), of_node.end());
        result.first.push_back(result.weights.size());
      }
    return result;
  }
} // namespace geocone::GEOCONE_DIM
