// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/conditions/vector_at.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/terms/internal_forces.h>
#include <geocone/terms/point_kernels.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;
  using namespace kernels;

  InternalForces::InternalForces(const MaterialPoints &points,
                                 const Materials      &materials,
                                 const Unknowns       &unknowns,
                                 const MPI_Comm        comm)
    : points(points)
    , materials(materials)
    , comm(comm)
    , turned(points, unknowns)
    , strain(points.n_points(), Mandel::Zero())
    , stress(points.n_points())
    , mode(points.n_points(), Mode::elastic)
    , previous_mode(points.n_points(), Mode::elastic)
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      if (runs.empty() || runs.back().material != points.material[p])
        runs.push_back({p, p + 1, points.material[p]});
      else
        ++runs.back().end;
    if (CellPressures::are_those_of(points, materials))
      {
        cell_pressures.emplace(points, materials);
        tangent.resize(points.n_points());
      }
    if (dim == 2 && materials.traits().spatial)
      stress_zz.resize(points.n_points());
    if (is_axisymmetric())
      {
        strain_zz.resize(points.n_points());
        tangent_zz.resize(points.n_points());
      }
    if (materials.traits().undrained)
      {
        pressure.resize(points.n_points());
        total.resize(points.n_points());
      }
  }

  void
  InternalForces::begin_step(const double step)
  {
    h            = step;
    friction_lag = 0.;
    natural_map  = nullptr;
    if (cell_pressures)
      cell_pressures->begin_step();
  }

  template <int n>
  void
  InternalForces::strains_of_cell(const unsigned int   c,
                                  const double        *cell_v,
                                  const double         factor,
                                  std::vector<Mandel> &result,
                                  std::vector<double> &result_zz) const
  {
    const unsigned int begin = points.first_point[c],
                       end   = points.first_point[c + 1];
    for (unsigned int p = begin; p < end; ++p)
      result[p] =
        factor * kernels::strain<n>(&points.gradients[dim * n * p], cell_v);
    if (is_axisymmetric())
      for (unsigned int p = begin; p < end; ++p)
        {
          double rate = 0.;
          for (int i = 0; i < n; ++i)
            rate += points.hoop[n * p + i] * cell_v[2 * i];
          result_zz[p] = factor * rate;
        }
    if (points.volumetric_gradients.empty())
      return;
    for (unsigned int p = begin; p < end; ++p)
      {
        const double volumetric =
          factor * trace(kernels::strain<n>(
                     &points.volumetric_gradients[dim * n * p], cell_v));
        const double hoop = is_axisymmetric() ? result_zz[p] : 0.;
        result[p] += ((volumetric - trace(result[p]) - hoop) / dim) *
                     unit_tensor<n_mandel>();
      }
  }

  template <int n, typename WeightedStress, typename WeightedHoopStress>
  void
  InternalForces::add_forces_of_cell(
    const unsigned int        c,
    const WeightedStress     &weighted_stress,
    const WeightedHoopStress &weighted_hoop_stress,
    double                   *cell_f) const
  {
    const unsigned int begin = points.first_point[c],
                       end   = points.first_point[c + 1];
    const bool b_bar         = !points.volumetric_gradients.empty();
    for (unsigned int p = begin; p < end; ++p)
      {
        Mandel s    = weighted_stress(p);
        double mean = 0.;
        if (b_bar)
          {
            mean = trace(s) / dim;
            s -= mean * unit_tensor<n_mandel>();
          }
        add_force<n>(&points.gradients[dim * n * p], s, cell_f);
        if (b_bar)
          add_force<n>(&points.volumetric_gradients[dim * n * p],
                       mean * unit_tensor<n_mandel>(),
                       cell_f);
        if (is_axisymmetric())
          {
            const double hoop = weighted_hoop_stress(p) - mean;
            for (int i = 0; i < n; ++i)
              cell_f[2 * i] += points.hoop[n * p + i] * hoop;
          }
      }
  }

  OutOfPlaneTangent
  InternalForces::tangent_zz_of(const unsigned int p, const double blend) const
  {
    OutOfPlaneTangent C       = tangent_zz[p];
    const Elasticity  elastic = elasticity_at_start(materials, points, p);
    const double      fluid   = fluid_modulus(p);
    C.by_zz *= 1. - blend;
    C.of_zz *= 1. - blend;
    for (unsigned int d = 0; d < dim; ++d)
      {
        C.by_zz[d] += blend * elastic.lambda + fluid;
        C.of_zz[d] += blend * elastic.lambda + fluid;
      }
    C.zz =
      (1. - blend) * C.zz + blend * (elastic.lambda + elastic.two_G) + fluid;
    const double factor = h * points.weight[p];
    C.by_zz *= factor;
    C.of_zz *= factor;
    C.zz *= factor;
    return C;
  }

  template <int n>
  void
  InternalForces::add_hoop_stiffness(const unsigned int       p,
                                     const OutOfPlaneTangent &C,
                                     double                  *K) const
  {
    constexpr int m = dim * n;
    // Adds forces B' by_zz along the columns of the hoop strain, and likewise
    // its rows.
    double column[m] = {}, row[m] = {};
    add_force<n>(&points.gradients[m * p], C.by_zz, column);
    add_force<n>(&points.gradients[m * p], C.of_zz, row);
    const double *const H = &points.hoop[n * p];
    if (!points.volumetric_gradients.empty())
      {
        double change[m];
        volumetric_change<n>(&points.gradients[m * p],
                             H,
                             &points.volumetric_gradients[m * p],
                             change);
        for (int i = 0; i < m; ++i)
          {
            column[i] += trace(C.by_zz) / dim * change[i];
            row[i] += trace(C.of_zz) / dim * change[i];
          }
      }
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j)
        {
          K[m * i + 2 * j] += column[i] * H[j];
          K[m * 2 * j + i] += H[j] * row[i];
        }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        K[m * 2 * i + 2 * j] += C.zz * H[i] * H[j];
  }

  template <int n>
  void
  InternalForces::add_pressure_stiffness(
    const unsigned int              c,
    const CellPressures::Condensed &condensed,
    double                         *K) const
  {
    constexpr int      m     = dim * n;
    const unsigned int first = points.first_point[c];
    using Columns =
      Eigen::Matrix<double, m, Eigen::Dynamic, 0, m, CellPressures::most_modes>;
    const auto forces_of = [&](const std::vector<Mandel> &stress,
                               const std::vector<double> &stress_zz) {
      Columns f = Columns::Zero(m, points.n_volumetric_modes);
      for (unsigned int j = 0; j < points.n_volumetric_modes; ++j)
        add_forces_of_cell<n>(
          c,
          [&](const unsigned int p) -> Mandel {
            return condensed.basis.modes(p - first, j) * stress[p - first];
          },
          [&](const unsigned int p) {
            return condensed.basis.modes(p - first, j) * stress_zz[p - first];
          },
          f.col(j).data());
      return f;
    };
    const Columns left = forces_of(condensed.left, condensed.left_zz),
                  right =
                    condensed.basis.compliance
                      .solve(forces_of(condensed.right, condensed.right_zz)
                               .transpose())
                      .transpose();
    for (int i = 0; i < m; ++i)
      for (unsigned int k = 0; k < points.n_volumetric_modes; ++k)
        for (int j = 0; j < m; ++j)
          K[m * i + j] += left(i, k) * right(j, k);
  }

  void
  InternalForces::update_materials(const unsigned int begin,
                                   const unsigned int end,
                                   MandelMatrix      *tangents) const
  {
    auto run =
      std::partition_point(runs.begin(), runs.end(), [begin](const Run &run) {
        return run.end <= begin;
      });
    for (; run != runs.end() && run->begin < end; ++run)
      {
        const Run part{
          std::max(run->begin, begin), std::min(run->end, end), run->material};
        const unsigned int n = part.end - part.begin;
        Response           response;
        response.stress = ArrayView<Mandel>(&stress[part.begin], n);
        response.mode   = ArrayView<Mode>(&mode[part.begin], n);
        if (tangents != nullptr)
          response.tangent =
            ArrayView<MandelMatrix>(tangents + (part.begin - begin), n);
        if (!stress_zz.empty())
          response.stress_zz = &stress_zz[part.begin];
        if (!tangent_zz.empty())
          response.tangent_zz = &tangent_zz[part.begin];
        materials[part.material].update(increment_of(part), response);
      }
  }

  const MandelMatrix *
  InternalForces::TangentsByCell::of_cell(const unsigned int c)
  {
    constexpr unsigned int           n_cells = 64; // computed at once
    const std::vector<unsigned int> &first   = forces.points.first_point;
    if (forces.cell_pressures)
      return &forces.tangent[first[c]];
    if (first[c + 1] > end)
      {
        begin = first[c];
        end   = first[std::min(c + n_cells, forces.points.n_cells())];
        computed.resize(end - begin);
        if (forces.natural_map != nullptr)
          forces.natural_map->copy_tangents(begin, end, computed.data());
        else
          forces.update_materials(begin, end, computed.data());
      }
    return computed.data() + (first[c] - begin);
  }

  Increment
  InternalForces::increment_of(const Run &run) const
  {
    const unsigned int n = run.end - run.begin;
    Increment          increment;
    increment.strain    = ArrayView<const Mandel>(&strain[run.begin], n);
    increment.stress_n  = ArrayView<const Mandel>(&points.stress[run.begin], n);
    increment.history_n = points.history_of(run.begin);
    increment.n_history = points.n_history();
    increment.step      = step_law();
    if (!strain_zz.empty())
      increment.strain_zz = &strain_zz[run.begin];
    return increment;
  }

  std::vector<double>
  InternalForces::trial_history() const
  {
    std::vector<double> history = points.history;
    std::vector<Mandel> stresses;
    std::vector<Mode>   modes;
    for (const Run &run : runs)
      if (materials[run.material].has_history())
        {
          const unsigned int n = run.end - run.begin;
          stresses.resize(n);
          modes.resize(n);
          Response response;
          response.stress  = ArrayView<Mandel>(stresses.data(), n);
          response.mode    = ArrayView<Mode>(modes.data(), n);
          response.history = history.data() + points.n_history() * run.begin;
          materials[run.material].update(increment_of(run), response);
        }
    for (unsigned int p = 0; p < pressure.size(); ++p)
      history[points.n_history() * (p + 1) - 1] = pressure[p];
    return history;
  }

  void
  InternalForces::update_pressures()
  {
    for (unsigned int p = 0; p < pressure.size(); ++p)
      {
        pressure[p] = flow != nullptr
                        ? flow->at(p)
                        : points.excess_pressure(p) -
                            fluid_modulus(p) * trace(whole_strain(p));
        total[p]    = stress[p] - pressure[p] * unit_tensor<n_mandel>();
      }
  }

  void
  InternalForces::residual(Vector &part, const Vector &v, const LocalLaw &law)
  {
    friction_lag = law.friction_lag;
    natural_map  = law.natural_map;
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_v[dim * n];
          gather<n>(v.begin(), &points.nodes[c * n], cell_v);
          turned.velocities_to_xy(c, cell_v);
          strains_of_cell<n>(c, cell_v, h, strain, strain_zz);
        }
    });

    previous_mode.swap(mode);
    map_error = NaturalMap::Error();
    if (natural_map != nullptr)
      {
        map_error = law.natural_map->update(strain, mode);
        stress    = natural_map->stress();
      }
    else if (cell_pressures)
      cell_pressures->equalise(
        [this](const unsigned int begin, const unsigned int end) {
          update_materials(begin, end, &tangent[begin]);
        },
        stress,
        tangent,
        strain,
        strain_zz);
    else
      update_materials(0, points.n_points(), nullptr);
    if (flow != nullptr)
      flow->update(v);
    update_pressures();
    sum_forces(
      total_stress(),
      [&](const unsigned int p) {
        return is_undrained() ? stress_zz[p] - pressure[p] : stress_zz[p];
      },
      part);
  }

  void
  InternalForces::forces_at_start(Vector &part) const
  {
    std::vector<Mandel> total_n;
    for (unsigned int p = 0; p < pressure.size(); ++p)
      total_n.push_back(points.stress[p] -
                        points.excess_pressure(p) * unit_tensor<n_mandel>());
    sum_forces(
      is_undrained() ? total_n
                     : static_cast<const std::vector<Mandel> &>(points.stress),
      [&](const unsigned int p) {
        return whole_stress_n(p)[index_of_normal[2]] -
               (is_undrained() ? points.excess_pressure(p) : 0.);
      },
      part);
  }

  template <typename HoopStress>
  void
  InternalForces::sum_forces(const std::vector<Mandel> &of_points,
                             const HoopStress          &hoop_stress,
                             Vector                    &part) const
  {
    part = 0.;
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          double cell_f[dim * n] = {};
          add_forces_of_cell<n>(
            c,
            [&](const unsigned int p) -> Mandel {
              return points.weight[p] * of_points[p];
            },
            [&](const unsigned int p) {
              return points.weight[p] * hoop_stress(p);
            },
            cell_f);
          turned.forces_to_dofs(c, cell_f);
          scatter_add<n>(cell_f, &points.nodes[c * n], part.begin());
        }
    });
    part.compress(VectorOperation::add);
  }

  void
  InternalForces::count_modes(double *counts) const
  {
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        counts[0] += mode[p] == Mode::cone;
        counts[1] += mode[p] == Mode::apex;
        counts[2] += mode[p] != previous_mode[p];
      }
  }

  double
  InternalForces::local_error() const
  {
    if (cell_pressures)
      return Utilities::MPI::max(cell_pressures->difference(), comm);
    if (natural_map == nullptr)
      return 0.;
    const double scale = Utilities::MPI::max(map_error.stress_scale, comm);
    return Utilities::MPI::max(map_error.largest_residual, comm) /
           std::max(scale, std::numeric_limits<double>::min());
  }

  void
  InternalForces::add_elastic_diagonal(Vector &dst) const
  {
    Vector part;
    part.reinit(dst);
    const unsigned int n = points.n_nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          Elasticity e = elasticity_at_start(materials, points, p);
          e.lambda += fluid_modulus(p);
          const double direct = e.lambda + e.two_G, shear = e.two_G / 2.;
          const double factor = h * points.weight[p];
          for (unsigned int i = 0; i < n; ++i)
            {
              double g[dim], square = 0.;
              for (unsigned int d = 0; d < dim; ++d)
                g[d] = points.gradients[n * (dim * p + d) + i];
              if (const TurnedDofs::Turn *turn = turned.turn_of(c, i))
                put(turn->axes * taken(g), g);
              for (unsigned int d = 0; d < dim; ++d)
                square += g[d] * g[d];
              const unsigned int dof = dim * points.nodes[c * n + i];
              if (is_axisymmetric())
                part.local_element(dof) +=
                  factor * points.hoop[n * p + i] *
                  (direct * points.hoop[n * p + i] + 2. * e.lambda * g[0]);
              for (unsigned int d = 0; d < dim; ++d)
                part.local_element(dof + d) +=
                  factor * ((direct - shear) * g[d] * g[d] + shear * square);
            }
        }
    part.compress(VectorOperation::add);
    dst += part;
  }

  double
  InternalForces::rounding_floor(const Vector &v) const
  {
    double              sum = 0.;
    const unsigned int  n   = points.n_nodes;
    std::vector<double> speed(n);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int dof    = dim * points.nodes[c * n + i];
            double             square = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              square += std::pow(v.local_element(dof + d), 2);
            speed[i] = std::sqrt(square);
          }
        for (unsigned int p = points.first_point[c];
             p < points.first_point[c + 1];
             ++p)
          {
            const double *const g     = &points.gradients[dim * n * p];
            double              terms = 0., squares = 0.;
            for (unsigned int i = 0; i < n; ++i)
              {
                double square = 0.;
                for (unsigned int d = 0; d < dim; ++d)
                  square += g[n * d + i] * g[n * d + i];
                squares += square;
                terms += std::sqrt(square) * speed[i];
              }
            const double stress =
              (elasticity_at_start(materials, points, p).normal_stiffness() +
               dim * materials[points.material[p]].fluid_modulus()) *
              h * terms;
            sum += squares * std::pow(points.weight[p] * stress, 2);
          }
      }
    return std::numeric_limits<double>::epsilon() *
           std::sqrt(Utilities::MPI::sum(sum, comm));
  }

  void
  InternalForces::linearise(const JacobianPattern &pattern,
                            const double           blend,
                            SparseMatrix          &matrix) const
  {
    TangentsByCell tangents(*this);
    const bool     one_triangle = pattern.is_one_triangle();
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int                  n = n_constant;
      std::vector<MandelMatrix>      C;
      std::vector<OutOfPlaneTangent> C_zz;
      std::vector<double>            scratch;
      CellPressures::Condensed       condensed;
      double                         K[dim * dim * n * n];
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const unsigned int        first   = points.first_point[c];
          const unsigned int        n_q     = points.first_point[c + 1] - first;
          const MandelMatrix *const of_cell = tangents.of_cell(c);
          C.resize(n_q);
          scratch.resize(kernels::scratch_size(n_q, n));
          for (unsigned int q = 0; q < n_q; ++q)
            {
              const unsigned int p = first + q;
              C[q]                 = (h * points.weight[p]) * of_cell[q];
              if (blend > 0.)
                C[q] = (1. - blend) * C[q] +
                       (blend * h * points.weight[p]) *
                         elasticity_at_start(materials, points, p).stiffness();
              if (is_undrained())
                C[q] += (h * points.weight[p] * fluid_modulus(p)) *
                        unit_tensor<n_mandel>() *
                        unit_tensor<n_mandel>().transpose();
            }
          if (is_axisymmetric())
            {
              C_zz.resize(n_q);
              for (unsigned int q = 0; q < n_q; ++q)
                C_zz[q] = tangent_zz_of(first + q, blend);
            }
          const double *const g = &points.gradients[dim * n * first];
          const double *const volumetric =
            points.volumetric_gradients.empty() || cell_pressures
              ? nullptr
              : &points.volumetric_gradients[dim * n * first];
          const double *const hoop =
            is_axisymmetric() ? &points.hoop[n * first] : nullptr;
          if (cell_pressures)
            cell_pressures->condense(c, h, C, C_zz, condensed);
          if (one_triangle)
            stiffness<n, true>(
              g, hoop, volumetric, C.data(), n_q, scratch.data(), K);
          else
            stiffness<n, false>(
              g, hoop, volumetric, C.data(), n_q, scratch.data(), K);
          if (cell_pressures)
            add_pressure_stiffness<n>(c, condensed, K);
          if (is_axisymmetric())
            for (unsigned int q = 0; q < n_q; ++q)
              add_hoop_stiffness<n>(first + q, C_zz[q], K);
          turned.matrix_to_dofs(c, dim * n, one_triangle, K);
          pattern.add_cell<n>(c, K, matrix);
        }
    });
  }

  void
  InternalForces::apply_tangent(Vector &dst, const Vector &dv) const
  {
    TangentsByCell tangents(*this);
    Vector         part;
    part.reinit(dst);
    std::vector<Mandel> rate(points.n_points());
    std::vector<double> rate_zz(strain_zz.size());
    const auto          of_fluid = [&](const unsigned int p) {
      return fluid_modulus(p) *
             (trace(rate[p]) + (is_axisymmetric() ? rate_zz[p] : 0.));
    };
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        {
          const MandelMatrix *const of_cell = tangents.of_cell(c);
          double                    cell_v[dim * n], cell_f[dim * n] = {};
          gather<n>(dv.begin(), &points.nodes[c * n], cell_v);
          turned.velocities_to_xy(c, cell_v);
          strains_of_cell<n>(c, cell_v, h, rate, rate_zz);
          if (cell_pressures)
            cell_pressures->equalise_rates(
              c, tangent, tangent_zz, rate, rate_zz);
          add_forces_of_cell<n>(
            c,
            [&](const unsigned int p) -> Mandel {
              Mandel change = of_cell[p - points.first_point[c]] * rate[p];
              if (is_axisymmetric())
                change += rate_zz[p] * tangent_zz[p].by_zz;
              if (is_undrained())
                change += of_fluid(p) * unit_tensor<n_mandel>();
              return points.weight[p] * change;
            },
            [&](const unsigned int p) {
              return points.weight[p] *
                     (tangent_zz[p].of_zz.dot(rate[p]) +
                      tangent_zz[p].zz * rate_zz[p] + of_fluid(p));
            },
            cell_f);
          turned.forces_to_dofs(c, cell_f);
          scatter_add<n>(cell_f, &points.nodes[c * n], part.begin());
        }
    });
    part.compress(VectorOperation::add);
    dst += part;
    if (flow != nullptr)
      flow->add_tangent(dst, dv);
  }

  void
  InternalForces::for_each_strain_column(
    const std::function<
      void(const unsigned int, const unsigned int, const Mandel &)> &f) const
  {
    std::vector<Mandel> column(points.n_points());
    std::vector<double> column_zz(strain_zz.size());
    with_n_nodes(points.n_nodes, [&](const auto n_constant) {
      constexpr int n = n_constant;
      for (unsigned int c = 0; c < points.n_cells(); ++c)
        for (int j = 0; j < static_cast<int>(dim) * n; ++j)
          {
            double cell_v[dim * n] = {};
            cell_v[j]              = 1.;
            turned.velocities_to_xy(c, cell_v);
            strains_of_cell<n>(c, cell_v, 1., column, column_zz);
            for (unsigned int p = points.first_point[c];
                 p < points.first_point[c + 1];
                 ++p)
              f(p, dim * points.nodes[c * n + j / dim] + j % dim, column[p]);
          }
    });
  }
} // namespace geocone::GEOCONE_DIM
