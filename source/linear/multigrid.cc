// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/linear/linear_solver.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <map>

namespace geocone
{
  namespace
  {
    using dealii::IndexSet;
    using MgVector = dealii::TrilinosWrappers::MPI::Vector;
    using MgMatrix = dealii::TrilinosWrappers::SparseMatrix;
    using dealii::types::global_dof_index;

    /**
     * Conjugate gradients, or GMRES for unsymmetric matrices, preconditioned by
     * smoothed aggregation of Trilinos (ML). The matrix has a row for each dof,
     * so that nodes can be aggregated as a whole; dofs that are not unknowns
     * have the identity. Systems that take too many iterations are solved
     * directly, and so are the next ones: one after the first failure, two
     * after the next, and so on, until one converges in time.
     */
    class Multigrid : public LinearSolver
    {
    public:
      Multigrid(const MPI_Comm                comm,
                const bool                    symmetric,
                const double                  tolerance,
                const unsigned int            max_iterations,
                std::unique_ptr<LinearSolver> direct)
        : comm(comm)
        , symmetric(symmetric)
        , tolerance(tolerance)
        , max_iterations(max_iterations)
        , direct(std::move(direct))
      {}

      bool
      wants_nodal_rows() const override
      {
        return true;
      }

      void
      set_nodal_rows(NodalRows new_rows) override
      {
        rows = std::move(new_rows);
      }

