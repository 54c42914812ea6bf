// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_linear_preconditioner_h
#define geocone_linear_preconditioner_h

#include <geocone/base/sparse_matrix.h>
#include <geocone/linear/nodal_rows.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  class LinearSolver;

  /** Distributed vector with one entry per row of a SparseMatrix. */
  using RowVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** Sparse matrix as a linear operator on distributed vectors. The matrix must
   *  outlive the operator. */
  class RowOperator
  {
  public:
    /** Sets the matrix. Collective. */
    void
    reinit(const SparseMatrix &matrix);

    /** Computes the product of the matrix and a vector. */
    void
    vmult(RowVector &product, const RowVector &x) const;

    /** Parallel layout of the rows: owned rows, and the other local rows as
     *  ghosts. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    layout() const
    {
      return rows;
    }

    /** Index of a local row in a vector with this layout. */
    unsigned int
    place(const int row) const
    {
      return row < matrix->n_owned ? row : ghosts[row - matrix->n_owned];
    }

  private:
    const SparseMatrix                                        *matrix = nullptr;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> rows;
    std::vector<unsigned int> ghosts; ///< place(), from the first ghost on

    /**
     * Multiplies the n rows of a node, which share their columns. The
     * transposed entries of the lower triangle are added to the rows above.
     * @param x, y of all local rows
     */
    template <int n>
    void
    multiply_rows(const int first, const double *x, double *y) const;
  };

  /**
   * Interface of preconditioners for sparse linear systems. Call analyse() once
   * per sparsity pattern and factorise() once per matrix. The matrix must
   * outlive the last vmult().
   */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    virtual void
    analyse(const SparseMatrix &matrix, NodalRows nodes) = 0;

    /** Sets up the preconditioner of a matrix with the analysed pattern.
     *  @return false if this is impossible; the same on all ranks */
    [[nodiscard]] virtual bool
    factorise(const SparseMatrix &matrix) = 0;

    /** Applies the preconditioner, a linear operator. */
    virtual void
    vmult(RowVector &x, const RowVector &b) const = 0;

    /** Changes a preconditioner of a symmetric matrix that conjugate gradients
     *  have found to be indefinite.
     *  @return false if this is impossible */
    [[nodiscard]] virtual bool
    make_definite()
    {
      return false;
    }

    /** Returns true if the matrix may be stored compactly: rows of a node share
     *  their columns, and a symmetric matrix has one triangle. */
    virtual bool
    takes_compact_matrix() const
    {
      return false;
    }

    virtual std::string
    name() const = 0;
  };

  /** Creates a V-cycle of smoothed aggregation (Trilinos' ML). Nodes are
   *  aggregated, with the rigid-body modes as near-nullspace. */
  std::unique_ptr<Preconditioner>
  make_aggregation(const MPI_Comm comm, const bool symmetric);

  /**
   * Creates a V-cycle of multigrid on polynomial degrees. The fine level is
   * smoothed by Chebyshev polynomials of the block-Jacobi preconditioned
   * matrix. The coarse level are linear shape functions on the vertices of the
   * same mesh.
   * @param direct solver of coarse systems
   * @param aggregation preconditioner that replaces the direct solver in large
   * coarse systems
   */
  std::unique_ptr<Preconditioner>
  make_p_multigrid(const bool                      symmetric,
                   std::unique_ptr<LinearSolver>   direct,
                   std::unique_ptr<Preconditioner> aggregation);
} // namespace geocone

#endif
