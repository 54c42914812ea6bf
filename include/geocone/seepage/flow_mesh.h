// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_mesh_h
#define geocone_seepage_flow_mesh_h

#include <geocone/mesh/tetrahedra.h>
#include <geocone/mesh/triangles.h>

#include <array>
#include <type_traits>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Mesh of a seepage problem: triangles, or tetrahedra in three dimensions,
   *  with the connections of the water balance and the facets of the cells. */
  struct FlowMesh : std::conditional_t<dim == 2, Triangles, Tetrahedra>
  {
    using Simplices = std::conditional_t<dim == 2, Triangles, Tetrahedra>;

    explicit FlowMesh(const CoarseMesh &mesh);

    static constexpr unsigned int n_corners     = dim + 1; ///< of a cell
    static constexpr unsigned int n_connections = dim == 2 ? 3 : 6;

    /** Corners of a cell at both ends of its connections. In a triangle,
     *  connection i is opposite to corner i. */
    static constexpr std::array<std::array<unsigned int, 2>, n_connections>
    corners_of_connections()
    {
      std::array<std::array<unsigned int, 2>, n_connections> all = {};
      unsigned int                                           n   = 0;
      for (unsigned int i = 0; i < n_corners; ++i)
        for (unsigned int j = i + 1; j < n_corners; ++j, ++n)
          {
            all[n][0] = dim == 2 ? (n + 1) % n_corners : i;
            all[n][1] = dim == 2 ? (n + 2) % n_corners : j;
          }
      return all;
    }

    /** Vertices at the ends of the edges of all cells, along which the water
     *  balance has its flows. */
    std::vector<std::array<unsigned int, 2>>             connections;
    std::vector<std::array<unsigned int, n_connections>> connections_of_cell;

    std::vector<std::array<unsigned int, dim>> facet_vertices;
    std::vector<std::array<unsigned int, n_corners>>
      facets_by_cell; ///< facet i is opposite to vertex i

    /** Boundary facets on which a boundary condition acts.
     *  @throws InputError as Triangles::held_edges() */
    std::vector<unsigned int>
    outer_facets(const BoundaryPart &condition) const;

    /** Area of a triangle (m^2) or volume of a tetrahedron (m^3). */
    double
    cell_size(const unsigned int cell) const;

    /** Length of an edge of a triangle (m) or area of a facet (m^2). */
    double
    facet_size(const unsigned int facet) const;

    /** Length, or area, of the projection of a facet onto the horizontal. */
    double
    projected_size(const unsigned int facet) const;

    /** Mean of the vertices of a facet. */
    dealii::Point<dim>
    facet_centre(const unsigned int facet) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
