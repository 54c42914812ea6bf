// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/linear_solver.h>

#include <umfpack.h>

namespace geocone
{
  namespace
  {
    /** Unsymmetric multifrontal LU factorisation of SuiteSparse. */
    class Umfpack : public LinearSolver
    {
    public:
      Umfpack()
      {
        umfpack_di_defaults(control);
        // The pattern is symmetric and the diagonal large; AMD on A + A' was
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
          fail(status == UMFPACK_ERROR_out_of_memory
                 ? "Umfpack: out of memory"
                 : "Umfpack: error " + std::to_string(status));
      }

      const SparseMatrix *matrix   = nullptr;
      void               *symbolic = nullptr;
      void               *numeric  = nullptr;
      double              control[UMFPACK_CONTROL];
      double              info[UMFPACK_INFO];
      std::vector<int>    work_i;
      std::vector<double> work_d;
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_umfpack()
  {
    return std::make_unique<Umfpack>();
  }
} // namespace geocone
