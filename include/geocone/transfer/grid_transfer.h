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
   * The nodes of an explicit step, and how points give to them and take from
   * them. A node has node_size doubles to read, as many to write, and a mass, at the
   * same place of three arrays:
   *   read:  velocity and its change in the step, for the points;
   *   write: momentum and force, from the points;
   *   mass.
   * Nodes that several ranks store hold the sums of all ranks after exchange().
   * Points go to the rank that owns their place in sort(), and not before: the
   * stored nodes reach at least a cell farther than the points.
   */
  class GridTransfer
  {
  public:
    virtual ~GridTransfer() = default;

    /**
     * Sends points to their ranks, sorts them by cell, and stores the nodes around
     * them, with nothing in write and mass. Collective.
     */
    virtual void
    sort(std::vector<PointArrays> &groups) = 0;

    /** Whether sort() must come before the next step, for points that have
     *  moved to these bounds on this rank (not collective). */
    virtual bool
    must_sort(const PassSums &sums) const = 0;

    /** @name Blocks of points; see TransferKernels */
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
    /** Numbers of the cells of the points, below n_stored_cells(). */
    virtual void
    find_cells(const TransferBlock &points, unsigned int *cells) const = 0;
    /** @} */

    /** @name Means over the points of a cell, weighted by volume (B-bar) */
    /** @{ */
    void
    clear_cells();
    void
    add_to_cells(const TransferBlock &points, const double *values);
    /** Sums over the ranks, where the points of a cell may be on several. Collective. */
    virtual void
    exchange_cells()
    {}
    /** The means of the cells of the points; 0 where no point has a volume. */
    void
    average(const TransferBlock &points, double *means) const;
    virtual std::size_t
    n_stored_cells() const = 0;
    /** @} */

    /**
     * Sums over the ranks what their points have written: everything, and the
     * masses if @p with_mass. Collective.
     */
    virtual void
    exchange(const bool with_mass) = 0;

    /** Whether points may be at x, where all stored nodes are. */
    virtual bool
    reaches(const dealii::Point<dim> &x) const = 0;

    /** A place that reaches() accepts. */
    virtual dealii::Point<dim>
    stored_place() const = 0;

    /** Whether sort() must come before every step. */
    virtual bool
    moves_each_step() const
    {
      return false;
    }

    /** How often sort() has handed over cells between ranks, and numbered nodes anew. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

    /** Whether points know their cells (PointState::cell and unit), which sort()
     *  finds. */
    virtual bool
    keeps_cells() const
    {
      return false;
    }

    /** The place of the domain that is nearest to x. */
    virtual dealii::Point<dim>
    nearest_in_domain(const dealii::Point<dim> &x) const = 0;

    /** Whether points of any place may be given to any rank before sort(), or
     *  each must be given one that owns() its place. */
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

    /** Smallest side of a cell (m). */
    virtual double
    cell_size() const = 0;

    /** Number of nodes of the whole grid, and of its cells. */
    virtual unsigned long
    n_all_nodes() const = 0;
    virtual unsigned long
    n_cells() const = 0;

    /** Bytes of the nodes. */
    virtual std::size_t
    memory() const = 0;

    /** What the kernels are called, for the log. */
    virtual std::string
    description() const = 0;

    /** Aligned, so that no node lies across two lines of the cache. */
    dealii::AlignedVector<double> read, write, mass;

    /** Ranges [begin, end) of the nodes that this rank counts in sums. */
    std::vector<std::array<unsigned int, 2>> mine;

    std::vector<PrescribedNode> prescribed;

    /** Per condition the centre of the bounding box of all nodes it selects. */
    std::vector<dealii::Point<dim>> centres;

    /** Points (group, number) that sort() has found outside the mesh. */
    std::vector<std::array<unsigned int, 2>> lost;

    unsigned int
    n_nodes() const
    {
      return read.size() / node_size;
    }

  protected:
    /** Volume, and volume times value, of the points of each cell. */
    std::vector<double> sums_of_cells;
  };
} // namespace geocone::GEOCONE_DIM

#endif
