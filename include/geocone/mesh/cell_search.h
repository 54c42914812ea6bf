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
   * The search for the cell of a place, in meshes of triangles and of
   * quadrilaterals. It looks among the cells of all ranks: each rank knows them
   * all, so that a place is found however far it is from where it was before.
   */
  class CellSearch
  {
  public:
    using Cell = BackgroundMesh::Cell;

    /** A cell, and the unit coordinates of the place there. */
    struct Place
    {
      Cell               cell;
      dealii::Point<dim> unit;
    };

    explicit CellSearch(const BackgroundMesh &mesh);

    /**
     * The place of x: first in the cell @p hint, then in those that share a vertex
     * with it, then everywhere in a layer of the mesh, where a place on the border of
     * cells belongs to the cell of the lowest rank and index, whichever rank asks.
     * @return nothing outside of the mesh, or if x is not a number
     */
    std::optional<Place>
    find(const dealii::Point<dim> &x,
         const Cell               &hint  = Cell(),
         const unsigned int        layer = 0) const;

    /** The cell with an index, which all ranks use for the same cell. */
    Cell
    cell(const unsigned int active_cell_index) const
    {
      return cells[active_cell_index];
    }

    /** The rank that has a cell. */
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

    /** The shortest distance of two vertices of a cell. */
    double
    smallest_cell() const
    {
      return smallest;
    }

  private:
    const BackgroundMesh               &mesh;
    const dealii::GridTools::Cache<dim> cache;
    std::vector<Cell>                   cells;
    /** Those that share a vertex with a cell: of cell c, the part of
     *  neighbours from first_neighbour[c] on. */
    std::vector<unsigned int> first_neighbour, neighbours;
    double                    smallest;
  };
} // namespace geocone::GEOCONE_DIM

#endif
