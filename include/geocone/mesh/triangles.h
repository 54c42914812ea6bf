// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_triangles_h
#define geocone_mesh_triangles_h

#include <geocone/boundary/boundary_conditions.h>
#include <geocone/mesh/coarse_mesh.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Triangular mesh, stored in plain arrays of vertices, cells and edges. */
  struct Triangles
  {
    explicit Triangles(const CoarseMesh &mesh);

    struct Edge
    {
      std::array<unsigned int, 2> vertices;
      int                         side = -1; ///< boundary id, or -1 inside
    };

    std::vector<dealii::Point<dim>>          vertices;
    std::vector<std::array<unsigned int, 3>> cells; ///< counterclockwise
    std::vector<unsigned int>                material;
    std::vector<std::array<unsigned int, 3>>
                      edges_of_cell; ///< edge i is opposite to vertex i
    std::vector<Edge> edges;

    std::map<std::string, dealii::types::boundary_id> sides;

    /** Boundary edges on which a boundary condition acts.
     *  @throws InputError if there is no edge, or if one of them is partly
     *  in the box of the condition */
    struct HeldEdge
    {
      unsigned int edge, cell, opposite_vertex;
    };
    std::vector<HeldEdge>
    held_edges(const BoundaryPart &condition) const;

    /** All boundary edges. */
    std::vector<HeldEdge>
    outer_edges() const;

    /** Vertices of the edges between triangles of different materials. */
    std::vector<std::array<unsigned int, 2>>
    edges_between_materials() const;

    double
    area(const unsigned int cell) const;

    /** Length of an edge (m). */
    double
    edge_length(const unsigned int edge) const
    {
      const auto &ends = edges[edge].vertices;
      return vertices[ends[0]].distance(vertices[ends[1]]);
    }

    /** Centroid of a triangular cell (m). */
    dealii::Point<dim>
    centre(const unsigned int cell) const;

    /** Gradients of the three barycentric coordinates of a triangle (1/m). */
    std::array<dealii::Tensor<1, dim>, 3>
    gradients(const unsigned int cell) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
