// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/linear/linear_solver.h>
#include <geocone/seepage/confined_flow.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  ConfinedFlow::ConfinedFlow(const FlowMesh &mesh, const unsigned int degree)
    : mesh(mesh)
    , shape(degree)
    , positions(mesh.vertices)
  {
    // Cells share a node of the same vertices and indices of them.
    using Pairs = std::vector<std::pair<unsigned int, unsigned int>>;
    std::map<Pairs, unsigned int> number;
    for (const auto &cell : mesh.cells)
      {
        nodes_of_cell.emplace_back();
        for (const auto &index : shape.nodes())
          {
            Pairs      pairs;
            Point<dim> x;
            for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
              if (index[i] > 0)
                {
                  pairs.emplace_back(cell[i], index[i]);
                  x += double(index[i]) / degree * mesh.vertices[cell[i]];
                }
            if (pairs.size() == 1)
              {
                nodes_of_cell.back().push_back(pairs[0].first);
                continue;
              }
            std::sort(pairs.begin(), pairs.end());
            const auto [entry, is_new] =
              number.emplace(pairs, positions.size());
            if (is_new)
              positions.push_back(x);
            nodes_of_cell.back().push_back(entry->second);
          }
      }
  }

  std::vector<unsigned int>
  ConfinedFlow::nodes_on(const std::vector<unsigned int> &facets) const
  {
    std::vector<bool> is_listed(mesh.facet_vertices.size(), false);
    for (const unsigned int f : facets)
      is_listed[f] = true;
    std::vector<unsigned int> all;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
        if (is_listed[mesh.facets_by_cell[c][i]])
          for (unsigned int a = 0; a < shape.nodes().size(); ++a)
            if (shape.nodes()[a][i] == 0)
              all.push_back(nodes_of_cell[c][a]);
    return all;
  }

  std::vector<Tensor<1, dim>>
  ConfinedFlow::gradients(const unsigned int                  cell,
                          const LagrangeSimplex::Barycentric &at) const
  {
    const auto                  g = mesh.gradients(cell);
    std::vector<Tensor<1, dim>> all(shape.nodes().size());
    for (unsigned int a = 0; a < all.size(); ++a)
      {
        const auto dN = shape.derivatives(a, at);
        for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
          all[a] += dN[i] * g[i];
      }
    return all;
  }

  std::vector<double>
  ConfinedFlow::conductances(const unsigned int             cell,
                             const SymmetricTensor<2, dim> &k,
                             const Geometry::Symmetry       symmetry) const
  {
    // Exact for degree 5: gradients of degree 2 each, and the radius.
    static const dealii::QWitherdenVincentSimplex<dim> rule(3);
    const unsigned int                                 n = shape.nodes().size();
    std::vector<double>                                all(n * n, 0.);
    double reference = 0.; // sum of the weights
    for (const double weight : rule.get_weights())
      reference += weight;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        LagrangeSimplex::Barycentric at;
        at[dim] = 1.;
        Point<dim> x;
        for (unsigned int i = 0; i < dim; ++i)
          {
            at[i] = rule.point(q)[i];
            at[dim] -= at[i];
          }
        for (unsigned int i = 0; i < FlowMesh::n_corners; ++i)
          x += at[i] * mesh.vertices[mesh.cells[cell][i]];
        const double volume = rule.weight(q) / reference *
                              mesh.cell_size(cell) *
                              Geometry::measure(symmetry, x);
        const auto g = gradients(cell, at);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            all[a * n + b] += volume * (g[a] * (k * g[b]));
      }
    return all;
  }

  void
  ConfinedFlow::solve(const std::vector<SymmetricTensor<2, dim>> &permeability,
                      const Geometry::Symmetry                    symmetry,
                      const std::vector<std::optional<double>>   &prescribed)
  {
    const unsigned int            n = positions.size();
    std::vector<std::vector<int>> columns(n);
    for (const auto &nodes : nodes_of_cell)
      for (const unsigned int i : nodes)
        columns[i].insert(columns[i].end(), nodes.begin(), nodes.end());
    SparseMatrix matrix;
    matrix.n_global = matrix.n_owned = n;
    for (unsigned int i = 0; i < n; ++i)
      matrix.global_index.push_back(i);
    matrix.set_pattern(std::move(columns));
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const auto &nodes = nodes_of_cell[c];
        const auto  local =
          conductances(c, permeability[mesh.material[c]], symmetry);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          for (unsigned int b = 0; b < nodes.size(); ++b)
            matrix.value[matrix.entry(nodes[a], nodes[b])] +=
              local[a * nodes.size() + b];
      }
    // Prescribed rows and columns are eliminated, so that the matrix stays symmetric.
    const SparseMatrix  balance = matrix;
    std::vector<double> h(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (int e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
        {
          const unsigned int j = matrix.column[e];
          if (prescribed[i] && i == j)
            h[i] = matrix.value[e] * (*prescribed[i] + positions[i][1]);
          else if (!prescribed[i] && prescribed[j])
            h[i] -= matrix.value[e] * (*prescribed[j] + positions[j][1]);
          if ((prescribed[i] || prescribed[j]) && i != j)
            matrix.value[e] = 0.;
        }
    const auto solver =
      make_cholmod(LinearSolverParameters::IndexSize::automatic);
    solver->analyse(matrix);
    if (!solver->factorise(matrix))
      throw RunError("the flow of water was not found: its linear system is "
                     "singular\n  remedy:  check the permeabilities, or change "
                     "'Seepage/Cells'");
    solver->solve(h);
    head.assign(n, 0.);
    inflow.assign(n, 0.);
    error = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        double sum = 0., size = 0.;
        for (int e = balance.row_start[i]; e < balance.row_start[i + 1]; ++e)
          {
            const double flow =
              balance.value[e] * (h[balance.column[e]] - h[i]);
            sum += flow;
            size += std::abs(flow);
          }
        if (prescribed[i])
          inflow[i] = sum;
        else if (size > 0.)
          error = std::max(error, std::abs(sum) / size);
        head[i] = prescribed[i].value_or(h[i] - positions[i][1]);
      }
  }

  Tensor<1, dim>
  ConfinedFlow::velocity(const unsigned int                  cell,
                         const LagrangeSimplex::Barycentric &at,
                         const SymmetricTensor<2, dim>      &k) const
  {
    Tensor<1, dim> gradient;
    const auto     g = gradients(cell, at);
    for (unsigned int a = 0; a < g.size(); ++a)
      {
        const unsigned int node = nodes_of_cell[cell][a];
        gradient += (head[node] + positions[node][1]) * g[a];
      }
    return -1. * (k * gradient);
  }
} // namespace geocone::GEOCONE_DIM
