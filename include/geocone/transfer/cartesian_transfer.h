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
   * Transfer between material points and nodes on a uniform grid. Cell indices
   * are computed directly from positions. Each rank owns a slab of columns
   * (slices in three dimensions). Each sort() selects slabs with about equal
   * numbers of points. A column of nodes is contiguous in memory, and so are
   * the nodes shared by two ranks. Only the nodes around the points are stored.
   */
  class CartesianTransfer : public GridTransfer
  {
  public:
    /**
     * Stores the grid and the prescribed velocities on its sides.
     * @param conditions prescribed velocities on sides of the grid
     * @param first_stage first stage, whose boundary conditions are active
     * @throws InputError if a condition is not on a side of the grid
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

    std::vector<dealii::Point<dim>>
    node_positions() const override;
    void
    for_each_node(
      const PointArrays                             &group,
      const unsigned int                             number_of_group,
      const unsigned int                             p,
      const std::function<void(const unsigned int)> &f) const override;
    void
    minimise_over_ranks(std::vector<double> &values) override;

    bool
    covers(const dealii::Point<dim> &x) const override;
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
    /** Half-open range [begin, end) of cells or basis functions in one
     *  direction. */
    struct Range
    {
      int begin = 0, end = 0;
      int
      size() const
      {
        return end - begin;
      }
    };

    /** Divides the cell columns into slabs, one per rank, with about equal
     *  numbers of points. */
    void
    cut_slabs(const std::vector<PointArrays> &groups);

    /** Sends each point outside the slab of this rank to the rank that owns its
     *  position. */
    void
    migrate(std::vector<PointArrays> &groups) const;

    void
    sort_by_cell(std::vector<PointArrays> &groups);

    /** Selects the nodes to be stored and makes a list of those with prescribed
     *  velocities. */
    void
    store_nodes();

    /** Returns the number of stored nodes per grid column. */
    std::size_t
    column_size() const;

    /** Array of nodal data, with per_node values for each stored node. */
    struct Shared
    {
      double      *values;
      unsigned int per_node;
    };

    /** Columns shared with each other rank, with all their rows; at this rank's
     *  place, the range that contains them all, which may be empty. */
    std::vector<Range>
    shared_columns() const;

    /** Combines nodal arrays over the ranks that share node columns. Collective.
     *  @param identity value that does not change another one
     *  @param combine sum or minimum of two values */
    template <typename Combine>
    void
    combine_over_ranks(const std::vector<Shared> &arrays,
                       const double               identity,
                       const Combine             &combine);

    void
    sum_over_ranks(const std::vector<Shared> &arrays);

    /** Returns the number of basis functions along each axis. */
    GridIndex
    n_functions() const;

    /** Returns the index of a basis function among the stored basis functions.
     *  @pre the function is stored */
    std::size_t
    stored_index_of(const std::array<unsigned int, dim> &function) const;

    GridView
    view(const bool with_mass);

    const MPI_Comm         comm;
    const unsigned int     rank, n_ranks;
    const CartesianGrid    grid;
    const TransferKernels &kernels;

    const BoundaryConditions &conditions;
    std::vector<bool>         acts; ///< true for active conditions

    /** Velocity component that a condition prescribes on a side of the grid. */
    struct HeldComponent
    {
      PrescribedNode node;
      bool           is_normal; ///< along the normal of the side
    };

    /** Prescribed velocity components of each basis function, in the order of the
     *  boundary conditions. Basis functions of the whole grid are indexed by
     *  number_in_grid(). */
    std::vector<std::vector<HeldComponent>> prescribed_functions;

    std::vector<int>   slab_begin;     ///< first cell column of each rank
    Range              cells[dim];     ///< cells with points of this rank
    Range              stored[dim];    ///< nodes stored in `read` etc.
    std::vector<Range> stored_columns; ///< stored node columns, all ranks

    std::vector<unsigned int>        count, order;  ///< for sort_by_cell()
    std::vector<std::vector<double>> receive, sent; ///< for exchange()
  };
} // namespace geocone::GEOCONE_DIM

#endif
