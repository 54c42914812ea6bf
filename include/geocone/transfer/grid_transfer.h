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
   * Nodes of an explicit step and the transfer between points and nodes. Three
   * arrays hold for each node, at the same index, node_size doubles to read, as
   * many to write, and a mass:
   *   read:  velocity and its change in the step, for the points;
   *   write: momentum and force, from the points;
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
     * around them, with zero write and mass. Collective.
     */
    virtual void
    sort(std::vector<PointArrays> &groups) = 0;

    /** Lets the prescribed velocities of a stage act, from the next sort() on.
     *  Collective. @return whether they are others than before */
    virtual bool
    begin_stage(const std::string &stage) = 0;

    /** Whether the next step requires a sort(), for points moved to these
     *  bounds on this rank (not collective). */
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
    /** Finds the cells of the points, as numbers below n_stored_cells(). */
    virtual void
    find_cells(const TransferBlock &points, unsigned int *cells) const = 0;
    /** @} */

    /** @name Volume averages over the points of a cell (B-bar) */
    /** @{ */
    void
    clear_cells();
    void
    add_to_cells(const TransferBlock &points, const double *values);
    /** Sums over the ranks if the points of a cell may be on several.
     *  Collective. */
    virtual void
    exchange_cells()
    {}
    /** Means of the cells of the points; 0 if no point has a volume. */
    void
    average(const TransferBlock &points, double *means) const;
    virtual std::size_t
    n_stored_cells() const = 0;
    /** @} */

    /**
     * Sums the nodal values written by the points over the ranks; masses only
     * if
     * @p with_mass. Collective.
     */
    virtual void
    exchange(const bool with_mass) = 0;

    /** Whether x is in the region covered by stored nodes. */
    virtual bool
    reaches(const dealii::Point<dim> &x) const = 0;

    /** A position accepted by reaches(). */
    virtual dealii::Point<dim>
    stored_place() const = 0;

    /** Whether every step requires a sort(). */
    virtual bool
    moves_each_step() const
    {
      return false;
    }

    /** Number of times that sort() has redistributed cells between ranks and
     *  renumbered nodes. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

    /** Whether points store their cells (PointState::cell and unit), found by
     *  sort(). */
    virtual bool
    keeps_cells() const
    {
      return false;
    }

    /** Nearest position of the domain to x. */
    virtual dealii::Point<dim>
    nearest_in_domain(const dealii::Point<dim> &x) const = 0;

    /** Whether any rank accepts points at any position before sort(); otherwise
     *  a point must be given to the rank that owns() its position. */
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

    /** Smallest edge of a cell (m). */
    virtual double
    cell_size() const = 0;

    /** Number of nodes of the whole grid, and of its cells. */
    virtual unsigned long
    n_all_nodes() const = 0;
    virtual unsigned long
    n_cells() const = 0;

    /** Memory of the nodes in bytes. */
    virtual std::size_t
    memory() const = 0;

    /** Name of the kernels, for the log. */
    virtual std::string
    description() const = 0;

    /** Aligned, so that no node spans two cache lines. */
    dealii::AlignedVector<double> read, write, mass;

    /** Ranges [begin, end) of the nodes that this rank includes in sums. */
    std::vector<std::array<unsigned int, 2>> mine;

    std::vector<PrescribedNode> prescribed;

    /** Centre of the bounding box of all nodes of each condition. */
    std::vector<dealii::Point<dim>> centres;

    /** Points (group, number) found outside the mesh by sort(). */
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
