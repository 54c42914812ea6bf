// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/preconditioner.h>

#include <deal.II/base/index_set.h>

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
    using dealii::types::global_dof_index;
    using MlVector = dealii::TrilinosWrappers::MPI::Vector;
    using MlMatrix = dealii::TrilinosWrappers::SparseMatrix;

    /**
     * V-cycle of smoothed aggregation by Trilinos (ML). Its matrix has a row for
     * each dof, so that nodes can be aggregated as a whole; dofs that are not
     * unknowns have the identity.
     */
    class Aggregation : public Preconditioner
    {
    public:
      Aggregation(const MPI_Comm comm, const bool symmetric)
        : comm(comm)
        , symmetric(symmetric)
      {}

      void
      analyse(const SparseMatrix &matrix, NodalRows nodes) override
      {
        rows                 = std::move(nodes);
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
        fill(matrix);
        make_hierarchy();
        return true;
      }

      void
      vmult(RowVector &x, const RowVector &b) const override
      {
        const global_dof_index first =
          rows.layout->locally_owned_range().n_elements() > 0
            ? rows.layout->local_range().first
            : 0;
        double *values = right_side.trilinos_vector()[0];
        std::fill(values, values + right_side.locally_owned_size(), 0.);
        for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
          values[rows.dof[i] - first] = b.local_element(i);
        hierarchy.vmult(solution, right_side);
        values = solution.trilinos_vector()[0];
        for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
          x.local_element(i) = values[rows.dof[i] - first];
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
        places.reserve(matrix.row_start[matrix.n_owned]);
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

      const MPI_Comm comm;
      const bool     symmetric;

      NodalRows                                 rows;
      std::vector<global_dof_index>             no_rows; ///< with the identity
      MlMatrix                                  system;
      std::vector<int>                          places;
      std::vector<double>                       motions;
      dealii::TrilinosWrappers::PreconditionAMG hierarchy;
      mutable MlVector                          solution, right_side;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_aggregation(const MPI_Comm comm, const bool symmetric)
  {
    return std::make_unique<Aggregation>(comm, symmetric);
  }
} // namespace geocone