      void
      analyse(const SparseMatrix &matrix) override
      {
        direct_is_ready      = false;
        const IndexSet &own  = rows.layout->locally_owned_range();
        IndexSet        used = own;
        used.add_indices(rows.dof.begin(), rows.dof.end());

        dealii::TrilinosWrappers::SparsityPattern pattern(own, own, used, comm);
        std::vector<bool>             is_row(own.n_elements(), false);
        std::vector<global_dof_index> columns;
        for (int i = 0; i < matrix.n_rows(); ++i)
          {
            columns.clear();
            for (int e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
              columns.push_back(rows.dof[matrix.column[e]]);
            pattern.add_entries(rows.dof[i], columns.begin(), columns.end());
            if (i < matrix.n_owned)
              is_row[own.index_within_set(rows.dof[i])] = true;
          }
        no_rows.clear();
        for (unsigned int i = 0; i < own.n_elements(); ++i)
          if (!is_row[i])
            {
              no_rows.push_back(own.nth_index_in_set(i));
              pattern.add(no_rows.back(), no_rows.back());
            }
        pattern.compress();
        system.reinit(pattern);
        find_places(matrix);
        solution.reinit(own, comm);
        right_side.reinit(own, comm);
      }

      bool
      factorise(const SparseMatrix &matrix) override
      {
        last = &matrix;
        if (n_to_skip > 0)
          {
            --n_to_skip;
            is_direct = true;
            return factorise_directly();
          }
        is_direct = false;
        fill(matrix);
        make_hierarchy();
        return true;
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        const std::size_t n = last->n_owned;
        for (unsigned int c = 0; c < n_columns && !is_direct; ++c)
          if (!iterate(&x[n * c]))
            {
              // Columns already solved are kept.
              std::vector<double> rest(x.begin() + n * c, x.end());
              n_in_a_row = std::min(2 * n_in_a_row + 1, 15U);
              n_to_skip  = n_in_a_row;
              is_direct  = true;
              if (factorise_directly())
                direct->solve(rest, n_columns - c);
              else
                // Singular: too late to report, so the direction is zero.
                std::fill(rest.begin(), rest.end(), 0.);
              std::copy(rest.begin(), rest.end(), x.begin() + n * c);
              return;
            }
        if (is_direct)
          direct->solve(x, n_columns);
        else
          n_in_a_row = 0;
      }

      bool
      wants_one_triangle() const override
      {
        return false;
      }

      std::string
      name() const override
      {
        return "multigrid";
      }

    private:
      /** Finds the positions of the entries of owned rows in the values of
       *  `system`. */
      void
      find_places(const SparseMatrix &matrix)
      {
        const Epetra_CrsMatrix &A   = system.trilinos_matrix();
        const Epetra_Map       &col = A.ColMap();
        int                    *start, *column;
        double                 *values;
        A.ExtractCrsDataPointers(start, column, values);
        places.clear();
        for (int i = 0; i < matrix.n_owned; ++i)
          {
            const int row = A.RowMap().LID(int(rows.dof[i]));
            // With several ranks the columns may be unsorted.
            std::map<int, int> place;
            for (int e = start[row]; e < start[row + 1]; ++e)
              place[column[e]] = e;
            for (int e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
              places.push_back(
                place.at(col.LID(int(rows.dof[matrix.column[e]]))));
          }
      }

      void
      fill(const SparseMatrix &matrix)
      {
        system = 0.;
        int    *start, *column;
        double *values;
        system.trilinos_matrix().ExtractCrsDataPointers(start, column, values);
        for (std::size_t e = 0; e < places.size(); ++e)
          values[places[e]] += matrix.value[e];
        std::vector<global_dof_index> columns;
        for (int i = matrix.n_owned; i < matrix.n_rows(); ++i)
          {
            const int from = matrix.row_start[i], to = matrix.row_start[i + 1];
            columns.clear();
            for (int e = from; e < to; ++e)
              columns.push_back(rows.dof[matrix.column[e]]);
            system.add(
              rows.dof[i], columns.size(), columns.data(), &matrix.value[from]);
          }
        for (const global_dof_index dof : no_rows)
          system.add(dof, dof, 1.);
        system.compress(dealii::VectorOperation::add);
      }

      void
      make_hierarchy()
      {
        Teuchos::ParameterList list;
        ML_Epetra::SetDefaults(symmetric ? "SA" : "NSSA", list);
        list.set("ML output", 0);
        list.set("PDE equations", int(rows.n_components));
        list.set("aggregation: type", "Uncoupled");
        list.set("aggregation: threshold", 0.01);
        list.set("smoother: type",
                 symmetric ? "Chebyshev" : "symmetric Gauss-Seidel");
        list.set("smoother: sweeps", 3); // for Chebyshev: its degree
        list.set("coarse: type", "Amesos-KLU");
        list.set("coarse: max size", 1000);
        motions.clear();
        for (const auto &motion : rows.rigid_motions)
          motions.insert(motions.end(), motion.begin(), motion.end());
        list.set("null space: type", "pre-computed");
        list.set("null space: dimension", int(rows.rigid_motions.size()));
        list.set("null space: vectors", motions.data());
        hierarchy.initialize(system.trilinos_matrix(), list);
      }

      /** @return whether the tolerance was reached within the allowed
       *  iterations */
      bool
      iterate(double *x)
      {
        const global_dof_index first =
          rows.layout->locally_owned_range().n_elements() > 0
            ? rows.layout->local_range().first
            : 0;
        double *b = right_side.trilinos_vector()[0];
        std::fill(b, b + right_side.locally_owned_size(), 0.);
        for (int i = 0; i < last->n_owned; ++i)
          b[rows.dof[i] - first] = x[i];
        solution          = 0.;
        const double norm = right_side.l2_norm();
        if (norm == 0.)
          return true;
        dealii::SolverControl control(
          max_iterations, tolerance * norm, false, false);
        try
          {
            if (symmetric)
              dealii::SolverCG<MgVector>(control).solve(
                system, solution, right_side, hierarchy);
            else
              dealii::SolverGMRES<MgVector>(
                control,
                dealii::SolverGMRES<MgVector>::AdditionalData(100, true))
                .solve(system, solution, right_side, hierarchy);
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
            return false;
          }
        const double *found = solution.trilinos_vector()[0];
        for (int i = 0; i < last->n_owned; ++i)
          x[i] = found[rows.dof[i] - first];
        return true;
      }

      /** Factorises the last matrix by the direct solver. */
      bool
      factorise_directly()
      {
        const bool lower = direct->wants_one_triangle();
        if (!direct_is_ready)
          {
            for_direct = lower ? lower_triangle(*last) : SparseMatrix();
            direct->analyse(lower ? for_direct : *last);
            direct_is_ready = true;
          }
        if (!lower)
          return direct->factorise(*last);
        copy_lower_triangle(*last, for_direct);
        return direct->factorise(for_direct);
      }

      static SparseMatrix
      lower_triangle(const SparseMatrix &full)
      {
        SparseMatrix lower = full;
        lower.symmetric    = true;
        lower.column.clear();
        lower.row_start.assign(1, 0);
        for (int i = 0; i < full.n_rows(); ++i)
          {
            for (int e = full.row_start[i]; e < full.row_start[i + 1]; ++e)
              if (full.column[e] <= i)
                lower.column.push_back(full.column[e]);
            lower.row_start.push_back(lower.column.size());
          }
        lower.value.resize(lower.column.size());
        return lower;
      }

      static void
      copy_lower_triangle(const SparseMatrix &full, SparseMatrix &lower)
      {
        for (int i = 0; i < full.n_rows(); ++i)
          std::copy_n(&full.value[full.row_start[i]],
                      lower.row_start[i + 1] - lower.row_start[i],
                      &lower.value[lower.row_start[i]]);
      }

      const MPI_Comm                comm;
      const bool                    symmetric;
      const double                  tolerance;
      const unsigned int            max_iterations;
      std::unique_ptr<LinearSolver> direct;

      NodalRows                                 rows;
      std::vector<global_dof_index>             no_rows; ///< with the identity
      MgMatrix                                  system;
      std::vector<int>                          places;
      std::vector<double>                       motions;
      dealii::TrilinosWrappers::PreconditionAMG hierarchy;
      MgVector                                  solution, right_side;

      const SparseMatrix *last = nullptr; ///< last factorised
      SparseMatrix        for_direct;
      bool                direct_is_ready = false;
      bool                is_direct       = false;
      unsigned int        n_in_a_row = 0, n_to_skip = 0; ///< failures
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_multigrid(const MPI_Comm                comm,
                 const bool                    symmetric,
                 const double                  tolerance,
                 const unsigned int            max_iterations,
                 std::unique_ptr<LinearSolver> direct)
  {
    return std::make_unique<Multigrid>(
      comm, symmetric, tolerance, max_iterations, std::move(direct));
  }
} // namespace geocone
