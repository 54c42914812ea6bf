// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/seepage/flow_balance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  FlowBalance::FlowBalance(
    const FlowMesh                             &mesh,
    const std::vector<SymmetricTensor<2, dim>> &permeability,
    const std::vector<double>                  &measure,
    const FlowConditions                       &conditions)
    : conditions(conditions)
    , n(mesh.vertices.size())
    , connections(mesh.connections)
    , conductance(mesh.connections.size(), 0.)
    , diagonal(n, 0.)
  {
    double lowest = mesh.vertices[0][1], highest = lowest;
    for (const auto &x : mesh.vertices)
      {
        lowest  = std::min(lowest, x[1]);
        highest = std::max(highest, x[1]);
        y.push_back(x[1]);
      }
    height = highest - lowest;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int i = 0; i < FlowMesh::n_connections; ++i)
        conductance[mesh.connections_of_cell[c][i]] += edge_conductance(
          mesh, permeability[mesh.material[c]], measure[c], c, i);
    for (unsigned int e = 0; e < connections.size(); ++e)
      for (const unsigned int v : connections[e])
        diagonal[v] += std::abs(conductance[e]);
    set_pattern();
  }

  double
  FlowBalance::error(const std::vector<double> &r) const
  {
    double largest = 0.;
    for (unsigned int v = 0; v < n; ++v)
      {
        if (!std::isfinite(r[v] + scale[v]))
          return std::numeric_limits<double>::infinity();
        if (r[v] != 0.)
          largest = std::max(largest, std::abs(r[v]) / scale[v]);
      }
    return largest;
  }

  void
  FlowBalance::add_boundary(const std::vector<double> &s,
                            const std::vector<double> &outflow,
                            std::vector<double>       &r)
  {
    inflow.assign(n, 0.);
    for (unsigned int v = 0; v < n; ++v)
      {
        inflow[v] = conditions.kind[v] == Kind::head
                      ? -r[v]
                      : conditions.rain[v] - outflow[v];
        if (conditions.kind[v] == Kind::head)
          r[v] = diagonal[v] * (conditions.head[v] - s[v]);
        else
          {
            r[v] += inflow[v];
            scale[v] += conditions.rain[v] + outflow[v];
          }
      }
  }

  void
  FlowBalance::begin_derivative(const std::vector<double> &doutflow)
  {
    std::fill(matrix.value.begin(), matrix.value.end(), 0.);
    for (unsigned int v = 0; v < n; ++v)
      matrix.value[matrix.entry(v, v)] =
        -(conditions.kind[v] == Kind::head ? diagonal[v] : doutflow[v]);
  }

  void
  FlowBalance::set_pattern()
  {
    std::vector<std::vector<int>> columns(n);
    for (unsigned int v = 0; v < n; ++v)
      columns[v].push_back(v);
    for (const auto &[i, j] : connections)
      {
        columns[i].push_back(j);
        columns[j].push_back(i);
      }
    matrix.n_global = matrix.n_owned = n;
    for (unsigned int v = 0; v < n; ++v)
      matrix.global_index.push_back(v);
    matrix.set_pattern(std::move(columns));
  }

  double
  edge_conductance(const FlowMesh                &mesh,
                   const SymmetricTensor<2, dim> &permeability,
                   const double                   measure,
                   const unsigned int             cell,
                   const unsigned int             i)
  {
    const auto g      = mesh.gradients(cell);
    const auto [a, b] = FlowMesh::corners_of_connections()[i];
    return -mesh.cell_size(cell) * measure * (g[a] * (permeability * g[b]));
  }

  namespace
  {
    double
    norm(const std::vector<double> &r)
    {
      double sum = 0.;
      for (const double x : r)
        sum += x * x;
      return std::sqrt(sum);
    }
  } // namespace

  bool
  iterate(FlowBalance       &balance,
          LinearSolver      &solver,
          const unsigned int most_iterations,
          const double       wanted,
          FlowSolution      &flow,
          const double       smallest_step)
  {
    constexpr double accepted = 1e-10;
    auto             residual = balance.residual(flow.s);
    flow.error                = balance.error(residual);
    for (unsigned int i = 0; i < most_iterations && !(flow.error <= wanted);
         ++i)
      {
        if (!std::isfinite(flow.error) ||
            !solver.factorise(balance.derivative()))
          return false;
        ++flow.iterations;
        std::vector<double> step = residual;
        solver.solve(step);
        const double before  = norm(residual);
        bool         is_less = false;
        for (double part = 1.; !is_less && part >= smallest_step; part /= 2.)
          {
            std::vector<double> next(flow.s);
            for (unsigned int v = 0; v < next.size(); ++v)
              next[v] -= part * step[v];
            residual = balance.residual(next);
            is_less  = norm(residual) < before;
            if (is_less || part / 2. < smallest_step)
              flow.s = std::move(next);
          }
        flow.error = balance.error(residual);
        if (!is_less && flow.error <= accepted) // rounding
          return true;
      }
    return flow.error <= accepted;
  }
} // namespace geocone::GEOCONE_DIM
