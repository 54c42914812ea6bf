// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/linear/linear_solver.h>

#include <cholmod.h>

#include <cstring>
#include <type_traits>

namespace geocone
{
  namespace
  {
    using IndexSize = LinearSolverParameters::IndexSize;

    /** The library's functions for each integer size. */
    template <typename Index>
    struct Library;

    template <>
    struct Library<int>
    {
      static constexpr int  itype       = CHOLMOD_INT;
      static constexpr auto start       = &cholmod_start;
      static constexpr auto finish      = &cholmod_finish;
      static constexpr auto analyze     = &cholmod_analyze;
      static constexpr auto factorize   = &cholmod_factorize;
      static constexpr auto solve       = &cholmod_solve2;
      static constexpr auto free_factor = &cholmod_free_factor;
      static constexpr auto free_dense  = &cholmod_free_dense;
    };

    template <>
    struct Library<SuiteSparse_long>
    {
      static constexpr int  itype       = CHOLMOD_LONG;
      static constexpr auto start       = &cholmod_l_start;
      static constexpr auto finish      = &cholmod_l_finish;
      static constexpr auto analyze     = &cholmod_l_analyze;
      static constexpr auto factorize   = &cholmod_l_factorize;
      static constexpr auto solve       = &cholmod_l_solve2;
      static constexpr auto free_factor = &cholmod_l_free_factor;
      static constexpr auto free_dense  = &cholmod_l_free_dense;
    };

    /** Memory of the library for a matrix and its factors. */
    template <typename Index>
    class Factors
    {
      using Functions = Library<Index>;

    public:
      Factors()
      {
        Functions::start(&common);
        common.print                      = 0;
        common.quick_return_if_not_posdef = 1;
        // Nested dissection by Metis: 25 % less time per factorisation than
        // AMD on the meshes of doc/performance.md.
        common.nmethods           = 1;
        common.method[0].ordering = CHOLMOD_NESDIS;
      }
      Factors(const Factors &) = delete;
      Factors &
      operator=(const Factors &) = delete;

      ~Factors()
      {
        Functions::free_factor(&factor, &common);
        Functions::free_dense(&solution, &common);
        Functions::free_dense(&work_y, &common);
        Functions::free_dense(&work_e, &common);
        Functions::finish(&common);
      }

      /** Analyses the pattern. @return whether the integers can count the
       *  factors */
      bool
      analyse(const SparseMatrix &matrix)
      {
        if constexpr (!std::is_same_v<Index, int>)
          {
            row_start.assign(matrix.row_start.begin(), matrix.row_start.end());
            column.assign(matrix.column.begin(), matrix.column.end());
          }
        Functions::free_factor(&factor, &common);
        cholmod_sparse A = view(matrix);
        factor           = Functions::analyze(&A, &common);
        if (common.status == CHOLMOD_TOO_LARGE)
          return false;
        if (common.status == CHOLMOD_OUT_OF_MEMORY)
          LinearSolver::fail("Cholmod: out of memory");
        if (factor == nullptr)
          LinearSolver::fail("Cholmod: analysis failed with error " +
                             std::to_string(common.status));
        return true;
      }

      bool
      factorise(const SparseMatrix &matrix)
      {
        cholmod_sparse A = view(matrix);
        Functions::factorize(&A, factor, &common);
        if (common.status == CHOLMOD_OUT_OF_MEMORY)
          LinearSolver::fail("Cholmod: out of memory");
        return common.status == CHOLMOD_OK && factor->minor == factor->n;
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns)
      {
        cholmod_dense b;
        std::memset(&b, 0, sizeof(b));
        b.nrow = b.d = x.size() / n_columns;
        b.nzmax      = x.size();
        b.ncol       = n_columns;
        b.x          = x.data();
        b.xtype      = CHOLMOD_REAL;
        b.dtype      = CHOLMOD_DOUBLE;
        if (!Functions::solve(CHOLMOD_A,
                              factor,
                              &b,
                              nullptr,
                              &solution,
                              nullptr,
                              &work_y,
                              &work_e,
                              &common))
          LinearSolver::fail("Cholmod: out of memory");
        std::memcpy(x.data(), solution->x, x.size() * sizeof(double));
      }

    private:
      /** View of the matrix: compressed rows of the lower triangle are
       *  compressed columns of the upper. */
      cholmod_sparse
      view(const SparseMatrix &matrix) const
      {
        cholmod_sparse A;
        std::memset(&A, 0, sizeof(A));
        A.nrow = A.ncol = matrix.n_rows();
        A.nzmax         = matrix.column.size();
        if constexpr (std::is_same_v<Index, int>)
          {
            A.p = const_cast<int *>(matrix.row_start.data());
            A.i = const_cast<int *>(matrix.column.data());
          }
        else
          {
            A.p = const_cast<Index *>(row_start.data());
            A.i = const_cast<Index *>(column.data());
          }
        A.x      = const_cast<double *>(matrix.value.data());
        A.stype  = 1; // the upper triangle
        A.itype  = Functions::itype;
        A.xtype  = CHOLMOD_REAL;
        A.dtype  = CHOLMOD_DOUBLE;
        A.sorted = 1;
        A.packed = 1;
        return A;
      }

      cholmod_common     common;
      cholmod_factor    *factor   = nullptr;
      cholmod_dense     *solution = nullptr;
      cholmod_dense     *work_y   = nullptr;
      cholmod_dense     *work_e   = nullptr;
      std::vector<Index> row_start,
        column; ///< of the matrix, if converted
    };

    /** Supernodal Cholesky factorisation of SuiteSparse. */
    class Cholmod : public LinearSolver
    {
    public:
      explicit Cholmod(const IndexSize size)
        : size(size)
      {}

      void
      analyse(const SparseMatrix &matrix) override
      {
        small.reset();
        large.reset();
        if (size != IndexSize::bits_64)
          {
            small = std::make_unique<Factors<int>>();
            if (small->analyse(matrix))
              return;
            small.reset();
            if (size == IndexSize::bits_32)
              fail("Cholmod: the factors have more entries than 32 bits count; "
                   "set Linear solver/Index size = automatic");
          }
        large = std::make_unique<Factors<SuiteSparse_long>>();
        if (!large->analyse(matrix))
          fail("Cholmod: the factors have more entries than 64 bits count");
      }

      bool
      factorise(const SparseMatrix &matrix) override
      {
        return small ? small->factorise(matrix) : large->factorise(matrix);
      }

      void
      solve(std::vector<double> &x, const unsigned int n_columns) override
      {
        small ? small->solve(x, n_columns) : large->solve(x, n_columns);
      }

      std::string
      name() const override
      {
        return large ? "Cholmod, 64 bits" : "Cholmod";
      }

      bool
      wants_one_triangle() const override
      {
        return true;
      }

    private:
      const IndexSize size;

      /** Exactly one of them is used. */
      std::unique_ptr<Factors<int>>              small;
      std::unique_ptr<Factors<SuiteSparse_long>> large;
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_cholmod(const IndexSize size)
  {
    return std::make_unique<Cholmod>(size);
  }
} // namespace geocone
