// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_tetrahedra_h
#define geocone_mesh_tetrahedra_h

#include <geocone/base/state_row.h>
#include <geocone/boundary/boundary_conditions.h>
#include <geocone/mesh/coarse_mesh.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Tetrahedral mesh, stored in plain arrays of vertices, cells and facets. */
  struct Tetrahedra
  {
    /** Constructs the tetrahedral mesh from a coarse mesh. Each hexahedron
     *  becomes six tetrahedra. */
    explicit Tetrahedra(const CoarseMesh &mesh);

    static constexpr unsigned int none = -1;

    struct Facet
    {
      std::array<unsigned int, 3> vertices; ///< in increasing order
      /** Indices of the cells on both sides of the facet. On the boundary, the
       *  second index is none. */
      std::array<unsigned int, 2> cells = {{none, none}};
      int                         side  = -1; ///< boundary id, or -1 inside
    };

    std::vector<dealii::Point<dim>>          vertices;
    std::vector<std::array<unsigned int, 4>> cells; ///< with positive volume
    std::vector<unsigned int>                material;
    std::vector<std::array<unsigned int, 4>>
                       facets_of_cell; ///< facet i is opposite to vertex i
    std::vector<Facet> facets;

    std::map<std::string, dealii::types::boundary_id> sides;

    /** Boundary facets on which a boundary condition acts.
     *  @throws InputError if there is no facet, or if one of them is partly
     *  in the box of the condition */
    std::vector<unsigned int>
    held_facets(const BoundaryPart &condition) const;

    double
    volume(const unsigned int cell) const;

    dealii::Point<dim>
    centre(const unsigned int cell) const;

    /** Gradients of the four barycentric coordinates of a tetrahedron (1/m). */
    std::array<dealii::Tensor<1, dim>, 4>
    gradients(const unsigned int cell) const;

    double
    area(const unsigned int facet) const;

    /** Unit normal of a facet, outward from the first adjacent cell. */
    dealii::Tensor<1, dim>
    normal(const unsigned int facet) const;

    /** Local index (0 to 3) of a vertex in a given tetrahedron. */
    unsigned int
    index_in_cell(const unsigned int cell, const unsigned int vertex) const;

    /** Saves the mesh to a checkpoint, or restores it from one. The names of
     *  the sides are excluded. */
    void
    state(StateRow &row);

  private:
    /** Orients the cells and finds their facets, without assigning facets to
     *  named sides.
     *  @return numbers of the facets by vertices */
    std::map<std::array<unsigned int, 3>, unsigned int>
    connect();
  };
} // namespace geocone::GEOCONE_DIM

#endif
