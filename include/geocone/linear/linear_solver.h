// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_linear_solver_h
#define geocone_linear_linear_solver_h

#include <geocone/base/choice.h>
#include <geocone/base/sparse_matrix.h>
#include <geocone/linear/nodal_rows.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  class Preconditioner;

  /** Iteration counts of an iterative linear solver, since the start of the
   *  run. */
  struct LinearIterations
  {
    unsigned int systems  = 0; ///< right-hand sides solved by iterations
    unsigned int total    = 0; ///< iterations for these right-hand sides
    unsigned int most     = 0; ///< for one right-hand side
    unsigned int directly = 0; ///< matrices left to the direct solver
    unsigned int stopped  = 0; ///< solutions above the tolerance
    unsigned int hard = 0; ///< these, or after half of the allowed iterations
  };

  /**
   * Interface of solvers for sparse linear systems. Call analyse() once per
   * sparsity pattern and factorise() once per matrix. The matrix must outlive
   * the last solve() with its factorisation.
   */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /** Performs the symbolic factorisation for the sparsity pattern of a
     *  matrix. */
    virtual void
    analyse(const SparseMatrix &matrix) = 0;

    /**
     * Computes the numerical factorisation of a matrix with the analysed
     * sparsity pattern.
     * @return false if the matrix is singular or, for a Cholesky factorisation,
     * not positive definite; the same on all ranks
     */
    [[nodiscard]] virtual bool
    factorise(const SparseMatrix &matrix) = 0;

    /**
     * Solves the linear system for a set of right-hand sides. The solutions
     * replace the right-hand sides.
     * @param x owned rows, column by column
     */
    virtual void
    solve(std::vector<double> &x, const unsigned int n_columns = 1) = 0;

    /** Returns true if set_nodal_rows() must be called before analyse(). */
    virtual bool
    wants_nodal_rows() const
    {
      return false;
    }

    virtual void
    set_nodal_rows(NodalRows)
    {}

    /** Returns true if the solver uses only the lower triangle of a symmetric
     *  matrix. */
    virtual bool
    wants_one_triangle() const = 0;

    /** Returns true if the rows of a node may share their columns
     *  (SparseMatrix::column_start). */
    virtual bool
    takes_shared_columns() const
    {
      return false;
    }

    virtual std::string
    name() const = 0;

    /**
     * Sets the tolerance of the next linear systems: residual relative to the
     * right-hand side. The solver may be more accurate; direct solvers ignore
     * the tolerance.
     */
    virtual void
    set_tolerance(const double)
    {}

    /** Returns the iteration counts of the solver; null for direct solvers. */
    virtual const LinearIterations *
    iterations() const
    {
      return nullptr;
    }

    /** Terminates the run because a linear solver has failed.
     *  @throws RunError */
    [[noreturn]] static void
    fail(const std::string &why);
  };

  /** Parameters of the linear solver: type, memory and iteration options. */
  class LinearSolverParameters : public dealii::ParameterAcceptor
  {
  public:
    LinearSolverParameters();

    enum class Name
    {
      automatic,
      cholmod,
      umfpack,
      mumps,
      multigrid,
      p_multigrid
    };
    Choice<Name> name = {{{"automatic", Name::automatic},
                          {"Cholmod", Name::cholmod},
                          {"Umfpack", Name::umfpack},
                          {"Mumps", Name::mumps},
                          {"multigrid", Name::multigrid},
                          {"p-multigrid", Name::p_multigrid}}};

    /** Returns true if the linear systems are solved by iterations. */
    bool
    is_iterative() const
    {
      return name == Name::multigrid || name == Name::p_multigrid;
    }

    /** Size (bits) of the integer indices in the factors computed by
     *  CHOLMOD. */
    enum class IndexSize
    {
      automatic,
      bits_32,
      bits_64
    };
    Choice<IndexSize> index_size = {{{"automatic", IndexSize::automatic},
                                     {"32", IndexSize::bits_32},
                                     {"64", IndexSize::bits_64}}};

    /** Options of MUMPS for storing factors on disk: switch and folder. */
    bool        out_of_core = false;
    std::string folder      = "/tmp";

    /** Options of the multigrid solvers: smallest and largest tolerance of the
     *  relative residual, and maximum number of iterations. */
    double       tolerance         = 1e-6;
    double       largest_tolerance = 1e-2;
    unsigned int max_iterations    = 200;

    /** Number of unknowns in three dimensions up to which direct solvers are
     *  used: by 'automatic', and for systems that exceed max_iterations. */
    unsigned int largest_direct = 300000;

    /**
     * Creates the selected linear solver. The following solvers are available:
     * - Cholmod: supernodal Cholesky of SuiteSparse; one rank, symmetric
     *   positive definite matrices (associated flow);
     * - Umfpack: unsymmetric multifrontal LU of SuiteSparse; one rank;
     * - Mumps: distributed multifrontal LU, or Cholesky if symmetric;
     * - multigrid: Krylov method with smoothed aggregation of Trilinos' ML, and
     *   the direct solver of 'automatic' if it does not converge;
     * - p-multigrid: the same with linear shape functions on the mesh as the
     *   coarse level, for finite elements of higher degree;
     * - automatic: Cholmod for symmetric matrices in memory on one rank,
     *   otherwise Mumps, which is faster than Umfpack (doc/performance.md).
     *
     * @param on_degrees whether to create p-multigrid; it requires nodal rows
     * with an interpolation from the vertices
     * @throws InputError for unsupported combinations
     */
    std::unique_ptr<LinearSolver>
    make(const MPI_Comm comm,
         const bool     symmetric,
         const bool     on_degrees = false) const;

    /**
     * Returns true if p-multigrid is selected, by name or by 'automatic'.
     * @param n_dofs number of degrees of freedom on all ranks if 'automatic'
     * may select p-multigrid, otherwise zero
     */
    bool
    selects_p_multigrid(const std::size_t n_dofs) const;

  private:
    std::unique_ptr<LinearSolver>
    make_direct(Name chosen, const MPI_Comm comm, const bool symmetric) const;
  };

  /** @name Creation of the linear solvers */
  /** @{ */

  /** Creates the CHOLMOD solver (sparse Cholesky factorisation). @param size
   *  size of the integers; automatic: smallest size sufficient for the
   *  factors */
  std::unique_ptr<LinearSolver>
  make_cholmod(const LinearSolverParameters::IndexSize size);

  std::unique_ptr<LinearSolver>
  make_umfpack();

  /** Creates the MUMPS solver (distributed multifrontal factorisation).
   *  @param folder folder for factors on disk; empty: factors in memory */
  std::unique_ptr<LinearSolver>
  make_mumps(const MPI_Comm     comm,
             const bool         symmetric,
             const std::string &folder);

  /** Creates a Krylov solver with a preconditioner: conjugate gradients, or
   *  GMRES for non-symmetric matrices. See LinearSolverParameters for the
   *  tolerances.
   *  @param direct direct solver for systems that exceed max_iterations, up
   *  to largest_direct unknowns in three dimensions */
  std::unique_ptr<LinearSolver>
  make_iterative(const bool                      symmetric,
                 const LinearSolverParameters   &parameters,
                 std::unique_ptr<Preconditioner> preconditioner,
                 std::unique_ptr<LinearSolver>   direct);
  /** @} */
} // namespace geocone

#endif
