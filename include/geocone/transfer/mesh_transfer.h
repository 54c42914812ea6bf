// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_transfer_mesh_transfer_h
#define geocone_transfer_mesh_transfer_h

#include <geocone/mesh/cell_search.h>
#include <geocone/points/point_functions.h>
#include <geocone/points/rank_balance.h>
#include <geocone/space/space.h>
#include <geocone/transfer/grid_transfer.h>

namespace geocone::GEOCONE_DIM
{
  class Constraints;

  /**
   * Transfer between material points and nodes on an arbitrary mesh. In each
   * step, the cell of each point is searched among its previous cell, the
   * vertex neighbours, then all cells, and the basis functions are evaluated
   * once. Load imbalance (points per rank) causes a redistribution of the
   * cells.
   */
  class MeshTransfer : public GridTransfer
  {
  public:
    /** Constructs the transfer on a mesh with the shape functions of a space.
     *  @throws InputError for sides that do not exist in the mesh */
    MeshTransfer(const Scene    &scene,
                 BackgroundMesh &mesh,
                 Space          &space,
                 RankBalance    &balance);

    void
    sort(std::vector<PointArrays> &groups) override;

    bool
    begin_stage(const std::string &stage) override;
    bool
    must_sort(const PassSums &) const override
    {
      return true;
    }
    bool
    takes_any_point() const override
    {
      return false;
    }
    bool
    owns(const dealii::Point<dim> &x) const override;

    unsigned int
    n_repartitions() const override
    {
      return balance.n_repartitions();
    }

    bool
    moves_each_step() const override
    {
      return true;
    }
    bool
    keeps_cells() const override
    {
      return true;
    }

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

    /** Returns true for any position, because the next sort() locates the
     *  points. */
    bool
    covers(const dealii::Point<dim> &) const override
    {
      return true;
    }
    dealii::Point<dim>
    nearest_in_domain(const dealii::Point<dim> &x) const override
    {
      return x;
    }
    dealii::Point<dim>
    stored_place() const override;

    double
    cell_size() const override
    {
      return search.smallest_vertex_distance();
    }
    unsigned long
    n_all_nodes() const override
    {
      return space.n_nodes();
    }
    unsigned long
    n_cells() const override
    {
      return mesh.triangulation().n_global_active_cells();
    }
    std::size_t
    memory() const override;
    std::string
    description() const override
    {
      return "general transfer";
    }

  private:
    using Cell = BackgroundMesh::Cell;

    /** Basis functions at the points of a group: local node numbers, values and
     *  gradients. */
    struct Functions
    {
      std::vector<unsigned int> nodes;
      std::vector<double>       N;
      /** Gradients of the basis functions at the points (1/m): dN/dx, dN/dy,
       *  ... */
      std::array<std::vector<double>, dim> slopes;
    };

    /** Allocates storage for the nodes of this rank and makes a list of those
     *  with prescribed velocities. */
    void
    store_nodes(const Constraints &constraints);

    /** Redistributes the cells of the mesh, with the points, between ranks.
     *  @param groups of points with stored cells, or without any cell.
     *  Collective. */
    void
    redistribute(const std::vector<PointArrays> &groups);

    /** Evaluates the basis functions at all points of a group, including
     *  padding points. */
    void
    evaluate(const PointArrays &group, Functions &functions) const;

    /** Returns the basis functions at point @p k of a block. */
    PointFunctions
    functions_at(const TransferBlock &points, const unsigned int k) const;

    template <bool with_gradients>
    void
    gather_any(const TransferBlock &points, BlockScratch &scratch) const;
    template <bool with_gradients>
    void
    scatter_any(const TransferBlock &points,
                const BlockScratch  &scratch,
                const bool           with_mass);

    const Scene       &scene;
    BackgroundMesh    &mesh;
    Space             &space;
    RankBalance       &balance;
    const MPI_Comm     comm;
    const unsigned int n; ///< nodes per cell
    const CellSearch   search;

    std::string stage; ///< stage of the active conditions

    std::vector<unsigned int> cell_nodes; ///< n nodes per active cell
    std::vector<Functions>    functions;  ///< per group of points
    Vector                    exchanged;
  };
} // namespace geocone::GEOCONE_DIM

#endif
