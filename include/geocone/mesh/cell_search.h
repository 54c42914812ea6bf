// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_cell_search_h
#define geocone_mesh_cell_search_h

#include <geocone/mesh/background_mesh.h>

#include <deal.II/grid/grid_tools_cache.h>

#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Search for the cell that contains a point. It covers the cells of all
   * ranks, which each rank stores, so that points are found however far they
   * have moved.
   */
  class CellSearch
  {
  public:
    using Cell = BackgroundMesh::Cell;

    /** A cell, and the unit coordinates of the point in it. */
    struct Location
    {
      Cell               cell;
      dealii::Point<dim> unit;
    };

    explicit CellSearch(const BackgroundMesh &mesh);

    /**
     * Locates x: first in the cell @p hint, then in those that share a vertex
     * with it, then in a complete layer of the mesh. There, points on cell
     * boundaries belong to the cell of the lowest rank and index, for whichever
     * rank searches.
     * @return no value outside of the mesh, or if x is NaN
     */
    std::optional<Location>
    find(const dealii::Point<dim> &x,
         const Cell               &hint  = Cell(),
         const unsigned int        layer = 0) const;

    /** Cell of an index, the same on all ranks. */
    Cell
    cell(const unsigned int active_cell_index) const
    {
      return cells[active_cell_index];
    }

    /** Rank of a cell. */
    unsigned int
    owner(const Cell &cell) const
    {
      return mesh.owner_of_cell()[cell->active_cell_index()];
    }

    bool
    mesh_is_simplicial() const
    {
      return mesh.is_simplicial();
    }

    /** Shortest distance between two vertices of a cell. */
    double
    smallest_cell() const
    {
      return smallest;
    }

  private:
    const BackgroundMesh               &mesh;
    const dealii::GridTools::Cache<dim> cache;
    std::vector<Cell>                   cells;
    /** Cells that share a vertex with a cell: those of cell c start at
     *  neighbours[first_neighbour[c]]. */
    std::vector<unsigned int> first_neighbour, neighbours;
    double                    smallest;
  };
} // namespace geocone::GEOCONE_DIM

#endif
