// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/cell_search.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  CellSearch::CellSearch(const BackgroundMesh &mesh)
    : mesh(mesh)
    , cache(mesh.triangulation(), mesh.mapping())
    , smallest(std::numeric_limits<double>::max())
  {
    const auto                            &tria = mesh.triangulation();
    std::vector<std::vector<unsigned int>> cells_of_vertex(tria.n_vertices());
    for (const auto &cell : tria.active_cell_iterators())
      {
        for (const unsigned int v : cell->vertex_indices())
          cells_of_vertex[cell->vertex_index(v)].push_back(cells.size());
        cells.push_back(cell);
        smallest = std::min(smallest, cell->minimum_vertex_distance());
      }
    first_neighbour.push_back(0);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const auto first = neighbours.size();
        for (const unsigned int v : cells[c]->vertex_indices())
          for (const unsigned int other :
               cells_of_vertex[cells[c]->vertex_index(v)])
            if (other != c)
              neighbours.push_back(other);
        std::sort(neighbours.begin() + first, neighbours.end());
        neighbours.erase(
          std::unique(neighbours.begin() + first, neighbours.end()),
          neighbours.end());
        first_neighbour.push_back(neighbours.size());
      }
  }

  std::optional<CellSearch::Location>
  CellSearch::find(const Point<dim>  &x,
                   const Cell        &hint,
                   const unsigned int layer) const
  {
    // Also excludes NaN from the search by boxes.
    if (!(x.norm_square() < std::numeric_limits<double>::max()))
      return std::nullopt;
    if (hint.state() == IteratorState::valid)
      {
        if (const auto unit = mesh.unit_point(hint, x))
          return Location{hint, *unit};
        const unsigned int c = hint->active_cell_index();
        for (unsigned int i = first_neighbour[c]; i < first_neighbour[c + 1];
             ++i)
          if (const auto unit = mesh.unit_point(cells[neighbours[i]], x))
            return Location{cells[neighbours[i]], *unit};
      }
    // Slightly enlarged boxes, for points on the boundary of the mesh.
    Point<dim> lower = x, upper = x;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] -= BackgroundMesh::tolerance * smallest;
        upper[d] += BackgroundMesh::tolerance * smallest;
      }
    namespace bgi = boost::geometry::index;
    std::optional<Location> found;
    const auto           rank = [&](const Cell &cell) {
      return std::make_pair(owner(cell), cell->active_cell_index());
    };
    for (const auto &[box, cell] : cache.get_cell_bounding_boxes_rtree() |
                                     bgi::adaptors::queried(bgi::intersects(
                                       BoundingBox<dim>({lower, upper}))))
      if (mesh.layer_of(cell) == layer &&
          (!found || rank(cell) < rank(found->cell)))
        if (const auto unit = mesh.unit_point(cell, x))
          found = Location{cell, *unit};
    return found;
  }
} // namespace geocone::GEOCONE_DIM
