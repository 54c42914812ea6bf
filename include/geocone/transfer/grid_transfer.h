// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_grid_transfer_h
#define geocone_transfer_grid_transfer_h

#include <geocone/boundary/boundary_conditions.h>
#include <geocone/conditions/prescribed_node.h>
#include <geocone/points/point_arrays.h>
#include <geocone/transfer/transfer_kernels.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/point.h>

#include <mpi.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodes of an explicit step, with the transfer of data between material
   * points and nodes. Each node has the same index in three arrays: node_size
   * doubles to read, node_size doubles to write, and a mass.
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
     * Sends points to the ranks that own their positions and sorts the points
     * by cell. The nodes around the points are stored, with `write` and `mass`
     * set to zero. Collective.
     */
    virtual void
    sort(std::vector<PointArrays> &groups) = 0;

    /** Activates the prescribed velocities of a stage, starting with the next
     *  call to sort(). Collective. @return whether the active conditions differ
     *  from the previous stage */
    virtual bool
    begin_stage(const std::string &stage) = 0;

    /** Returns true if the next step requires a call to sort(). Not collective.
     *  @param sums contains the bounding box of the points of this rank */
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
    /** Computes the cell index of each point of a block. Indices are less than
     *  n_stored_cells(). */
    virtual void
    find_cells(const TransferBlock &points, unsigned int *cells) const = 0;
    /** @} */

    /** @name Volume averages over the points of a cell (B-bar) */
    /** @{ */
    void
    clear_cells();
    void
    add_to_cells(const TransferBlock &points, const double *values);
    /** Sums cell values over the ranks, if the points of a cell can be
     *  distributed over more than one rank. Collective. */
    virtual void
    exchange_cells()
    {}
    /** Computes, for each point, the volume average of a point value over all
     *  points of the same cell. The average is 0 if the volume in the cell is
     *  zero. */
    void
    average(const TransferBlock &points, double *means) const;
    virtual std::size_t
    n_stored_cells() const = 0;
    /** @} */

    /**
     * Sums over all ranks the nodal values that the points have scattered.
     * Nodal masses are included if @p with_mass. Collective.
     */
    virtual void
    exchange(const bool with_mass) = 0;

    /** @name Contact of points with obstacles */
    /** @{ */
    /** Positions of the stored nodes (m). */
    virtual std::vector<dealii::Point<dim>>
    node_positions() const = 0;

    /** Calls f(node) for each node that moves a point, at the positions of the last
     *  sort() or, on a uniform grid, at the current position. */
    virtual void
    for_each_node(const PointArrays &group,
                  const unsigned int number_of_group,
                  const unsigned int p,
                  const std::function<void(const unsigned int)> &f) const = 0;

    /** Replaces a value per node by the minimum over the ranks that store the node.
     *  Collective. */
    virtual void
    minimise_over_ranks(std::vector<double> &values) = 0;
    /** @} */

    /** Returns true if the position x is in the region covered by stored
     *  nodes. */
    virtual bool
    covers(const dealii::Point<dim> &x) const = 0;

    /** Returns an arbitrary position in the region covered by stored nodes. */
    virtual dealii::Point<dim>
    stored_place() const = 0;

    /** Returns true if sort() must be called before every step. */
    virtual bool
    moves_each_step() const
    {
      return false;
    }

    /** Returns the number of calls to sort() that redistributed cells between
     *  ranks and renumbered nodes. */
    virtual unsigned int
    n_repartitions() const
    {
      return 0;
    }

    /** Returns true if each point stores the cell that contains the point. The
     *  cell, found by sort(), is stored in PointState::cell and unit. */
    virtual bool
    keeps_cells() const
    {
      return false;
    }

    /** Returns the position in the domain that is nearest to x. */
    virtual dealii::Point<dim>
    nearest_in_domain(const dealii::Point<dim> &x) const = 0;

    /** Returns true if any rank may create points at any position before
     *  sort(). Otherwise points must be created on the rank that owns() their
     *  position. */
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

    /** Returns the smallest edge length of all cells (m). */
    virtual double
    cell_size() const = 0;

    /** Returns the number of nodes of the whole grid. */
    virtual unsigned long
    n_all_nodes() const = 0;

    /** Returns the number of cells of the whole grid. */
    virtual unsigned long
    n_cells() const = 0;

    /** Returns the memory used by the nodes of this rank (bytes). */
    virtual std::size_t
    memory() const = 0;

    /** Returns a description of the transfer kernels, for the log. */
    virtual std::string
    description() const = 0;

    /** Nodal arrays in explicit steps, aligned so that no node spans two cache
     *  lines. */
    dealii::AlignedVector<double> read, write, mass;

    /** Index ranges [begin, end) of the nodes owned by this rank, for sums over
     *  all ranks. */
    std::vector<std::array<unsigned int, 2>> mine;

    std::vector<PrescribedNode> prescribed;

    /** For each boundary condition, the centre of the bounding box of the nodes
     *  with prescribed velocity. */
    std::vector<dealii::Point<dim>> centres;

    /** Points that sort() found outside the mesh, as pairs of point group and
     *  index in the group. */
    std::vector<std::array<unsigned int, 2>> lost;

    unsigned int
    n_nodes() const
    {
      return read.size() / node_size;
    }

  protected:
    /** For each cell, the sum of the point volumes and the sum of the products
     *  of point volume and point value. */
    std::vector<double> sums_of_cells;
  };
} // namespace geocone::GEOCONE_DIM

#endif
