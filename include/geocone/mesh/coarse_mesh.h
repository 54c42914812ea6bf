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
  /** Mesh data for deal.II: vertices, cells with material ids, and boundary
   *  faces with boundary ids. */
  struct CoarseMesh
  {
    /** Vertex indices of a face (an edge in two dimensions). The vertices of an
     *  edge are in increasing order; the vertices of a triangle, followed by
     *  no_vertex, or of a quadrilateral are in the order of the cell. */
    using Face = std::array<unsigned int, dim == 2 ? 2 : 4>;
    static constexpr unsigned int no_vertex = -1;

    std::vector<dealii::Point<dim>>                   points;
    std::vector<dealii::CellData<dim>>                cells;
    dealii::SubCellData                               boundary;
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Grid line coordinates of a tensor-product grid (m); empty for other
     *  meshes. */
    std::array<std::vector<double>, dim> grid;

    /** Returns true if the cells are simplices (triangles or tetrahedra). */
    bool
    has_simplices() const;

    /** Mean of the vertex coordinates of a cell. */
    dealii::Point<dim>
    centre(const dealii::CellData<dim> &cell) const;

    /** Canonical form of a face, with vertex indices in increasing order. */
    static Face
    sorted(Face face);

    /** Outer faces of the mesh, which belong to one cell only. */
    std::vector<Face>
    outer_faces() const;

    /** Cells behind the faces of a cell, by number of the face; no_cell behind
     *  outer faces. */
    using Neighbours                      = std::array<unsigned int, 2 * dim>;
    static constexpr unsigned int no_cell = -1;

    /** Neighbours of all cells. */
    std::vector<Neighbours>
    neighbours() const;

    /** Mean of the vertex coordinates of a face. */
    dealii::Point<dim>
    centre(const Face &face) const;

    /**
     * Splits the mesh along the interfaces between bodies. Vertices on these
     * faces are duplicated, one for each adjacent part of the mesh.
     * @return faces of the interfaces, from both sides
     */
    std::vector<Face>
    part(const std::function<bool(unsigned int, unsigned int)> &are_apart);

    /** Replaces the mesh with a given number of disconnected copies at the same
     *  position. */
    void
    repeat(const unsigned int times);

    /** Assigns the boundary id of a side to a boundary face. */
    void
    add_boundary(const Face &face, const dealii::types::boundary_id side);
  };
} // namespace geocone::GEOCONE_DIM

#endif
