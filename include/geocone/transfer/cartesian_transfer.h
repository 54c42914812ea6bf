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
   * The transfer on a uniform grid, which finds cells by a multiplication. Ranks
   * own slabs of columns, cut such that each has about the same number of points,
   * anew in each sort(); in space, of slices. Columns of nodes are contiguous, so that what two
   * ranks share is one piece of memory. Only the nodes around the points are
   * stored.
   */
  class CartesianTransfer : public GridTransfer
  {
  public:
    /**
     * @param conditions the prescribed velocities, on sides of the grid
     * @throws InputError for sides that the grid has not
     */
    CartesianTransfer(const MPI_Comm            comm,
                      const CartesianGrid      &grid,
                      const BoundaryConditions &conditions);

    void
    sort(std::vector<PointArrays> &groups) override;
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

    /** Cuts the columns of cells into slabs of about equal numbers of points. */
    void
    cut_slabs(const std::vector<PointArrays> &groups);

    /** Sends the points that are not in this rank's slab. */
    void
    migrate(std::vector<PointArrays> &groups) const;

    void
    sort_by_cell(std::vector<PointArrays> &groups);

    /** Chooses the stored functions, and the prescribed ones among them. */
    void
    store_nodes();

    /** Functions stored of a column. */
    std::size_t
    column_size() const;

    /** Values of all stored nodes, so many per node. */
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

    /** The place of a function among the stored ones. @pre it is one of them */
    std::size_t
    stored_place_of(const std::array<unsigned int, dim> &function) const;

    GridView
    view(const bool with_mass);

    const MPI_Comm         comm;
    const unsigned int     rank, n_ranks;
    const CartesianGrid    grid;
    const TransferKernels &kernels;

    /** Of the whole grid, by their numbers in it, number_in_grid(). */
    std::vector<PrescribedNode> prescribed_functions;

    std::vector<int>   slab_begin;  ///< first column of cells of each rank
    Range              cells[dim];  ///< where this rank's points may be
    Range              stored[dim]; ///< functions, from which `read` etc. begin
    std::vector<Range> stored_columns; ///< of all ranks

    std::vector<unsigned int>        count, order;  ///< of sort_by_cell()
    std::vector<std::vector<double>> receive, sent; ///< of exchange()
  };
} // namespace geocone::GEOCONE_DIM

#endif
