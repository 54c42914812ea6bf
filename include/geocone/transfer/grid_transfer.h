// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_grid_transfer_h
#define geocone_transfer_grid_transfer_h

#include <geocone/conditions/prescribed_node.h>
#include <geocone/points/point_arrays.h>
#include <geocone/scene/boundary_conditions.h>
#include <geocone/transfer/transfer_kernels.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/point.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodes of an explicit step and transfer between material points and nodes.
   * Each node has the same index in three arrays: node_size doubles to read,
   * node_size doubles to write, and a mass.
   *   read:  velocity and velocity increment of the step, read by the points;
   *   write: momentum and force, written by the points;
   *   mass.
   * After exchange(), nodes stored by several ranks hold the sums of all ranks.
   * Points are sent to the rank that owns their position in sort() only: the
   * stored nodes extend at least a cell beyond the points.
   */
  class GridTransfer
  {
  public:
    virtual ~GridTransfer() = default;

    /**
     * Sends points to their ranks, sorts them by cell and stores the nodes
     * around them, with `write` and `mass` set to zero. Collective.
     */
    virtual void
    sort(std::vector<PointArrays> &groups) = 0;

    /** Activates the prescribed velocities of a stage from the next sort() on.
     *  Collective. @return whether the active conditions differ from the
     *  previous stage */
    virtual bool
    begin_stage(const std::string &stage) = 0;

    /** Whether the next step requires a sort(), given the bounding box of the
     *  points of this rank in sums. Not collective. */
    virtual bool
    must_sort(const PassSums &sums) const = 0;

    /** @name Transfer of blocks of points; see TransferKernels */
    /** @{ */
    virtual void
    gather(const TransferBlock &points, BlockScratch &scratch) = 0;
    virtual void
    gather_values(const TransferBlock &points, BlockScratch &scratch) = 0;
    virtual void
    gather_affine(const TransferBlock &points, BlockScratch &scratch) = 0;
    virtual void
    scatter(const TransferBlock &points,
            BlockScratch        &scratch,
            const bool           with_mass) = 0;
    virtual void
    scatter_values(const TransferBlock &points,
                   BlockScratch        &scratch,
                   const bool           with_mass) = 0;
    virtual void
    scatter_affine(const TransferBlock &points, BlockScratch &scratch) = 0;
    /** Computes the cell index of each point, less than n_stored_cells(). */
    virtual void
    find_cells(const TransferBlock &points, unsigned int *cells) const = 0;
    /** @} */

    /** @name Volume averages over the points of a cell (B-bar) */
    /** @{ */
    void
    clear_cells();
    void
    add_to_cells(const TransferBlock &points, const double *values);
    /** Sums cell values over the ranks if a cell can have points on several
     *  ranks. Collective. */
    virtual void
    exchange_cells()
    {}
    /** Volume averages of the cells that contain the points; 0 if the volume in
     *  the cell is zero. */
    void
    average(const TransferBlock &points, double *means) const;
    virtual std::size_t
    n_stored_cells() const = 0;
    /** @} */

    /**
     * Sums the nodal values written by the points over all ranks, with the
     * masses if @p with_mass. Collective.
     */
    virtual void
    exchange(const bool with_mass) = 0;

    /** Whether x is in the region covered by stored nodes. */
    virtual bool
    reaches(const dealii::Point<dim> &x) const = 0;

    /** Any position in the region covered by stored nodes. */
    virtual dealii::Point<dim>
    stored_place() const = 0;

    /** Whether sort() must be called before every step. */
    virtual bool
    moves_each_step() const
    {
      return false;
    }

    /** Number of calls of sort() that redistributed cells between ranks and
     *  renumbered nodes. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

    /** Whether points store the cell that contains them, as found by sort()
     *  (PointState::cell and unit). */
    virtual bool
    keeps_cells() const
    {
      return false;
    }

    /** Position in the domain nearest to x. */
    virtual dealii::Point<dim>
    nearest_in_domain(const dealii::Point<dim> &x) const = 0;

    /** Whether any rank accepts points at any position before sort(); otherwise
     *  points must be created on the rank that owns() their position. */
    virtual bool
    takes_any_point() const
    {
      return true;
    }
    virtual bool
    owns(const dealii::Point<dim> &) const
    {
      return true;
    }

    /** Smallest edge length of all cells (m). */
    virtual double
    cell_size() const = 0;

    /** Numbers of nodes and of cells of the whole grid. */
    virtual unsigned long
    n_all_nodes() const = 0;
    virtual unsigned long
    n_cells() const = 0;

    /** Memory used by the nodes of this rank (bytes). */
    virtual std::size_t
    memory() const = 0;

    /** Description of the transfer kernels, for the log. */
    virtual std::string
    description() const = 0;

    /** Nodal arrays, aligned so that no node spans two cache lines. */
    dealii::AlignedVector<double> read, write, mass;

    /** Index ranges [begin, end) of the nodes owned by this rank, for global
     *  sums. */
    std::vector<std::array<unsigned int, 2>> mine;

    std::vector<PrescribedNode> prescribed;

    /** Centre of the bounding box of the nodes of each boundary condition. */
    std::vector<dealii::Point<dim>> centres;

    /** Points (group, index) located outside the mesh by sort(). */
    std::vector<std::array<unsigned int, 2>> lost;

    unsigned int
    n_nodes() const
    {
      return read.size() / node_size;
    }

  protected:
    /** Sums over the points of each cell: volume, and volume times value. */
    std::vector<double> sums_of_cells;
  };
} // namespace geocone::GEOCONE_DIM

#endif
