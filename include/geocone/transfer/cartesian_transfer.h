// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_cartesian_transfer_h
#define geocone_transfer_cartesian_transfer_h

#include <geocone/base/lexicographic.h>
#include <geocone/space/cartesian_grid.h>
#include <geocone/transfer/grid_transfer.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Transfer on a uniform grid, where cells are found by a multiplication. Each
   * rank owns a slab of columns (in space: of slices). Slabs are chosen anew in
   * each sort() such that the numbers of points are about equal. Columns of
   * nodes are contiguous, so that the nodes shared by two ranks are contiguous
   * in memory. Only the nodes around the points are stored.
   */
  class CartesianTransfer : public GridTransfer
  {
  public:
    /**
     * @param conditions the prescribed velocities, on sides of the grid
     * @param first_stage whose conditions act
     * @throws InputError for sides that are not sides of the grid
     */
    CartesianTransfer(const MPI_Comm            comm,
                      const CartesianGrid      &grid,
                      const BoundaryConditions &conditions,
                      const std::string        &first_stage);

    void
    sort(std::vector<PointArrays> &groups) override;

    bool
    begin_stage(const std::string &stage) override;

    bool
    must_sort(const PassSums &sums) const override;

    void
    gather(const TransferBlock &points, BlockScratch &scratch) override;
    void
    gather_values(const TransferBlock &points, BlockScratch &scratch) override;
    void
    gather_affine(const TransferBlock &points, BlockScratch &scratch) override;
    void
    scatter(const TransferBlock &points,
            BlockScratch        &scratch,
            const bool           with_mass) override;
    void
    scatter_values(const TransferBlock &points,
                   BlockScratch        &scratch,
                   const bool           with_mass) override;
    void
    scatter_affine(const TransferBlock &points, BlockScratch &scratch) override;
    void
    find_cells(const TransferBlock &points, unsigned int *cells) const override;
    void
    exchange_cells() override;
    std::size_t
    n_stored_cells() const override;

    void
    exchange(const bool with_mass) override;

    bool
    reaches(const dealii::Point<dim> &x) const override;
    dealii::Point<dim>
    stored_place() const override;
    dealii::Point<dim>
    nearest_in_domain(const dealii::Point<dim> &x) const override;

    double
    cell_size() const override
    {
      return grid.cell_size();
    }
    unsigned long
    n_all_nodes() const override
    {
      return grid.n_functions();
    }
    unsigned long
    n_cells() const override
    {
      return grid.n_cells();
    }
    std::size_t
    memory() const override;
    std::string
    description() const override;

  private:
    /** A half-open range of cells or functions in a direction. */
    struct Range
    {
      int begin = 0, end = 0;
      int
      size() const
      {
        return end - begin;
      }
    };

    /** Divides the columns of cells into slabs with about equal numbers of
     *  points. */
    void
    cut_slabs(const std::vector<PointArrays> &groups);

    /** Sends points outside this rank's slab to their ranks. */
    void
    migrate(std::vector<PointArrays> &groups) const;

    void
    sort_by_cell(std::vector<PointArrays> &groups);

    /** Chooses the stored functions and finds the prescribed ones among
     *  them. */
    void
    store_nodes();

    /** Number of stored functions per column. */
    std::size_t
    column_size() const;

    /** Nodal values of all stored nodes, with their number per node. */
    struct Shared
    {
      double      *values;
      unsigned int per_node;
    };

    /** Sums arrays over the ranks that share columns. Collective. */
    void
    sum_over_ranks(const std::vector<Shared> &arrays);

    /** Numbers of functions along the axes. */
    GridIndex
    n_functions() const;

    /** Index of a function among the stored ones. @pre it is one of them */
    std::size_t
    stored_place_of(const std::array<unsigned int, dim> &function) const;

    GridView
    view(const bool with_mass);

    const MPI_Comm         comm;
    const unsigned int     rank, n_ranks;
    const CartesianGrid    grid;
    const TransferKernels &kernels;

    const BoundaryConditions &conditions;
    std::vector<bool>         acts; ///< per condition

    /** Components prescribed by conditions, and by which of them, for functions
     *  of the whole grid, by number_in_grid(). */
    std::vector<std::vector<PrescribedNode>> prescribed_functions;

    std::vector<int>   slab_begin;     ///< first column of cells of each rank
    Range              cells[dim];     ///< range of this rank's points
    Range              stored[dim];    ///< functions; `read` etc. begin here
    std::vector<Range> stored_columns; ///< of all ranks

    std::vector<unsigned int>        count, order;  ///< of sort_by_cell()
    std::vector<std::vector<double>> receive, sent; ///< of exchange()
  };
} // namespace geocone::GEOCONE_DIM

#endif
