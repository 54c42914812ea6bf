// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <cholmod.h>
#include <dmumps_c.h>
#include <umfpack.h>

#include <cstring>

namespace geocone
{
  namespace
  {
    /** Where a factorisation ends for want of memory, or for no known reason. */
    const std::string remedy = "\n  remedy:  take fewer cells, more memory or "
                               "more ranks, or another 'Linear solver/Name'";

    /** SuiteSparse's supernodal Cholesky factorisation. */
    class Cholmod : public LinearSolver
    {
    public:
      Cholmod()
      {
        cholmod_start(&common);
        common.print                      = 0;
        common.quick_return_if_not_posdef = 1;
        // Nested dissection by Metis: 25 % less time per factorisation than
        // AMD on the meshes of doc/performance.md.
        common.nmethods           = 1;
        common.method[0].ordering = CHOLMOD_NESDIS;
      }

      ~Cholmod() override
      {
        cholmod_free_factor(&factor, &common);
        cholmod_free_dense(&solution, &common);
        cholmod_free_dense(&work_y, &common);
        cholmod_free_dense(&work_e, &common);
        cholmod_finish(&common);
      }

      void
      analyse(const SparseMatrix &matrix) override
      {
        cholmod_free_factor(&factor, &common);
        cholmod_sparse A = view(matrix);
        factor           = cholmod_analyze(&A, &common);
      }

      bool
      factorise(const SparseMatrix &matrix) override
      {
        cholmod_sparse A = view(matrix);
        cholmod_factorize(&A, factor, &common);
        if (common.status == CHOLMOD_OUT_OF_MEMORY)
          throw RunError("Cholmod: out of memory" + remedy);
        return common.status == CHOLMOD_OK && factor->minor == factor->n;
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        cholmod_dense b;
        std::memset(&b, 0, sizeof(b));
        b.nrow = b.d = x.size() / n_columns;
        b.nzmax      = x.size();
        b.ncol       = n_columns;
        b.x          = x.data();
        b.xtype      = CHOLMOD_REAL;
        b.dtype      = CHOLMOD_DOUBLE;
        cholmod_solve2(CHOLMOD_A,
                       factor,
                       &b,
                       nullptr,
                       &solution,
                       nullptr,
                       &work_y,
                       &work_e,
                       &common);
        std::memcpy(x.data(), solution->x, x.size() * sizeof(double));
      }

      std::string
      name() const override
      {
        return "Cholmod";
      }

      bool
      wants_one_triangle() const override
      {
        return true;
      }

    private:
      /** Compressed rows of the lower are compressed columns of the upper. */
      static cholmod_sparse
      view(const SparseMatrix &matrix)
      {
        cholmod_sparse A;
        std::memset(&A, 0, sizeof(A));
        A.nrow = A.ncol = matrix.n_rows();
        A.nzmax         = matrix.column.size();
        A.p             = const_cast<int *>(matrix.row_start.data());
        A.i             = const_cast<int *>(matrix.column.data());
        A.x             = const_cast<double *>(matrix.value.data());
        A.stype         = 1; // the upper triangle
        A.itype         = CHOLMOD_INT;
        A.xtype         = CHOLMOD_REAL;
        A.dtype         = CHOLMOD_DOUBLE;
        A.sorted        = 1;
        A.packed        = 1;
        return A;
      }

      cholmod_common  common;
      cholmod_factor *factor   = nullptr;
      cholmod_dense  *solution = nullptr;
      cholmod_dense  *work_y   = nullptr;
      cholmod_dense  *work_e   = nullptr;
    };

    /** SuiteSparse's unsymmetric multifrontal LU factorisation. */
    class Umfpack : public LinearSolver
    {
    public:
      Umfpack()
      {
        umfpack_di_defaults(control);
        // The pattern is symmetric and the diagonal heavy; AMD on A + A' was
        // measured to be the best ordering (doc/performance.md).
        control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
        control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
        control[UMFPACK_IRSTEP]   = 1;
      }

      ~Umfpack() override
      {
        umfpack_di_free_numeric(&numeric);
        umfpack_di_free_symbolic(&symbolic);
      }

      void
      analyse(const SparseMatrix &matrix) override
      {
        umfpack_di_free_symbolic(&symbolic);
        check(umfpack_di_symbolic(matrix.n_rows(),
                                  matrix.n_rows(),
                                  matrix.row_start.data(),
                                  matrix.column.data(),
                                  nullptr,
                                  &symbolic,
                                  control,
                                  info));
      }

      bool
      factorise(const SparseMatrix &matrix_) override
      {
        matrix = &matrix_;
        umfpack_di_free_numeric(&numeric);
        const int status = umfpack_di_numeric(matrix->row_start.data(),
                                              matrix->column.data(),
                                              matrix->value.data(),
                                              symbolic,
                                              &numeric,
                                              control,
                                              info);
        if (status == UMFPACK_WARNING_singular_matrix)
          return false;
        check(status);
        return true;
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        const std::vector<double> b = x;
        const std::size_t         n = x.size() / n_columns;
        work_i.resize(n);
        work_d.resize(5 * n);
        // Compressed rows are the columns of the transposed matrix.
        for (unsigned int c = 0; c < n_columns; ++c)
          check(umfpack_di_wsolve(UMFPACK_At,
                                  matrix->row_start.data(),
                                  matrix->column.data(),
                                  matrix->value.data(),
                                  x.data() + c * n,
                                  b.data() + c * n,
                                  numeric,
                                  control,
                                  info,
                                  work_i.data(),
                                  work_d.data()));
      }

