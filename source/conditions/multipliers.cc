// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/conditions/constraints.h>
#include <geocone/conditions/multipliers.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /**
     * Relative pivot below which rows are dependent on the others; their
     * targets must then agree with them to this fraction of the largest
     * velocity. Otherwise they would be satisfied to the last digit, by
     * multipliers as large as their pivots are small.
     */
    constexpr double rank_tolerance = 1e-4;

    /** Fraction on free functions below which a row consists of prescribed
     *  dofs. */
    constexpr double least_free_part = 1e-6;

    VectorXd
    summed(VectorXd x, const MPI_Comm comm)
    {
      sum_over_ranks(x, comm);
      return x;
    }

    /** Assembled row of all ranks: coefficients by dof, right-hand side q, and
     *  the offset contained in q. */
    struct GivenRow
    {
      std::map<types::global_dof_index, double> coefficients;
      double                                    target = 0., offset = 0.;
    };

    /** Values of 'node' that mark contributions to the right-hand side. */
    constexpr double is_target = -1., is_offset = -2.;

    /** Rows by condition, component and number. */
    using GivenRows = std::map<std::array<unsigned int, 3>, GivenRow>;

    /** Sums the contributions of all ranks to each row. Collective.
     *  @param contributions of this rank, as in Multipliers */
    GivenRows
    rows_of_all_ranks(const std::vector<std::array<double, 5>> &contributions,
                      const MPI_Comm                            comm)
    {
      GivenRows rows;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(comm, contributions))
        for (const auto &[condition, component, number, node, value] : of_rank)
          {
            GivenRow &row = rows[{{static_cast<unsigned int>(condition),
                                   static_cast<unsigned int>(component),
                                   static_cast<unsigned int>(number)}}];
            if (node < 0.)
              {
                row.target += value;
                if (node == is_offset)
                  row.offset += value;
              }
            else
              row
                .coefficients[dim * static_cast<types::global_dof_index>(node) +
                              static_cast<unsigned int>(component)] += value;
          }
      return rows;
    }

    /** Dofs involved in rows, each with its column and its status on the owning
     *  rank: free, prescribed (with its value), or without mass. */
    struct TouchedDofs
    {
      std::map<types::global_dof_index, unsigned int> column;
      VectorXd is_free, is_held, value; ///< by column

      /** Collective. */
      TouchedDofs(const GivenRows   &rows,
                  const Space       &space,
                  const Constraints &constraints,
                  const Vector      &prescribed)
      {
        for (const auto &row : rows)
          for (const auto &entry : row.second.coefficients)
            column.emplace(entry.first, 0);
        unsigned int n_dofs = 0;
        for (auto &entry : column)
          entry.second = n_dofs++;
        is_free = is_held = value = VectorXd::Zero(n_dofs);
        const auto &layout        = *space.partitioner();
        for (const auto &[dof, j] : column)
          if (layout.in_local_range(dof))
            {
              const unsigned int local = layout.global_to_local(dof);
              is_free[j]               = constraints.is_free(local);
              is_held[j]               = constraints.is_prescribed(local);
              value[j] =
                is_held[j] != 0. ? prescribed.local_element(local) : 0.;
            }
        for (VectorXd *sum : {&is_free, &is_held, &value})
          sum_over_ranks(*sum, prescribed.get_mpi_communicator());
      }
    };

    /** Rows, in order, as equations for the free dofs. */
    struct Equations
    {
      std::vector<Multipliers::Key> keys;
      MatrixXd                      matrix; ///< columns of TouchedDofs
      VectorXd                      asked;  ///< right-hand sides as given
      VectorXd target;     ///< less contributions of prescribed dofs
      double   scale = 0.; ///< of the velocities (m/s)

      Equations(const unsigned int n_rows, const unsigned int n_dofs)
        : matrix(MatrixXd::Zero(n_rows, n_dofs))
        , asked(n_rows)
        , target(n_rows)
      {}

      /** Adds a row. @return the sum of its coefficients, or nothing if it
       *  contains no function with mass */
      std::optional<double>
      add(const Multipliers::Key &key,
          const GivenRow         &row,
          const TouchedDofs      &dofs)
      {
        double all = 0., supported = 0., free = 0.;
        for (const auto &[dof, coefficient] : row.coefficients)
          {
            const unsigned int j = dofs.column.at(dof);
            all += coefficient;
            if (dofs.is_free[j] != 0. || dofs.is_held[j] != 0.)
              supported += coefficient;
            if (dofs.is_free[j] != 0.)
              free += std::abs(coefficient);
          }
        if (!(supported > 1e-8 * all))
          return std::nullopt;
        const unsigned int r = keys.size();
        keys.push_back(key);
        asked[r] = target[r] = row.target;
        scale                = std::max(scale, std::abs(row.target));
        // On prescribed nodes up to rounding.
        const bool is_fixed = free < least_free_part * supported;
        for (const auto &[dof, coefficient] : row.coefficients)
          {
            const unsigned int j = dofs.column.at(dof);
            const double       c = coefficient * (all / supported);
            if (dofs.is_free[j] != 0. && !is_fixed)
              matrix(r, j) = c;
            else if (dofs.is_held[j] != 0.)
              {
                target[r] -= c * dofs.value[j];
                scale = std::max(scale, std::abs(c * dofs.value[j]));
              }
          }
        return all;
      }
    };

    /** Sorted numbers of linearly independent rows. */
    std::vector<int>
    independent_rows(const MatrixXd &matrix)
    {
      Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix.transpose());
      qr.setThreshold(rank_tolerance);
      const auto      &ordered = qr.colsPermutation().indices();
      std::vector<int> kept(ordered.data(), ordered.data() + qr.rank());
      std::sort(kept.begin(), kept.end());
      return kept;
    }

    /** First dependent row whose target contradicts the rows kept.
     *  @param independent,q rows and targets kept */
    std::optional<Multipliers::Refusal>
    disagreement(const Equations        &all,
                 const std::vector<int> &kept,
                 const MatrixXd         &independent,
                 const VectorXd         &q)
    {
      if (kept.size() == all.keys.size())
        return std::nullopt;
      Eigen::ColPivHouseholderQR<MatrixXd> basis;
      if (!kept.empty())
        basis.compute(independent.transpose());
      for (unsigned int i = 0; i < all.keys.size(); ++i)
        if (!std::binary_search(kept.begin(), kept.end(), i))
          {
            const double left =
              kept.empty()
                ? 0.
                : VectorXd(basis.solve(all.matrix.row(i).transpose())).dot(q);
            if (std::abs(left - all.target[i]) > rank_tolerance * all.scale)
              return Multipliers::Refusal{all.keys[i],
                                          true,
                                          all.asked[i],
                                          all.asked[i] - all.target[i] + left};
          }
      return std::nullopt;
    }
  } // namespace

  void
  Multipliers::clear()
  {
    contributions.clear();
    keys.clear();
    touched.clear();
    H.resize(0, 0);
    q.resize(0);
    asked.clear();
    row_sum.resize(0);
    given        = 0;
    sum_of_loads = 0.;
  }

  void
  Multipliers::add_coefficient(const Key                    &key,
                               const types::global_dof_index node,
                               const double                  value)
  {
    contribute(key, node, value);
  }

  void
  Multipliers::add_target(const Key &key, const double value)
  {
    contribute(key, is_target, value);
  }

  void
  Multipliers::add_offset(const Key &key, const double value)
  {
    contribute(key, is_offset, value);
  }

  void
  Multipliers::contribute(const Key &key, const double node, const double value)
  {
    contributions.push_back({{double(key.condition),
                              double(key.component),
                              double(key.number),
                              node,
                              value}});
  }

  std::optional<Multipliers::Refusal>
  Multipliers::assemble(const Space       &space,
                        const Constraints &constraints,
                        const Vector      &prescribed)
  {
    comm                 = prescribed.get_mpi_communicator();
    const GivenRows rows = rows_of_all_ranks(contributions, comm);
    contributions.clear();
    given = rows.size();
    if (given == 0)
      return std::nullopt;

    const TouchedDofs dofs(rows, space, constraints, prescribed);
    Equations         all(given, dofs.column.size());
    for (const auto &[name, row] : rows)
      {
        const Key  key = {name[0], name[1], name[2]};
        const auto sum = all.add(key, row, dofs);
        if (!sum)
          return Refusal{key, false};
        asked.push_back({key, row.target - row.offset, *sum});
      }

    const std::vector<int> kept = independent_rows(all.matrix);
    const unsigned int     rank = kept.size();
    MatrixXd               independent(rank, dofs.column.size());
    q.resize(rank);
    keys.clear();
    for (unsigned int k = 0; k < rank; ++k)
      {
        independent.row(k) = all.matrix.row(kept[k]);
        q[k]               = all.target[kept[k]];
        keys.push_back(all.keys[kept[k]]);
      }
    row_sum = independent.rowwise().sum();
    if (const auto refusal = disagreement(all, kept, independent, q))
      return refusal;

    std::vector<unsigned int> columns;
    const auto               &layout = *space.partitioner();
    touched.clear();
    for (const auto &[dof, j] : dofs.column)
      if (dofs.is_free[j] != 0. && layout.in_local_range(dof))
        {
          touched.push_back(layout.global_to_local(dof));
          columns.push_back(j);
        }
    H.resize(rank, touched.size());
    for (unsigned int j = 0; j < touched.size(); ++j)
      H.col(j) = independent.col(columns[j]);
    return std::nullopt;
  }

  bool
  Multipliers::add_loads(const Vector   &force,
                         const double    velocity,
                         const Unknowns &unknowns,
                         const Vector   &prescribed)
  {
    comm = force.get_mpi_communicator();
    // Sums of magnitudes, of those that can do work, and of the work of
    // prescribed velocities.
    std::array<double, 3> sums = {};
    for (unsigned int i = 0; i < force.locally_owned_size(); i += dim)
      {
        double square = 0., free = 0.;
        for (unsigned int d = i; d < i + dim; ++d)
          {
            const double f = force.local_element(d);
            square += f * f;
            free += unknowns.is_free(d) ? f * f : 0.;
            if (unknowns.is_prescribed(d))
              sums[2] += f * prescribed.local_element(d);
          }
        sums[0] += std::sqrt(square);
        sums[1] += std::sqrt(free);
      }
    sum_over_ranks(sums, comm);
    if (!(sums[1] > least_free_part * sums[0]))
      return false;
    sum_of_loads = sums[0];

    // The row in existing columns, and new columns.
    std::vector<int> column(force.locally_owned_size(), -1);
    for (unsigned int j = 0; j < touched.size(); ++j)
      column[touched[j]] = j;
    for (unsigned int i = 0; i < column.size(); ++i)
      if (column[i] < 0 && unknowns.is_free(i) && force.local_element(i) != 0.)
        {
          column[i] = touched.size();
          touched.push_back(i);
        }
    const unsigned int n           = H.rows();
    MatrixXd           all         = MatrixXd::Zero(n + 1, touched.size());
    all.topLeftCorner(n, H.cols()) = H;
    for (unsigned int j = 0; j < touched.size(); ++j)
      all(n, j) = force.local_element(touched[j]) / sum_of_loads;
    H = std::move(all);
    q.conservativeResize(n + 1);
    q[n] = velocity - sums[2] / sum_of_loads;
    row_sum.conservativeResize(n + 1);
    row_sum[n] = 0.; // belongs to no component of a condition
    keys.push_back({numbers::invalid_unsigned_int, 0, 0});
    ++given;
    return true;
  }

  VectorXd
  Multipliers::multiply(const Vector &f) const
  {
    VectorXd own(touched.size());
    for (unsigned int j = 0; j < touched.size(); ++j)
      own[j] = f.local_element(touched[j]);
    return summed(H * own, comm);
  }

  VectorXd
  Multipliers::defect(const Vector &v) const
  {
    return q - multiply(v);
  }

  void
  Multipliers::add_transposed(Vector         &f,
                              const double    factor,
                              const VectorXd &lambda) const
  {
    const VectorXd own = factor * H.transpose() * lambda;
    for (unsigned int j = 0; j < touched.size(); ++j)
      f.local_element(touched[j]) += own[j];
  }

  Multipliers::Factors
  Multipliers::factorise(const Vector *scale) const
  {
    // Householder reflections yield U_r on each rank, then act on the stacked
    // U_r of all ranks.
    Factors            result;
    const unsigned int n = H.rows(), m = touched.size(), k = std::min(n, m);
    result.root.resize(m);
    for (unsigned int j = 0; j < m; ++j)
      result.root[j] =
        scale != nullptr ? std::sqrt(scale->local_element(touched[j])) : 1.;
    const MatrixXd own =
      result.root.cwiseInverse().asDiagonal() * H.transpose();
    result.Q   = MatrixXd::Zero(m, k);
    MatrixXd U = MatrixXd::Zero(k, n);
    if (k > 0)
      {
        const Eigen::HouseholderQR<MatrixXd> qr(own);
        result.Q = qr.householderQ() * MatrixXd::Identity(m, k);
        U        = qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
      }
    const auto all = Utilities::MPI::all_gather(
      comm, std::vector<double>(U.data(), U.data() + U.size()));
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    std::size_t        size = 0, before = 0;
    for (unsigned int r = 0; r < all.size(); ++r)
      {
        before += r < rank ? all[r].size() / n : 0;
        size += all[r].size() / n;
      }
    MatrixXd    stacked(size, n);
    std::size_t first = 0;
    for (const std::vector<double> &values : all)
      {
        const std::size_t rows = values.size() / n;
        stacked.middleRows(first, rows) =
          Eigen::Map<const MatrixXd>(values.data(), rows, n);
        first += rows;
      }
    const Eigen::HouseholderQR<MatrixXd> qr(stacked);
    const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(size, n);
    result.Q         = MatrixXd(result.Q * Q.middleRows(before, k));
    result.U         = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
    return result;
  }

  VectorXd
  Multipliers::remove(Vector &residual, const Factors &factors) const
  {
    VectorXd own(touched.size());
    for (unsigned int j = 0; j < touched.size(); ++j)
      own[j] = residual.local_element(touched[j]) / factors.root[j];
    const VectorXd along = summed(factors.Q.transpose() * own, comm);
    const VectorXd force = factors.Q * along;
    for (unsigned int j = 0; j < touched.size(); ++j)
      residual.local_element(touched[j]) -= factors.root[j] * force[j];
    return factors.U.triangularView<Eigen::Upper>().solve(along);
  }

  double
  Multipliers::resultant(const VectorXd    &lambda,
                         const unsigned int condition,
                         const unsigned int component) const
  {
    double sum = 0.;
    for (unsigned int k = 0; k < n_rows(); ++k)
      if (keys[k].condition == condition && keys[k].component == component)
        sum += lambda[k] * row_sum[k];
    return sum;
  }

  Tensor<1, n_rotations>
  Multipliers::moment(const VectorXd    &lambda,
                      const unsigned int condition,
                      const Point<dim>  &centre,
                      const Space       &space) const
  {
    Reaction sum;
    for (unsigned int j = 0; j < touched.size(); ++j)
      for (unsigned int k = 0; k < n_rows(); ++k)
        if (keys[k].condition == condition)
          sum.add(space.node_positions()[touched[j] / dim] - centre,
                  touched[j] % dim,
                  lambda[k] * H(k, j));
    return Utilities::MPI::sum(sum.moment, comm);
  }

  Multipliers::LowMassShare
  Multipliers::low_mass_share(const Vector &v,
                              const Vector &mass,
                              const Space  &space) const
  {
    const unsigned int n = n_rows();
    if (n == 0)
      return {};
    std::vector<double> heaviest(n, 0.);
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int j = 0; j < touched.size(); ++j)
        if (H(r, j) != 0.)
          heaviest[r] = std::max(heaviest[r], mass.local_element(touched[j]));
    dealii::Utilities::MPI::max(heaviest, comm, heaviest);
    std::vector<double>             light(n, 0.), most(n, 0.);
    std::vector<dealii::Point<dim>> place(n);
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int j = 0; j < touched.size(); ++j)
        {
          const double part = H(r, j) * v.local_element(touched[j]);
          if (!(mass.local_element(touched[j]) < 1e-3 * heaviest[r]))
            continue;
          light[r] += part;
          if (std::abs(part) > most[r])
            {
              most[r]  = std::abs(part);
              place[r] = space.node_positions()[touched[j] / dim];
            }
        }
    dealii::Utilities::MPI::sum(light, comm, light);
    LowMassShare share;
    unsigned int worst = 0;
    // Components prescribed as zero along one axis and nonzero along the other
    // are compared with the nonzero velocity.
    for (unsigned int r = 0; r < n; ++r)
      {
        const unsigned int c = keys[r].condition;
        const double       push =
          std::abs(row_sum[r]) *
          std::max(std::abs(mean_target(c, 0)), std::abs(mean_target(c, 1)));
        if (std::abs(light[r]) > share.largest * push && push > 0.)
          {
            share.largest = std::abs(light[r]) / push;
            worst         = r;
          }
      }
    if (share.largest > 0.)
      {
        share.condition       = keys[worst].condition;
        const double all_most = dealii::Utilities::MPI::max(most[worst], comm);
        share.place =
          place_of_largest(most[worst], all_most, place[worst], comm);
      }
    return share;
  }

  double
  Multipliers::mean_target(const unsigned int condition,
                           const unsigned int component) const
  {
    double sum = 0., weight = 0.;
    for (const Asked &row : asked)
      if (row.key.condition == condition && row.key.component == component)
        {
          sum += row.target;
          weight += row.weight;
        }
    return weight > 0. ? sum / weight : 0.;
  }
} // namespace geocone::GEOCONE_DIM
