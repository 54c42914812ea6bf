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
   * Search for the mesh cell that contains a given point. Each rank stores the
   * cells of all ranks, so that points are found at any distance from their
   * former cell.
   */
  class CellSearch
  {
  public:
    using Cell = BackgroundMesh::Cell;

    /** Location of a point in the mesh: cell and unit cell coordinates. */
    struct Location
    {
      Cell               cell;
      dealii::Point<dim> unit;
    };

    explicit CellSearch(const BackgroundMesh &mesh);

    /**
     * Finds the cell that contains a point x. The search order is the cell
     * @p hint, the vertex neighbours of this cell, and a complete layer of the
     * mesh. In the last case, a point on a cell boundary belongs to the cell of
     * the lowest rank and index, on whichever rank the search runs.
     * @return no value outside of the mesh, or if x is NaN
     */
    std::optional<Location>
    find(const dealii::Point<dim> &x,
         const Cell               &hint  = Cell(),
         const unsigned int        layer = 0) const;

    /** Cell with a given active cell index, which is the same on all ranks. */
    Cell
    cell(const unsigned int active_cell_index) const
    {
      return cells[active_cell_index];
    }

    /** MPI rank that owns a given cell. */
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

    /** Smallest distance between two vertices of the same cell in the mesh
     *  (m). */
    double
    smallest_vertex_distance() const
    {
      return smallest;
    }

  private:
    const BackgroundMesh               &mesh;
    const dealii::GridTools::Cache<dim> cache;
    std::vector<Cell>                   cells;
    /** Vertex neighbours of all cells in compressed row format. The neighbours
     *  of cell c start at neighbours[first_neighbour[c]]. */
    std::vector<unsigned int> first_neighbour, neighbours;
    double                    smallest;
  };
} // namespace geocone::GEOCONE_DIM

#endif
