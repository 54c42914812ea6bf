// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/solvers/linear_system.h>

#include <deal.II/base/mpi.h>

#include <Eigen/LU>

namespace geocone
{
  using dealii::TimerOutput;

  LinearSystem::LinearSystem(const std::string &solver_name,
                             const MPI_Comm     comm,
                             const bool         symmetric)
    : solver(make_linear_solver(solver_name, comm, symmetric))
    , comm(comm)
  {}

  void
  LinearSystem::set_pattern(IncrementalProblem &problem, TimerOutput &timer)
  {
    TimerOutput::Scope scope(timer, "analyse");
    SparseMatrix next    = problem.make_pattern(solver->wants_one_triangle());
    const int    changes = !has_pattern || next.row_start != matrix.row_start ||
                        next.column != matrix.column ||
                        next.global_index != matrix.global_index;
    matrix      = std::move(next);
    has_pattern = true;
    if (dealii::Utilities::MPI::max(changes, comm) > 0)
      solver->analyse(matrix);
  }

  bool
  LinearSystem::factorise(const IncrementalProblem &problem,
                          const double              elastic_blend,
                          TimerOutput              &timer)
  {
    {
      TimerOutput::Scope scope(timer, "assemble");
      problem.linearise(matrix, elastic_blend);
    }
    TimerOutput::Scope scope(timer, "factorise");
    return solver->factorise(matrix);
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
        solver->solve(x);
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
    solver->solve(columns, m + 1);

    const Eigen::Map<const Matrix> solved(columns.data(), n, m + 1);
    Matrix                         touched(places.size(), m + 1);
    for (unsigned int j = 0; j < places.size(); ++j)
      touched.row(j) = solved.row(places[j]);
    Matrix products = rows.coefficients() * touched;
    dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(products.data(), products.size()),
      comm,
      dealii::ArrayView<double>(products.data(), products.size()));
    const Eigen::VectorXd change =
      products.rightCols(m).partialPivLu().solve(defect - products.col(0));
    Eigen::Map<Eigen::VectorXd>(x.data(), n) =
      solved.col(0) + solved.rightCols(m) * change;
  }
} // namespace geocone
