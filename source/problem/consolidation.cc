// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/over_ranks.h>
#include <geocone/problem/consolidation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Volumetric strain of a point per displacement of a node (1/m): B' 1, with
     *  the hoop strain around an axis, and projected with B-bar. */
    inline Tensor<1, dim>
    divergence_of(const MaterialPoints &points,
                  const unsigned int    point,
                  const unsigned int    i)
    {
      const unsigned int         n        = points.n_nodes;
      const bool                 is_plain = points.volumetric_gradients.empty();
      const std::vector<double> &gradients =
        is_plain ? points.gradients : points.volumetric_gradients;
      Tensor<1, dim> g;
      for (unsigned int d = 0; d < dim; ++d)
        g[d] = gradients[n * (dim * point + d) + i];
      if (is_plain && !points.hoop.empty())
        g[0] += points.hoop[n * point + i];
      return g;
    }
  } // namespace

  Consolidation::Consolidation(
    const Materials                                          &materials,
    const MaterialPoints                                     &points,
    const Unknowns                                           &unknowns,
    PressureFunctions                                         of_cells,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
    Vector                                                   *at_vertices)
    : points(points)
    , materials(materials)
    , unknowns(unknowns)
    , turned(points, unknowns)
    , functions(std::move(of_cells))
    , at_vertices(at_vertices)
    , smoothed_n(layout)
    , trial(layout)
    , of_point(points.n_points())
    , of_point_n(points.n_points())
  {
    number_rows();
    const MPI_Comm comm = layout->get_mpi_communicator();
    solver              = Utilities::MPI::n_mpi_processes(comm) == 1
                            ? make_cholmod(LinearSolverParameters::IndexSize::automatic)
                            : make_mumps(comm, true, "");
    solver->analyse(A);
    trial.update_ghost_values();
  }

  void
  Consolidation::number_rows()
  {
    const MPI_Comm comm = trial.get_mpi_communicator();
    // Vertices of cells of any rank, then their global rows.
    Vector number(trial.get_partitioner());
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int i = 0; i < functions.n_vertices; ++i)
        number.local_element(dim * node_of(c, i)) += 1.;
    number.compress(VectorOperation::add);
    const unsigned int n_owned_nodes = number.locally_owned_size() / dim;
    A.comm                           = comm;
    A.symmetric                      = true;
    for (unsigned int node = 0; node < n_owned_nodes; ++node)
      A.n_owned += number.local_element(dim * node) > 0.;
    const std::vector<int> n_of_rank =
      Utilities::MPI::all_gather(comm, A.n_owned);
    int next = 0;
    for (unsigned int r = 0; r < n_of_rank.size(); ++r)
      {
        A.n_global += n_of_rank[r];
        if (r < Utilities::MPI::this_mpi_process(comm))
          next += n_of_rank[r];
      }
    for (unsigned int node = 0; node < n_owned_nodes; ++node)
      number.local_element(dim * node) =
        number.local_element(dim * node) > 0. ? next++ : -1;
    number.update_ghost_values();
    row.assign(functions.is_drained.size(), -1);
    int n_rows = 0;
    for (unsigned int node = 0; node < row.size(); ++node)
      if (const int global = std::lround(number.local_element(dim * node));
          global >= 0)
        {
          row[node] = n_rows++;
          A.global_index.push_back(global);
        }

    std::vector<std::vector<int>> columns(n_rows);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int i = 0; i < functions.n_vertices; ++i)
        for (unsigned int j = 0; j < functions.n_vertices; ++j)
          if (row[node_of(c, j)] <= row[node_of(c, i)])
            columns[row[node_of(c, i)]].push_back(row[node_of(c, j)]);
    for (int r = 0; r < n_rows; ++r)
      columns[r].push_back(r);
    A.set_pattern(std::move(columns));
  }

  void
  Consolidation::begin_step(const double step)
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      of_point_n[p] = points.excess_pressure(p);
    if (functions.smooths())
      {
        at_vertices->update_ghost_values();
        smoothed_n = products(functions.smoothing, *at_vertices);
        at_vertices->zero_out_ghost_values();
      }
    if (step == h)
      return;
    h = step;
    compute_coupling();
    const unsigned int n = functions.n_vertices;
    std::fill(A.value.begin(), A.value.end(), 0.);
    std::vector<double> A_cell(n * n);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n * n; ++i)
          A_cell[i] =
            h * functions.flow[n * n * c + i] +
            (functions.smooths() ? functions.smoothing[n * n * c + i] : 0.);
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            const double stored = points.weight[p] * share(p) * storage(p);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                A_cell[n * i + j] +=
                  stored * functions.N[n * p + i] * functions.N[n * p + j];
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            if (const unsigned int a = node_of(c, i), b = node_of(c, j);
                row[b] <= row[a] && !functions.is_drained[a] &&
                !functions.is_drained[b])
              A.value[A.entry(row[a], row[b])] += A_cell[n * i + j];
      }
    for (unsigned int node = 0; node < row.size(); ++node)
      if (row[node] >= 0 && row[node] < A.n_owned && functions.is_drained[node])
        A.value[A.entry(row[node], row[node])] = 1.;
    if (!solver->factorise(A))
      throw RunError(
        format("the water balance of a step of %g s is singular", h) +
        "\n  remedy:  check 'Permeability' and 'Pore fluid bulk modulus'; if no "
        "side is drained, water that does not compress has no pressure level");
  }

  std::vector<double>
  Consolidation::divergence(const Vector &v) const
  {
    std::vector<double> of_points(points.n_points());
    const unsigned int  n = points.n_nodes;
    std::vector<double> cell_v(dim * n);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            cell_v[dim * i + d] =
              v.local_element(dim * points.nodes[c * n + i] + d);
        turned.velocities_to_xy(c, cell_v.data());
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            for (unsigned int i = 0; i < n; ++i)
              {
                const Tensor<1, dim> g = divergence_of(points, p, i);
                for (unsigned int d = 0; d < dim; ++d)
                  of_points[p] += g[d] * cell_v[dim * i + d];
              }
          }
      }
    return of_points;
  }

  template <typename ValueOf>
  Vector
  Consolidation::integral(const ValueOf &f) const
  {
    Vector             sum(trial.get_partitioner());
    const unsigned int n = functions.n_vertices;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int q = points.first_point[c];
           q < points.first_point[c + 1];
           ++q)
        {
          const double weighted = points.weight[q] * f(q);
          for (unsigned int i = 0; i < n; ++i)
            sum.local_element(dim * node_of(c, i)) +=
              functions.N[n * q + i] * weighted;
        }
    sum.compress(VectorOperation::add);
    return sum;
  }

  Vector
  Consolidation::products(const std::vector<double> &matrices,
                          const Vector              &p) const
  {
    Vector             sum(trial.get_partitioner());
    const unsigned int n = functions.n_vertices;
    const double      *a = matrices.data();
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j, ++a)
          sum.local_element(dim * node_of(c, i)) +=
            *a * p.local_element(dim * node_of(c, j));
    sum.compress(VectorOperation::add);
    return sum;
  }

  double
  Consolidation::value(const Vector      &p,
                       const unsigned int cell,
                       const unsigned int point) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < functions.n_vertices; ++i)
      sum += functions.N[functions.n_vertices * point + i] *
             p.local_element(dim * node_of(cell, i));
    return sum;
  }

  Vector
  Consolidation::solve(const Vector &b) const
  {
    std::vector<double> x(A.n_owned);
    for (unsigned int node = 0; node < row.size(); ++node)
      if (row[node] >= 0 && row[node] < A.n_owned)
        x[row[node]] =
          functions.is_drained[node] ? 0. : b.local_element(dim * node);
    solver->solve(x);
    Vector result(trial.get_partitioner());
    for (unsigned int node = 0; node < row.size(); ++node)
      if (row[node] >= 0 && row[node] < A.n_owned)
        result.local_element(dim * node) = x[row[node]];
    result.update_ghost_values();
    return result;
  }

  void
  Consolidation::update(const Vector &v)
  {
    rate     = divergence(v);
    Vector b = integral([this](const unsigned int p) {
      return share(p) * (storage(p) * of_point_n[p] - h * rate[p]);
    });
    b += smoothed_n;
    trial = solve(b);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        of_point[p] =
          share(p) * value(trial, c, p) +
          fluid_modulus(p) * (storage(p) * of_point_n[p] - h * rate[p]);
  }

  void
  Consolidation::compute_coupling()
  {
    const unsigned int n = points.n_nodes;
    coupling.assign(points.n_cells() * functions.n_vertices * dim * n, 0.);
    double *column = coupling.data();
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int j = 0; j < functions.n_vertices; ++j, column += dim * n)
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            const double weight = points.weight[p] * share(p) *
                                  functions.N[functions.n_vertices * p + j];
            for (unsigned int i = 0; i < n; ++i)
              {
                const Tensor<1, dim> g = divergence_of(points, p, i);
                for (unsigned int d = 0; d < dim; ++d)
                  column[dim * i + d] += weight * g[d];
              }
          }
  }

  std::vector<double>
  Consolidation::coupling_of_cell(const unsigned int c) const
  {
    const unsigned int  n_dofs = dim * points.n_nodes;
    const double *const first  = &coupling[c * functions.n_vertices * n_dofs];
    std::vector<double> G(first, first + functions.n_vertices * n_dofs);
    for (unsigned int j = 0; j < functions.n_vertices; ++j)
      turned.forces_to_dofs(c, &G[j * n_dofs]);
    return G;
  }

  void
  Consolidation::add_tangent(Vector &dst, const Vector &dv) const
  {
    const std::vector<double> rates = divergence(dv);
    const Vector change = solve(integral([&](const unsigned int p) { // -dP/h
      return share(p) * rates[p];
    }));
    Vector              part(trial.get_partitioner());
    const unsigned int  n_dofs = dim * points.n_nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const std::vector<double> G = coupling_of_cell(c);
        for (unsigned int i = 0; i < n_dofs; ++i)
          for (unsigned int j = 0; j < functions.n_vertices; ++j)
            part.local_element(
              dim * points.nodes[c * points.n_nodes + i / dim] + i % dim) +=
              h * G[n_dofs * j + i] * change.local_element(dim * node_of(c, j));
      }
    part.compress(VectorOperation::add);
    dst += part;
  }

  SparseMatrix
  Consolidation::make_pattern(const SparseMatrix &K)
  {
    // Owned rows of velocities and pressures come first, on each rank.
    const int n_K = K.n_rows(), n_A = A.n_rows();
    row_of_velocity.resize(n_K);
    row_of_pressure.resize(n_A);
    for (int r = 0; r < n_K; ++r)
      row_of_velocity[r] = r < K.n_owned ? r : r + A.n_owned;
    for (int r = 0; r < n_A; ++r)
      row_of_pressure[r] = r < A.n_owned ? K.n_owned + r : n_K + r;

    SparseMatrix matrix;
    matrix.comm     = K.comm;
    matrix.n_global = K.n_global + A.n_global;
    matrix.n_owned  = K.n_owned + A.n_owned;
    matrix.global_index.resize(n_K + n_A);
    const auto owned = Utilities::MPI::all_gather(
      K.comm, std::array<int, 2>{{K.n_owned, A.n_owned}});
    // Rows of the other kind that precede a row in the coupled system.
    const auto preceding = [&](const int row, const unsigned int kind) {
      int begin = 0, others = 0;
      for (const auto &n : owned)
        {
          if (row < begin + n[kind])
            return others + (kind == 1 ? n[0] : 0);
          begin += n[kind];
          others += n[1 - kind];
        }
      return others;
    };
    for (int r = 0; r < n_K; ++r)
      matrix.global_index[row_of_velocity[r]] =
        K.global_index[r] + preceding(K.global_index[r], 0);
    for (int r = 0; r < n_A; ++r)
      matrix.global_index[row_of_pressure[r]] =
        A.global_index[r] + preceding(A.global_index[r], 1);

    std::vector<std::vector<int>> columns(n_K + n_A);
    for (int r = 0; r < n_K; ++r)
      for (int e = K.row_start[r]; e < K.row_start[r + 1]; ++e)
        columns[row_of_velocity[r]].push_back(
          row_of_velocity[K.column_of(r, e)]);
    for (int r = 0; r < n_A; ++r)
      for (int e = A.row_start[r]; e < A.row_start[r + 1]; ++e)
        {
          const int a = row_of_pressure[r], b = row_of_pressure[A.column[e]];
          columns[a].push_back(b);
          columns[b].push_back(a);
        }
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int i = 0; i < dim * points.n_nodes; ++i)
        if (const int velocity = row_of_dof(c, i); velocity >= 0)
          for (unsigned int j = 0; j < functions.n_vertices; ++j)
            {
              const int p = row_of_pressure[row[node_of(c, j)]];
              columns[velocity].push_back(p);
              columns[p].push_back(velocity);
            }
    matrix.set_pattern(std::move(columns));
    return matrix;
  }

  int
  Consolidation::row_of_dof(const unsigned int cell, const unsigned int i) const
  {
    const int free =
      unknowns.free_row[dim * points.nodes[cell * points.n_nodes + i / dim] +
                        i % dim];
    return free < 0 ? -1 : row_of_velocity[free];
  }

  void
  Consolidation::assemble(const SparseMatrix &K, SparseMatrix &matrix) const
  {
    std::fill(matrix.value.begin(), matrix.value.end(), 0.);
    for (int r = 0; r < K.n_rows(); ++r)
      for (int e = K.row_start[r]; e < K.row_start[r + 1]; ++e)
        matrix.value[matrix.entry(
          row_of_velocity[r], row_of_velocity[K.column_of(r, e)])] = K.value[e];
    for (int r = 0; r < A.n_rows(); ++r)
      for (int e = A.row_start[r]; e < A.row_start[r + 1]; ++e)
        {
          const int a = row_of_pressure[r], b = row_of_pressure[A.column[e]];
          matrix.value[matrix.entry(a, b)] -= A.value[e] / h;
          if (a != b)
            matrix.value[matrix.entry(b, a)] -= A.value[e] / h;
        }
    const unsigned int n_dofs = dim * points.n_nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const std::vector<double> G = coupling_of_cell(c);
        for (unsigned int i = 0; i < n_dofs; ++i)
          if (const int velocity = row_of_dof(c, i); velocity >= 0)
            for (unsigned int j = 0; j < functions.n_vertices; ++j)
              if (const unsigned int node = node_of(c, j);
                  !functions.is_drained[node])
                {
                  const int    p = row_of_pressure[row[node]];
                  const double g = G[n_dofs * j + i];
                  matrix.value[matrix.entry(velocity, p)] -= g;
                  matrix.value[matrix.entry(p, velocity)] -= g;
                }
      }
  }

  WaterBalance
  Consolidation::commit()
  {
    const Vector change = integral([this](const unsigned int p) {
      return storage(p) * (of_point[p] - of_point_n[p]);
    });
    const Vector inflow =
      integral([this](const unsigned int p) { return h * rate[p]; });
    Vector seepage = products(functions.flow, trial);
    seepage *= h;
    if (functions.smooths())
      {
        seepage += products(functions.smoothing, trial);
        seepage -= smoothed_n;
      }
    // Sums of the balance: all terms, the outflow, sizes, and the dissipation.
    std::array<double, 4> sums = {};
    for (unsigned int node = 0; node < row.size(); ++node)
      if (row[node] >= 0 && row[node] < A.n_owned)
        {
          const unsigned int dof    = dim * node;
          const double       stored = change.local_element(dof),
                       volume       = inflow.local_element(dof),
                       leaves       = seepage.local_element(dof);
          sums[0] += stored + volume;
          sums[1] += functions.is_drained[node] ? stored + volume : -leaves;
          sums[2] += std::abs(stored) + std::abs(volume);
          sums[3] += trial.local_element(dof) * leaves;
        }
    if (has_local())
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          sums[3] += points.weight[p] * h * functions.leakage[p] *
                     std::pow(of_point[p] - value(trial, c, p), 2);
    sum_over_ranks(sums, trial.get_mpi_communicator());
    if (at_vertices != nullptr)
      for (unsigned int i = 0; i < trial.locally_owned_size(); ++i)
        at_vertices->local_element(i) = trial.local_element(i);
    return {-sums[1] / h,
            std::abs(sums[0] - sums[1]) /
              std::max(sums[2], std::numeric_limits<double>::min()),
            sums[3]};
  }
} // namespace geocone::GEOCONE_DIM