      std::string
      name() const override
      {
        return "Umfpack";
      }

      bool
      wants_one_triangle() const override
      {
        return false;
      }

    private:
      static void
      check(const int status)
      {
        if (status < 0)
          throw RunError((status == UMFPACK_ERROR_out_of_memory
                            ? std::string("Umfpack: out of memory")
                            : "Umfpack: error " + std::to_string(status)) +
                         remedy);
      }

      const SparseMatrix *matrix   = nullptr;
      void               *symbolic = nullptr;
      void               *numeric  = nullptr;
      double              control[UMFPACK_CONTROL];
      double              info[UMFPACK_INFO];
      std::vector<int>    work_i;
      std::vector<double> work_d;
    };

    /** MUMPS: each rank hands over its own contributions, which MUMPS adds. */
    class Mumps : public LinearSolver
    {
    public:
      Mumps(const MPI_Comm comm, const bool symmetric)
        : comm(comm)
        , symmetric(symmetric)
        , rank(dealii::Utilities::MPI::this_mpi_process(comm))
      {
        std::memset(&id, 0, sizeof(id));
        id.comm_fortran = MPI_Comm_c2f(comm);
        id.par          = 1;
        id.sym          = symmetric ? 1 : 0; // 1: positive definite
        call(-1);
        for (int i = 1; i <= 4; ++i)
          icntl(i) = i == 4 ? 0 : -1; // silent
        icntl(14) = 40;               // per cent of extra workspace
        icntl(18) = 3;                // distributed assembled entries
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
        if (id.infog[0] < 0)
          throw RunError("Mumps: analysis failed with error " +
                         std::to_string(id.infog[0]) + remedy);

        const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
        counts.resize(n_ranks);
        offsets.assign(n_ranks, 0);
        MPI_Allgather(
          &matrix.n_owned, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
        for (int r = 1; r < n_ranks; ++r)
          offsets[r] = offsets[r - 1] + counts[r - 1];
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
              // With id.sym = 1 negative pivots are not refused, but counted.
              return !symmetric || id.infog[11] == 0;
            if (error == -10)
              return false; // singular
            if ((error == -8 || error == -9) && attempt < 5)
              icntl(14) *= 2; // workspace too small
            else
              throw RunError("Mumps: factorisation failed with error " +
                             std::to_string(error) + remedy);
          }
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        const std::size_t n = x.size() / n_columns;
        if (rank == 0)
          rhs.resize(std::size_t(id.n) * n_columns);
        for (unsigned int c = 0; c < n_columns; ++c)
          MPI_Gatherv(x.data() + c * n,
                      n,
                      MPI_DOUBLE,
                      rhs.data() + c * std::size_t(id.n),
                      counts.data(),
                      offsets.data(),
                      MPI_DOUBLE,
                      0,
                      comm);
        id.rhs  = rhs.data();
        id.nrhs = n_columns;
        id.lrhs = id.n;
        call(3);
        if (id.infog[0] < 0)
          throw RunError("Mumps: solve failed with error " +
                         std::to_string(id.infog[0]) + remedy);
        for (unsigned int c = 0; c < n_columns; ++c)
          MPI_Scatterv(rhs.data() + c * std::size_t(id.n),
                       counts.data(),
                       offsets.data(),
                       MPI_DOUBLE,
                       x.data() + c * n,
                       n,
                       MPI_DOUBLE,
                       0,
                       comm);
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

      MUMPS_INT &
      icntl(const int i)
      {
        return id.icntl[i - 1];
      }

      const MPI_Comm      comm;
      const bool          symmetric;
      const int           rank;
      DMUMPS_STRUC_C      id;
      std::vector<int>    rows, columns;
      std::vector<double> rhs; ///< of all rows, on rank 0
      std::vector<int>    counts, offsets;
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_linear_solver(const std::string &name,
                     const MPI_Comm     comm,
                     const bool         symmetric)
  {
    const bool serial = dealii::Utilities::MPI::n_mpi_processes(comm) == 1;
    const std::string chosen = name != "automatic" ? name
                               : !serial           ? "Mumps"
                               : symmetric         ? "Cholmod"
                                                   : "Mumps";
    if (chosen != "Mumps" && !serial)
      throw InputError("Linear solver/Name",
                       name,
                       "automatic | Mumps on several ranks",
                       "take automatic, or one rank");
    if (chosen == "Cholmod" && !symmetric)
      throw InputError("Linear solver/Name",
                       name,
                       "automatic | Umfpack | Mumps with non-associated flow",
                       "its Jacobian is not symmetric: take automatic");
    if (chosen == "Cholmod")
      return std::make_unique<Cholmod>();
    if (chosen == "Umfpack")
      return std::make_unique<Umfpack>();
    return std::make_unique<Mumps>(comm, symmetric);
  }
} // namespace geocone
