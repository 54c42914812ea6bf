// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_coarse_mesh_h
#define geocone_mesh_coarse_mesh_h

#include <geocone/base/types.h>

#include <deal.II/base/point.h>

#include <deal.II/grid/tria_description.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Vertices, cells with material ids, and boundary faces with side ids. */
  struct CoarseMesh
  {
    /** The vertices of a face: of an edge in the plane, where they rise; of a triangle,
     *  after which comes no_vertex, or a quadrilateral, in the order of its cell. */
    using Face = std::array<unsigned int, dim == 2 ? 2 : 4>;
    static constexpr unsigned int no_vertex = -1;

    std::vector<dealii::Point<dim>>                   points;
    std::vector<dealii::CellData<dim>>                cells;
    dealii::SubCellData                               boundary;
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Coordinates of the grid lines, if it is a tensor grid; or empty. */
    std::array<std::vector<double>, dim> grid;

    /** Whether there are triangles or tetrahedra. */
    bool
    has_simplices() const;

    /** Mean of the vertices of a cell. */
    dealii::Point<dim>
    centre(const dealii::CellData<dim> &cell) const;

    /** The same face, whatever its vertices begin with: in rising order. */
    static Face
    sorted(Face face);

    /** The faces that belong to one cell only. */
    std::vector<Face>
    outer_faces() const;

    /** Mean of the vertices of a face. */
    dealii::Point<dim>
    centre(const Face &face) const;

    /**
     * Parts the mesh along the faces between cells of materials that are apart: each
     * piece of what meets at a vertex there gets a vertex of its own.
     * @return these faces, as both sides have them
     */
    std::vector<Face>
    part(const std::function<bool(unsigned int, unsigned int)> &are_apart);

    /** The mesh so many times, one after another, in the same place: no copy shares
     *  vertices with another. */
    void
    repeat(const unsigned int times);

    /** Gives a boundary face the number of a side. */
    void
    add_boundary(const Face &face, const dealii::types::boundary_id side);
  };
} // namespace geocone::GEOCONE_DIM

#endif
