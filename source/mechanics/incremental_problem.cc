// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mechanics/incremental_problem.h>
#include <geocone/mechanics/point_kernels.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone
{
  using namespace dealii;
  using namespace kernels;

  IncrementalProblem::IncrementalProblem(
    const MaterialPoints                                     &points,
    const Materials                                          &materials,
    const Constraints                                        &constraints,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
    const Vector                                             *lumped_mass)
    : points(points)
    , materials(materials)
    , constraints(constraints)
    , layout(layout)
    , mass(lumped_mass)
    , strain(points.n_points(), Mandel::Zero())
    , stress(points.n_points())
    , mode(points.n_points(), Mode::elastic)
    , previous_mode(points.n_points(), Mode::elastic)
    , tangent(points.n_points())
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      if (runs.empty() || runs.back().material != points.material[p])
        runs.push_back({p, p + 1, points.material[p]});
      else
        ++runs.back().end;
  }

  void
  IncrementalProblem::begin_step(const double  step,
                                 const double  end,
                                 const Vector *external_force,
                                 const Vector &v)
  {
    h          = step;
    t          = end;
    force      = external_force;
    velocity_L = v;
  }

  void
  IncrementalProblem::update_materials(const bool with_tangent) const
  {
    for (const Run &run : runs)
      {
        const unsigned int n = run.end - run.begin;
        const Increment    increment{
          ArrayView<const Mandel>(&strain[run.begin], n),
          ArrayView<const Mandel>(&points.stress[run.begin], n)};
        const Response response{
          ArrayView<Mandel>(&stress[run.begin], n),
          ArrayView<Mode>(&mode[run.begin], n),
          with_tangent ? ArrayView<MandelMatrix>(&tangent[run.begin], n)
                       : ArrayView<MandelMatrix>()};
        materials[run.material].update(increment, response);
      }
  }

  ResidualReport
  IncrementalProblem::residual(Vector &dst, const Vector &v)
  {
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_v[2 * n];
          gather<n>(v.begin(), &points.nodes[c * n], cell_v);
          for (unsigned int p = points.first_point[c];
               p < points.first_point[c + 1];
               ++p)
            strain[p] =
              h * kernels::strain<n>(&points.gradients[2 * n * p], cell_v);
        }
    });

    previous_mode.swap(mode);
    update_materials(false);

    dst = 0.;
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_f[2 * n] = {};
          for (unsigned int p = points.first_point[c];
               p < points.first_point[c + 1];
               ++p)
            add_force<n>(&points.gradients[2 * n * p],
                         points.weight[p] * stress[p],
                         cell_f);
          scatter_add<n>(cell_f, &points.nodes[c * n], dst.begin());
        }
    });
    dst.compress(VectorOperation::add);

    // One reduction for all sums: |B'V s|^2, |F|^2, |R_free|^2, counts.
    std::array<double, 6> sums  = {};
    const unsigned int    n_dof = dst.locally_owned_size();
    for (unsigned int i = 0; i < n_dof; ++i)
      {
        double &r = dst.local_element(i);
        sums[0] += r * r;
        if (force != nullptr)
          {
            const double f = force->local_element(i);
            sums[1] += f * f;
            r -= f;
          }
        if (mass != nullptr)
          r += mass->local_element(i) / h *
               (v.local_element(i) - velocity_L.local_element(i));
        if (constraints.is_free(i))
          sums[2] += r * r;
      }
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        sums[3] += mode[p] == Mode::cone;
        sums[4] += mode[p] == Mode::apex;
        sums[5] += mode[p] != previous_mode[p];
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        layout->get_mpi_communicator(),
                        ArrayView<double>(sums.data(), sums.size()));
    ResidualReport report;
    report.force_norm = std::max(std::sqrt(sums[0]), std::sqrt(sums[1]));
    report.norm       = std::sqrt(sums[2]);
    report.n_cone     = sums[3];
    report.n_apex     = sums[4];
    report.n_switched = sums[5];
    return report;
  }

  SparseMatrix
  IncrementalProblem::make_pattern(const bool one_triangle_)
  {
    Assert(!one_triangle_ || is_symmetric(), ExcInternalError());
    one_triangle = one_triangle_;

    const unsigned int      n      = points.n_nodes;
    const unsigned int      n_dofs = dim * n;
    const std::vector<int> &row_of = constraints.free_row;

    SparseMatrix matrix;
    matrix.comm         = layout->get_mpi_communicator();
    matrix.symmetric    = one_triangle;
    matrix.n_global     = constraints.n_rows;
    matrix.n_owned      = constraints.n_owned_rows;
    matrix.global_index = constraints.global_row;

    // Which cells a node has, then which nodes it meets there.
    const unsigned int                     n_local_nodes = row_of.size() / dim;
    std::vector<std::vector<unsigned int>> neighbours(n_local_nodes);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int i = 0; i < n; ++i)
        {
          auto &list = neighbours[points.nodes[c * n + i]];
          list.insert(
            list.end(), &points.nodes[c * n], &points.nodes[c * n] + n);
        }
    for (unsigned int node = 0; node < n_local_nodes; ++node)
      {
        auto &list = neighbours[node];
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        for (unsigned int c = 0; c < dim; ++c)
          if (row_of[dim * node + c] >= 0)
            {
              for (const unsigned int other : list)
                for (unsigned int d = 0; d < dim; ++d)
                  if (row_of[dim * other + d] >= 0 &&
                      (!one_triangle ||
                       row_of[dim * other + d] <= row_of[dim * node + c]))
                    matrix.column.push_back(row_of[dim * other + d]);
              matrix.row_start.push_back(matrix.column.size());
            }
      }
    matrix.value.assign(matrix.column.size(), 0.);

    scatter.clear();
    scatter.reserve(std::size_t(points.n_cells()) * n_dofs *
                    (one_triangle ? n_dofs + 1 : 2 * n_dofs) / 2);
    std::vector<int> rows(n_dofs);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            rows[dim * i + d] = row_of[dim * points.nodes[c * n + i] + d];
        for (unsigned int i = 0; i < n_dofs; ++i)
          for (unsigned int j = one_triangle ? i : 0; j < n_dofs; ++j)
            scatter.push_back(rows[i] < 0 || rows[j] < 0 ? -1
                              : one_triangle && rows[i] < rows[j]
                                ? matrix.entry(rows[j], rows[i])
                                : matrix.entry(rows[i], rows[j]));
      }
    diagonal.resize(matrix.n_rows());
    for (int row = 0; row < matrix.n_rows(); ++row)
      diagonal[row] = matrix.entry(row, row);
    return matrix;
  }

  void
  IncrementalProblem::linearise(SparseMatrix &matrix, const double blend) const
  {
    update_materials(true);
    std::fill(matrix.value.begin(), matrix.value.end(), 0.);
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int             n = n_constant;
      std::vector<MandelMatrix> C;
      std::vector<double>       scratch;
      double                    K[4 * n * n];
      const int                *place = scatter.data();
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const unsigned int first = points.first_point[c];
          const unsigned int n_q   = points.first_point[c + 1] - first;
          C.resize(n_q);
          scratch.resize(n_q * 6 * n);
          for (unsigned int q = 0; q < n_q; ++q)
            {
              const unsigned int p = first + q;
              C[q]                 = (h * points.weight[p]) * tangent[p];
              if (blend > 0.)
                C[q] = (1. - blend) * C[q] +
                       (blend * h * points.weight[p]) *
                         materials[points.material[p]].elasticity().stiffness();
            }
          const double *g = &points.gradients[2 * n * first];
          if (one_triangle)
            stiffness<n, true>(g, C.data(), n_q, scratch.data(), K);
          else
            stiffness<n, false>(g, C.data(), n_q, scratch.data(), K);
          for (int i = 0; i < 2 * n; ++i)
            for (int j = one_triangle ? i : 0; j < 2 * n; ++j, ++place)
              if (*place >= 0)
                matrix.value[*place] += K[2 * n * i + j];
        }
    });
    if (mass != nullptr)
      for (unsigned int i = 0; i < mass->locally_owned_size(); ++i)
        if (constraints.is_free(i))
          matrix.value[diagonal[constraints.free_row[i]]] +=
            mass->local_element(i) / h;
  }

  void
  IncrementalProblem::apply_tangent(Vector &dst, const Vector &dv) const
  {
    update_materials(true);
    dst = 0.;
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_v[2 * n], cell_f[2 * n] = {};
          gather<n>(dv.begin(), &points.nodes[c * n], cell_v);
          for (unsigned int p = points.first_point[c];
               p < points.first_point[c + 1];
               ++p)
            {
              const double *g  = &points.gradients[2 * n * p];
              const Mandel  ds = (h * points.weight[p]) *
                                (tangent[p] * kernels::strain<n>(g, cell_v));
              add_force<n>(g, ds, cell_f);
            }
          scatter_add<n>(cell_f, &points.nodes[c * n], dst.begin());
        }
    });
    dst.compress(VectorOperation::add);
    if (mass != nullptr)
      for (unsigned int i = 0; i < dst.locally_owned_size(); ++i)
        dst.local_element(i) +=
          mass->local_element(i) / h * dv.local_element(i);
  }

  double
  IncrementalProblem::free_dot(const Vector &a, const Vector &b) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
      if (constraints.is_free(i))
        sum += a.local_element(i) * b.local_element(i);
    return Utilities::MPI::sum(sum, layout->get_mpi_communicator());
  }

  Mandel
  IncrementalProblem::plastic_strain_increment(const unsigned int p) const
  {
    if (mode[p] == Mode::elastic)
      return Mandel::Zero();
    return strain[p] - materials[points.material[p]].elasticity().strain(
                         Mandel(stress[p] - points.stress[p]));
  }

  Quality
  IncrementalProblem::quality() const
  {
    // Two passes: the scales of all ranks first.
    const MPI_Comm comm     = layout->get_mpi_communicator();
    double     stress_scale = 0., k_scale = 0., y_scale = 0., compliance = 0.;
    const auto y_at = [&](const FlowCone    &cone,
                          const Elasticity  &elasticity,
                          const unsigned int p) {
      const Mandel z =
        elasticity.strain(Mandel(stress[p] - points.stress[p])) - strain[p];
      return cone.psi(to_cone_axes(z));
    };
    for (const Run &run : runs)
      if (const auto cone = materials[run.material].flow_cone())
        {
          k_scale    = std::max(k_scale, cone->k);
          compliance = std::max(
            compliance, 1. / materials[run.material].elasticity().two_G);
          for (unsigned int p = run.begin; p < run.end; ++p)
            {
              stress_scale = std::max(stress_scale, stress[p].norm());
              y_scale      = std::max(
                y_scale,
                y_at(*cone, materials[run.material].elasticity(), p).norm());
            }
        }
    stress_scale = Utilities::MPI::max(stress_scale, comm) +
                   Utilities::MPI::max(k_scale, comm);
    y_scale = std::max(Utilities::MPI::max(y_scale, comm),
                       stress_scale * Utilities::MPI::max(compliance, comm));

    Quality worst;
    for (const Run &run : runs)
      if (const auto cone = materials[run.material].flow_cone())
        for (unsigned int p = run.begin; p < run.end; ++p)
          {
            const Elasticity &elasticity = materials[run.material].elasticity();
            const Mandel      y          = y_at(*cone, elasticity, p);
            const Mandel      s          = to_cone_axes(stress[p]);
            worst.natural_map            = std::max(
              worst.natural_map,
              natural_map(*cone, s, y, elasticity.two_G).norm() / stress_scale);
            worst.cone_violation = std::max(
              worst.cone_violation, cone->yield_function(s) / stress_scale);
            if (y_scale > 0.)
              {
                worst.dual_violation = std::max(
                  worst.dual_violation, cone->dual_violation(y) / y_scale);
                worst.complementarity =
                  std::max(worst.complementarity,
                           std::abs(cone->complementarity_product(y, s)) /
                             (y_scale * stress_scale));
              }
          }
    std::array<double, 4> values = {{worst.natural_map,
                                     worst.cone_violation,
                                     worst.dual_violation,
                                     worst.complementarity}};
    Utilities::MPI::max(ArrayView<const double>(values.data(), 4),
                        comm,
                        ArrayView<double>(values.data(), 4));
    return {values[0], values[1], values[2], values[3]};
  }
} // namespace geocone
