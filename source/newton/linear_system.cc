// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/newton/linear_system.h>

#include <deal.II/base/mpi.h>

#include <Eigen/LU>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using dealii::TimerOutput;

  LinearSystem::LinearSystem(
    const LinearSolverParameters              &parameters,
    const MPI_Comm                             comm,
    const bool                                 symmetric,
    std::shared_ptr<const VertexInterpolation> vertices)
    : solver(parameters.make(comm, symmetric, vertices != nullptr))
    , comm(comm)
    , vertices(std::move(vertices))
  {}

  void
  LinearSystem::set_pattern(IncrementalProblem &problem, TimerOutput &timer)
  {
    TimerOutput::Scope scope(timer, "analyse");
    SparseMatrix       next = problem.make_pattern(solver->wants_one_triangle(),
                                             solver->takes_shared_columns());
    const int    changes = !has_pattern || next.row_start != matrix.row_start ||
                        next.column != matrix.column ||
                        next.global_index != matrix.global_index;
    matrix      = std::move(next);
    has_pattern = true;
    pressures   = problem.pressures();
    if (pressures != nullptr)
      coupled = pressures->make_pattern(matrix);
    if (dealii::Utilities::MPI::max(changes, comm) == 0)
      return;
    if (solver->wants_nodal_rows())
      {
        NodalRows rows = problem.nodal_rows();
        rows.vertices  = vertices;
        solver->set_nodal_rows(std::move(rows));
      }
    solver->analyse(pressures != nullptr ? coupled : matrix);
  }

  bool
  LinearSystem::factorise(const IncrementalProblem &problem,
                          const double              elastic_blend,
                          TimerOutput              &timer)
  {
    {
      TimerOutput::Scope scope(timer, "assemble");
      low_rank = problem.linearise(matrix, elastic_blend);
    }
    TimerOutput::Scope scope(timer, "factorise");
    if (pressures != nullptr)
      pressures->assemble(matrix, coupled);
    if (!solver->factorise(pressures != nullptr ? coupled : matrix))
      return false;
    const unsigned int m = low_rank.rank();
    if (m == 0)
      return true;
    solver->set_tolerance(0.); // forcing terms are for directions
    std::vector<double> columns(low_rank.U.data(),
                                low_rank.U.data() + low_rank.U.size());
    solve_factorised(columns, m);
    solved_U =
      Eigen::Map<Eigen::MatrixXd>(columns.data(), low_rank.U.rows(), m);
    Eigen::MatrixXd S = low_rank.W.transpose() * solved_U;
    sum_over_ranks(S, comm);
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(
      Eigen::MatrixXd::Identity(m, m) + S);
    if (!factors.isInvertible())
      return false;
    to_change = factors.inverse();
    return true;
  }

  void
  LinearSystem::solve_factorised(std::vector<double> &columns,
                                 const unsigned int   n_columns)
  {
    if (pressures == nullptr)
      {
        solver->solve(columns, n_columns);
        return;
      }
    const std::size_t   n = matrix.n_owned, n_all = coupled.n_owned;
    std::vector<double> all(n_all * n_columns, 0.);
    for (unsigned int k = 0; k < n_columns; ++k)
      std::copy_n(&columns[n * k], n, &all[n_all * k]);
    solver->solve(all, n_columns);
    for (unsigned int k = 0; k < n_columns; ++k)
      std::copy_n(&all[n_all * k], n, &columns[n * k]);
  }

  void
  LinearSystem::solve_columns(std::vector<double> &columns,
                              const unsigned int   n_columns)
  {
    solve_factorised(columns, n_columns);
    if (low_rank.rank() == 0)
      return;
    Eigen::Map<Eigen::MatrixXd> x(
      columns.data(), columns.size() / n_columns, n_columns);
    Eigen::MatrixXd products = low_rank.W.transpose() * x;
    sum_over_ranks(products, comm);
    x -= solved_U * (to_change * products);
  }

  void
  LinearSystem::solve(const Unknowns        &unknowns,
                      const Eigen::VectorXd &defect,
                      std::vector<double>   &x)
  {
    const Multipliers &rows = unknowns.multipliers;
    const unsigned int m    = rows.n_rows();
    if (m == 0)
      {
        solve_columns(x, 1);
        return;
      }
    using Matrix          = Eigen::MatrixXd;
    const std::size_t   n = x.size();
    std::vector<double> columns(n * (m + 1), 0.);
    std::copy(x.begin(), x.end(), columns.begin());
    std::vector<int> places;
    for (const unsigned int dof : rows.dofs())
      places.push_back(unknowns.free_row[dof]);
    for (unsigned int k = 0; k < m; ++k)
      for (unsigned int j = 0; j < places.size(); ++j)
        columns[n * (k + 1) + places[j]] = rows.coefficients()(k, j);
    solve_columns(columns, m + 1);

    const Eigen::Map<const Matrix> solved(columns.data(), n, m + 1);
    Matrix                         touched(places.size(), m + 1);
    for (unsigned int j = 0; j < places.size(); ++j)
      touched.row(j) = solved.row(places[j]);
    Matrix products = rows.coefficients() * touched;
    sum_over_ranks(products, comm);
    const Eigen::VectorXd change =
      products.rightCols(m).partialPivLu().solve(defect - products.col(0));
    Eigen::Map<Eigen::VectorXd>(x.data(), n) =
      solved.col(0) + solved.rightCols(m) * change;
  }
} // namespace geocone::GEOCONE_DIM
