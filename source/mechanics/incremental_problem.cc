// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
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
    const Unknowns                                           &unknowns,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
    const Vector                                             *lumped_mass,
    const double                                              consistent_part)
    : points(points)
    , materials(materials)
    , unknowns(unknowns)
    , layout(layout)
    , mass(lumped_mass)
    , consistent_part(consistent_part)
    , strain(points.n_points(), Mandel::Zero())
    , stress(points.n_points())
    , mode(points.n_points(), Mode::elastic)
    , previous_mode(points.n_points(), Mode::elastic)
    , tangent(points.n_points())
    , turned(points, unknowns)
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      if (runs.empty() || runs.back().material != points.material[p])
        runs.push_back({p, p + 1, points.material[p]});
      else
        ++runs.back().end;
  }

  void
  IncrementalProblem::begin_step(const double  step,
                                 const Vector *external_force,
                                 const Vector &v,
                                 const Vector &prescribed_velocity)
  {
    h          = step;
    law        = LocalLaw();
    force      = external_force;
    velocity_L = v;
    prescribed = prescribed_velocity;
    elastic_diagonal.reinit(0);
    row_factors = Multipliers::Factors();
    if (consistent_part > 0.)
      {
        velocity_L.update_ghost_values();
        inertia.reinit(layout);
      }
  }

  void
  IncrementalProblem::set_prescribed(Vector &v) const
  {
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      if (unknowns.is_prescribed(i))
        v.local_element(i) = prescribed.local_element(i);
  }

  template <int n>
  void
  IncrementalProblem::strains_of_cell(const unsigned int   c,
                                      const double        *cell_v,
                                      const double         factor,
                                      std::vector<Mandel> &result) const
  {
    const unsigned int begin = points.first_point[c],
                       end   = points.first_point[c + 1];
    for (unsigned int p = begin; p < end; ++p)
      result[p] =
        factor * kernels::strain<n>(&points.gradients[2 * n * p], cell_v);
    if (points.mean_gradients.empty())
      return;
    const Mandel mean =
      factor * kernels::strain<n>(&points.mean_gradients[2 * n * c], cell_v);
    for (unsigned int p = begin; p < end; ++p)
      result[p].head<2>().array() +=
        (mean[0] + mean[1] - result[p][0] - result[p][1]) / 2.;
  }

  template <int n, typename WeightedStress>
  void
  IncrementalProblem::add_forces_of_cell(const unsigned int    c,
                                         const WeightedStress &weighted_stress,
                                         double               *cell_f) const
  {
    const unsigned int begin = points.first_point[c],
                       end   = points.first_point[c + 1];
    if (points.mean_gradients.empty())
      {
        for (unsigned int p = begin; p < end; ++p)
          add_force<n>(
            &points.gradients[2 * n * p], weighted_stress(p), cell_f);
        return;
      }
    double volumetric = 0.;
    for (unsigned int p = begin; p < end; ++p)
      {
        Mandel       s    = weighted_stress(p);
        const double mean = (s[0] + s[1]) / 2.;
        s.head<2>().array() -= mean;
        volumetric += mean;
        add_force<n>(&points.gradients[2 * n * p], s, cell_f);
      }
    add_force<n>(&points.mean_gradients[2 * n * c],
                 Mandel(volumetric, volumetric, 0.),
                 cell_f);
  }

  void
  IncrementalProblem::update_materials(const bool with_tangent) const
  {
    for (const Run &run : runs)
      {
        const unsigned int n = run.end - run.begin;
        Response           response;
        response.stress = ArrayView<Mandel>(&stress[run.begin], n);
        response.mode   = ArrayView<Mode>(&mode[run.begin], n);
        if (with_tangent)
          response.tangent = ArrayView<MandelMatrix>(&tangent[run.begin], n);
        materials[run.material].update(increment_of(run), response);
      }
  }

  Increment
  IncrementalProblem::increment_of(const Run &run) const
  {
    const unsigned int n = run.end - run.begin;
    Increment          increment;
    increment.strain    = ArrayView<const Mandel>(&strain[run.begin], n);
    increment.stress_n  = ArrayView<const Mandel>(&points.stress[run.begin], n);
    increment.history_n = points.history_of(run.begin);
    increment.n_history = points.n_history;
    increment.friction_lag = law.friction_lag;
    return increment;
  }

  std::vector<double>
  IncrementalProblem::trial_history() const
  {
    std::vector<double> history = points.history;
    std::vector<Mandel> stresses;
    std::vector<Mode>   modes;
    for (const Run &run : runs)
      if (materials[run.material].hardens())
        {
          const unsigned int n = run.end - run.begin;
          stresses.resize(n);
          modes.resize(n);
          Response response;
          response.stress  = ArrayView<Mandel>(stresses.data(), n);
          response.mode    = ArrayView<Mode>(modes.data(), n);
          response.history = history.data() + points.n_history * run.begin;
          materials[run.material].update(increment_of(run), response);
        }
    return history;
  }

  ResidualReport
  IncrementalProblem::residual(Vector         &dst,
                               const Vector   &v,
                               const LocalLaw &local_law)
  {
    law = local_law;
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_v[2 * n];
          gather<n>(v.begin(), &points.nodes[c * n], cell_v);
          turned.velocities_to_xy(c, cell_v);
          strains_of_cell<n>(c, cell_v, h, strain);
        }
    });

    previous_mode.swap(mode);
    NaturalMap::Error error;
    if (law.natural_map != nullptr)
      {
        error   = law.natural_map->update(strain, mode);
        stress  = law.natural_map->stress();
        tangent = law.natural_map->tangent();
      }
    else
      update_materials(false);

    dst = 0.;
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_f[2 * n] = {};
          add_forces_of_cell<n>(
            c,
            [&](const unsigned int p) -> Mandel {
              return points.weight[p] * stress[p];
            },
            cell_f);
          turned.forces_to_dofs(c, cell_f);
          scatter_add<n>(cell_f, &points.nodes[c * n], dst.begin());
        }
    });
    dst.compress(VectorOperation::add);

    if (consistent_part > 0.)
      {
        Vector change = v;
        change -= velocity_L;
        change.update_ghost_values();
        apply_mass(inertia, change);
      }

    // One reduction for all sums: the squared norms of B'V s, F, M (v - vL)/h,
    // M vL/h and R on the free dofs, and counts.
    std::array<double, 8> sums  = {};
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
          {
            const double m  = mass->local_element(i) / h;
            const double vL = velocity_L.local_element(i);
            const double f  = consistent_part > 0.
                                ? inertia.local_element(i) / h
                                : m * (v.local_element(i) - vL);
            r += f;
            sums[2] += f * f;
            sums[3] += m * m * vL * vL;
          }
        if (unknowns.is_free(i))
          sums[4] += r * r;
      }
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        sums[5] += mode[p] == Mode::cone;
        sums[6] += mode[p] == Mode::apex;
        sums[7] += mode[p] != previous_mode[p];
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        layout->get_mpi_communicator(),
                        ArrayView<double>(sums.data(), sums.size()));
    if (unknowns.multipliers.n_rows() > 0)
      {
        if (row_factors.U.size() == 0)
          row_factors = unknowns.multipliers.factorise(&scale());
        lambda  = unknowns.multipliers.remove(dst, row_factors);
        sums[4] = free_dot(dst, dst);
      }
    ResidualReport report;
    // The momentum itself counts little: a body in free flight has nothing else.
    report.force_norm =
      std::sqrt(std::max({sums[0], sums[1], sums[2], 1e-6 * sums[3]}));
    report.norm       = std::sqrt(sums[4]);
    report.n_cone     = sums[5];
    report.n_apex     = sums[6];
    report.n_switched = sums[7];
    if (law.natural_map != nullptr)
      {
        const MPI_Comm comm  = layout->get_mpi_communicator();
        const double   scale = Utilities::MPI::max(error.stress_scale, comm);
        report.natural_map =
          Utilities::MPI::max(error.largest_residual, comm) /
          std::max(scale, std::numeric_limits<double>::min());
      }
    return report;
  }

  void
  IncrementalProblem::apply_mass(Vector &dst, const Vector &x) const
  {
    dst = 0.;
    if (consistent_part > 0.)
      {
        with_n_nodes(points.n_nodes, [&](const auto n_constant) {
          constexpr int n = n_constant;
          for (unsigned int c = 0; c < points.n_cells(); ++c)
            {
              double cell_x[2 * n], cell_f[2 * n] = {};
              gather<n>(x.begin(), &points.nodes[c * n], cell_x);
              for (unsigned int p = points.first_point[c];
                   p < points.first_point[c + 1];
                   ++p)
                {
                  const double *N  = &points.values[n * p];
                  double        ax = 0., ay = 0.;
                  for (int i = 0; i < n; ++i)
                    {
                      ax += N[i] * cell_x[2 * i];
                      ay += N[i] * cell_x[2 * i + 1];
                    }
                  const double m = consistent_part * points.mass[p];
                  for (int i = 0; i < n; ++i)
                    {
                      cell_f[2 * i] += m * N[i] * ax;
                      cell_f[2 * i + 1] += m * N[i] * ay;
                    }
                }
              scatter_add<n>(cell_f, &points.nodes[c * n], dst.begin());
            }
        });
        dst.compress(VectorOperation::add);
      }
    for (unsigned int i = 0; i < dst.locally_owned_size(); ++i)
      dst.local_element(i) +=
        (1. - consistent_part) * mass->local_element(i) * x.local_element(i);
  }

  const Vector &
  IncrementalProblem::scale()
  {
    if (elastic_diagonal.size() > 0)
      return elastic_diagonal;
    elastic_diagonal.reinit(layout);
    const unsigned int n = points.n_nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          const Elasticity &e      = materials[points.material[p]].elasticity();
          const double      direct = e.lambda + e.two_G, shear = e.two_G / 2.;
          const double      factor = h * points.weight[p];
          for (unsigned int i = 0; i < n; ++i)
            {
              double g[dim] = {points.gradients[2 * n * p + i],
                               points.gradients[2 * n * p + n + i]};
              if (const TurnedDofs::Turn *turn = turned.turn_of(c, i))
                {
                  const double gx = g[0], gy = g[1];
                  g[0] = turn->n_x * gx + turn->n_y * gy;
                  g[1] = turn->n_x * gy - turn->n_y * gx;
                }
              const unsigned int dof = dim * points.nodes[c * n + i];
              elastic_diagonal.local_element(dof) +=
                factor * (direct * g[0] * g[0] + shear * g[1] * g[1]);
              elastic_diagonal.local_element(dof + 1) +=
                factor * (direct * g[1] * g[1] + shear * g[0] * g[0]);
            }
        }
    elastic_diagonal.compress(VectorOperation::add);
    if (mass != nullptr)
      elastic_diagonal.add(1. / h, *mass);
    return elastic_diagonal;
  }

  double
  IncrementalProblem::rounding_floor(const Vector &v) const
  {
    double              sum = 0.;
    const unsigned int  n   = points.n_nodes;
    std::vector<double> speed(n);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int dof = dim * points.nodes[c * n + i];
            speed[i] =
              std::hypot(v.local_element(dof), v.local_element(dof + 1));
          }
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            const double *gx = &points.gradients[2 * n * p], *gy = gx + n;
            double        terms = 0., squares = 0.;
            for (unsigned int i = 0; i < n; ++i)
              {
                const double square = gx[i] * gx[i] + gy[i] * gy[i];
                squares += square;
                terms += std::sqrt(square) * speed[i];
              }
            const double stress =
              materials[points.material[p]].elasticity().normal_stiffness() *
              h * terms;
            sum += squares * std::pow(points.weight[p] * stress, 2);
          }
      }
    return std::numeric_limits<double>::epsilon() *
           std::sqrt(Utilities::MPI::sum(sum, layout->get_mpi_communicator()));
  }

  double
  IncrementalProblem::merit(const Vector &residual)
  {
    const Vector &D   = scale();
    double        sum = 0.;
    for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
        sum += residual.local_element(i) * residual.local_element(i) /
               D.local_element(i);
    return Utilities::MPI::sum(sum, layout->get_mpi_communicator());
  }

  SparseMatrix
  IncrementalProblem::make_pattern(const bool one_triangle_)
  {
    Assert(!one_triangle_ || is_symmetric(), ExcInternalError());
    one_triangle = one_triangle_;

    const unsigned int      n      = points.n_nodes;
    const unsigned int      n_dofs = dim * n;
    const std::vector<int> &row_of = unknowns.free_row;

    SparseMatrix matrix;
    matrix.comm         = layout->get_mpi_communicator();
    matrix.symmetric    = one_triangle;
    matrix.n_global     = unknowns.n_rows;
    matrix.n_owned      = unknowns.n_owned_rows;
    matrix.global_index = unknowns.global_row;

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
        // Of an owned node all points may be on other ranks.
        list.push_back(node);
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

    // The columns of a node's components stand side by side: one search finds
    // both.
    scatter.clear();
    scatter.reserve(std::size_t(points.n_cells()) * n_dofs *
                    (one_triangle ? n_dofs + 1 : 2 * n_dofs) / 2);
    std::vector<int> rows(n_dofs);
    const auto place_of = [&](const unsigned int i, const unsigned int j) {
      return rows[i] < 0 || rows[j] < 0 ? -1
             : one_triangle && rows[i] < rows[j]
               ? matrix.entry(rows[j], rows[i])
               : matrix.entry(rows[i], rows[j]);
    };
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            rows[dim * i + d] = row_of[dim * points.nodes[c * n + i] + d];
        for (unsigned int i = 0; i < n_dofs; ++i)
          for (unsigned int j = one_triangle ? i : 0; j < n_dofs; ++j)
            {
              const bool second =
                j % dim == 1 && rows[i] >= 0 && rows[j - 1] >= 0 &&
                rows[j] >= 0 && (!one_triangle || (j > i && rows[j] < rows[i]));
              scatter.push_back(second ? scatter.back() + 1 : place_of(i, j));
            }
      }
    diagonal.resize(matrix.n_rows());
    for (int row = 0; row < matrix.n_rows(); ++row)
      diagonal[row] = matrix.entry(row, row);
    return matrix;
  }

  void
  IncrementalProblem::linearise(SparseMatrix &matrix, const double blend) const
  {
    update_tangents();
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
          if (!points.mean_gradients.empty())
            stiffness_b_bar<n>(
              g, &points.mean_gradients[2 * n * c], C.data(), n_q, K);
          else if (one_triangle)
            stiffness<n, true>(g, C.data(), n_q, scratch.data(), K);
          else
            stiffness<n, false>(g, C.data(), n_q, scratch.data(), K);
          if (consistent_part > 0.)
            for (unsigned int q = 0; q < n_q; ++q)
              {
                const double *N = &points.values[n * (first + q)];
                const double  m = consistent_part * points.mass[first + q] / h;
                for (int i = 0; i < n; ++i)
                  for (int j = 0; j < n; ++j)
                    for (int d = 0; d < 2; ++d)
                      K[2 * n * (2 * i + d) + 2 * j + d] += m * N[i] * N[j];
              }
          turned.matrix_to_dofs(c, 2 * n, one_triangle, K);
          for (int i = 0; i < 2 * n; ++i)
            for (int j = one_triangle ? i : 0; j < 2 * n; ++j, ++place)
              if (*place >= 0)
                matrix.value[*place] += K[2 * n * i + j];
        }
    });
    if (mass != nullptr)
      for (unsigned int i = 0; i < mass->locally_owned_size(); ++i)
        if (unknowns.is_free(i))
          matrix.value[diagonal[unknowns.free_row[i]]] +=
            (1. - consistent_part) * mass->local_element(i) / h;
  }

  void
  IncrementalProblem::apply_tangent(Vector &dst, const Vector &dv) const
  {
    update_tangents();
    Vector change;
    if (mass != nullptr)
      {
        change.reinit(layout);
        apply_mass(change, dv);
      }
    dst = 0.;
    std::vector<Mandel> rate(points.n_points());
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_v[2 * n], cell_f[2 * n] = {};
          gather<n>(dv.begin(), &points.nodes[c * n], cell_v);
          turned.velocities_to_xy(c, cell_v);
          strains_of_cell<n>(c, cell_v, h, rate);
          add_forces_of_cell<n>(
            c,
            [&](const unsigned int p) -> Mandel {
              return points.weight[p] * (tangent[p] * rate[p]);
            },
            cell_f);
          turned.forces_to_dofs(c, cell_f);
          scatter_add<n>(cell_f, &points.nodes[c * n], dst.begin());
        }
    });
    dst.compress(VectorOperation::add);
    if (mass != nullptr)
      dst.add(1. / h, change);
  }

  void
  IncrementalProblem::for_each_strain_column(
    const std::function<
      void(const unsigned int, const unsigned int, const Mandel &)> &f) const
  {
    std::vector<Mandel> column(points.n_points());
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (int j = 0; j < 2 * n; ++j)
          {
            double cell_v[2 * n] = {};
            cell_v[j]            = 1.;
            turned.velocities_to_xy(c, cell_v);
            strains_of_cell<n>(c, cell_v, 1., column);
            for (unsigned int p = points.first_point[c];
                 p < points.first_point[c + 1];
                 ++p)
              f(p, dim * points.nodes[c * n + j / dim] + j % dim, column[p]);
          }
    });
  }

  double
  IncrementalProblem::free_dot(const Vector &a, const Vector &b) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
      if (unknowns.is_free(i))
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
} // namespace geocone
