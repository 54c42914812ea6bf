// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/linear/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <dmumps_c.h>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace geocone
{
  namespace
  {
    /**
     * Distributed solver MUMPS: each rank passes its own contributions, which
     * MUMPS adds, and its own rows of right-hand sides. Each rank receives the
     * rows of the solution of its fronts, which are sent to their owners.
     */
    class Mumps : public LinearSolver
    {
    public:
      Mumps(const MPI_Comm     comm,
            const bool         symmetric,
            const std::string &folder)
        : comm(comm)
        , symmetric(symmetric)
        , serial(dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
      {
        std::memset(&id, 0, sizeof(id));
        id.comm_fortran = MPI_Comm_c2f(comm);
        id.par          = 1;
        id.sym          = symmetric ? 1 : 0; // 1: positive definite
        call(-1);
        for (int i = 1; i <= 4; ++i)
          icntl(i) = i == 4 ? 0 : -1; // silent
        icntl(14) = usual_workspace;
        icntl(18) = 3; // distributed assembled entries
        if (!serial)
          {
            icntl(20) = 10; // distributed right-hand sides,
            icntl(21) = 1;  // and solutions
          }
        if (folder.empty())
          return;
        if (folder.size() >= sizeof(id.ooc_tmpdir))
          throw InputError("Linear solver/Out-of-core folder",
                           folder,
                           "names of up to " +
                             std::to_string(sizeof(id.ooc_tmpdir) - 1) +
                             " letters",
                           "link a shorter name to it");
        icntl(22) = 1;
        std::strcpy(id.ooc_tmpdir, folder.c_str());
        std::strcpy(id.ooc_prefix, "geocone");
      }

      ~Mumps() override
      {
        call(-2);
      }

      void
      analyse(const SparseMatrix &matrix) override
      {
        rows.clear();
        columns.clear();
        for (int i = 0; i < matrix.n_rows(); ++i)
          for (int e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
            {
              const int row = matrix.global_index[i] + 1;
              const int col = matrix.global_index[matrix.column[e]] + 1;
              rows.push_back(row);
              columns.push_back(col);
            }
        id.n       = matrix.n_global;
        id.nnz_loc = rows.size();
        id.irn_loc = rows.data();
        id.jcn_loc = columns.data();
        call(1);
        check("analysis");

        const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
        const int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
        std::vector<int> n_rows(n_ranks);
        MPI_Allgather(
          &matrix.n_owned, 1, MPI_INT, n_rows.data(), 1, MPI_INT, comm);
        first_row.assign(n_ranks + 1, 0);
        std::partial_sum(n_rows.begin(), n_rows.end(), first_row.begin() + 1);
        own_rows.resize(matrix.n_owned);
        std::iota(own_rows.begin(), own_rows.end(), first_row[rank] + 1);
      }

      bool
      factorise(const SparseMatrix &matrix) override
      {
        id.a_loc = const_cast<double *>(matrix.value.data());
        for (int attempt = 0;; ++attempt)
          {
            call(2);
            const int error = id.infog[0];
            if (error >= 0)
              // With id.sym = 1 negative pivots are counted, not rejected.
              return !symmetric || id.infog[11] == 0;
            if (error == -10)
              return false; // singular
            if (error != -8 && error != -9)
              check("factorisation");
            // The workspace is too small. If much more does not help, nearly
            // all pivots are delayed because they are close to zero: the matrix
            // is singular.
            if (attempt == 7)
              {
                icntl(14) = usual_workspace;
                return false;
              }
            icntl(14) *= 2;
          }
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        id.nrhs = n_columns;
        if (serial)
          {
            id.rhs  = x.data();
            id.lrhs = id.n;
            call(3);
            check("solve");
            return;
          }
        id.nloc_rhs = own_rows.size();
        id.lrhs_loc = std::max<int>(1, id.nloc_rhs);
        id.irhs_loc = own_rows.data();
        id.rhs_loc  = x.data();
        id.lsol_loc = std::max<int>(1, id.info[22]);
        solved.resize(std::size_t(id.lsol_loc) * n_columns);
        solved_rows.resize(id.lsol_loc);
        id.sol_loc  = solved.data();
        id.isol_loc = solved_rows.data();
        call(3);
        check("solve");
        send_to_owners(n_columns, x);
      }

      std::string
      name() const override
      {
        return "Mumps";
      }

      bool
      wants_one_triangle() const override
      {
        return symmetric;
      }

    private:
      void
      call(const int job)
      {
        id.job = job;
        dmumps_c(&id);
      }

      /** @throws RunError if the last call failed, the same on all ranks */
      void
      check(const std::string &what) const
      {
        const int error = id.infog[0];
        if (error >= 0)
          return;
        if (error == -90)
          throw RunError(
            std::string("Mumps: factors cannot be written to or read from "
                        "files in '") +
            id.ooc_tmpdir +
            "'\n  remedy:  make room there, or set another 'Linear "
            "solver/Out-of-core folder'");
        fail("Mumps: " + what + " failed with error " + std::to_string(error));
      }

      MUMPS_INT &
      icntl(const int i)
      {
        return id.icntl[i - 1];
      }

      /** Sends the rows of the solution to their owners. Collective. */
      void
      send_to_owners(const unsigned int n_columns, std::vector<double> &x) const
      {
        const unsigned int n_ranks = first_row.size() - 1;
        const unsigned int n       = id.info[22]; // rows solved here
        // Each row: its number and its values.
        const unsigned int size = 1 + n_columns;
        std::vector<int>   owner(n), n_sent(n_ranks, 0), n_taken(n_ranks);
        for (unsigned int i = 0; i < n; ++i)
          {
            owner[i] = std::upper_bound(first_row.begin(),
                                        first_row.end(),
                                        solved_rows[i] - 1) -
                       first_row.begin() - 1;
            n_sent[owner[i]] += size;
          }
        MPI_Alltoall(
          n_sent.data(), 1, MPI_INT, n_taken.data(), 1, MPI_INT, comm);
        std::vector<int> from(n_ranks + 1, 0), to(n_ranks + 1, 0);
        std::partial_sum(n_sent.begin(), n_sent.end(), from.begin() + 1);
        std::partial_sum(n_taken.begin(), n_taken.end(), to.begin() + 1);
        std::vector<double> sent(from.back()), taken(to.back());
        std::vector<int>    next = from;
        for (unsigned int i = 0; i < n; ++i)
          {
            double *row = &sent[next[owner[i]]];
            next[owner[i]] += size;
            *row = solved_rows[i] - 1;
            for (unsigned int c = 0; c < n_columns; ++c)
              *++row = solved[std::size_t(id.lsol_loc) * c + i];
          }
        MPI_Alltoallv(sent.data(),
                      n_sent.data(),
                      from.data(),
                      MPI_DOUBLE,
                      taken.data(),
                      n_taken.data(),
                      to.data(),
                      MPI_DOUBLE,
                      comm);
        const std::size_t n_own = own_rows.size();
        for (std::size_t k = 0; k < taken.size(); k += size)
          {
            const std::size_t row = taken[k] - (own_rows[0] - 1);
            for (unsigned int c = 0; c < n_columns; ++c)
              x[n_own * c + row] = taken[k + 1 + c];
          }
      }

      static constexpr MUMPS_INT usual_workspace = 40; ///< increase in per cent

      const MPI_Comm   comm;
      const bool       symmetric, serial;
      DMUMPS_STRUC_C   id;
      std::vector<int> rows, columns;
      std::vector<int> first_row; ///< owned rows of each rank, and the total
      std::vector<MUMPS_INT> own_rows; ///< counted from 1, as all rows here
      std::vector<MUMPS_INT> solved_rows;
      std::vector<double>    solved;
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_mumps(const MPI_Comm     comm,
             const bool         symmetric,
             const std::string &folder)
  {
    return std::make_unique<Mumps>(comm, symmetric, folder);
  }
} // namespace geocone
